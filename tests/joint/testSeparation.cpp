// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Bodies that overlap when their joint breaks: they part without being shot apart.

#include <gtest/gtest.h>

#include "support/Pair.h"
#include "support/Precision.h"

namespace testSeparation
{
using namespace ep;

/// Two blocks that turn against each other until their corners overlap deeply; then the joint breaks.
struct BentBreak : Pair
{
	btElasticPlasticJoint* m_joint;

	explicit BentBreak(Solver solver) : Pair(solver, 1000, 1000, btVector3(0, 0, 0), true)
	{
		btElasticPlasticCapacity capacity = evenCapacity(1e8, 1e6);
		capacity.set(BT_EP_BENDING_Z, btScalar(1e6), 2000, btScalar(0.6));
		m_joint = join(capacity);
		m_b->setAngularVelocity(btVector3(0, 0, 4));
		m_a->setAngularVelocity(btVector3(0, 0, -4));
	}
};

TEST(Separation, GivesNoEnergyAtABreak)
{
	for (Solver solver : {Solver::Stock, Solver::Iterative})
	{
		BentBreak scene(solver);
		bool broke = false;
		double energy = 1e30;
		int collidedAfter = 0;
		for (int i = 0; i < 960; ++i)
		{
			scene.m_world.step(btScalar(1) / 240);
			if (scene.m_joint->isBroken())
			{
				broke = true;
				// Nothing acts any more but their contact: kinetic energy never rises, to the rounding of velocities.
				EXPECT_LE(scene.m_world.kineticEnergy(), energy * (1 + byPrecision(1e-9, 1e-5)));
				EXPECT_TRUE(scene.m_a->checkCollideWith(scene.m_b));
				collidedAfter += scene.m_world.bullet().getDispatcher()->getNumManifolds() > 0;
			}
			energy = scene.m_world.kineticEnergy();
		}
		EXPECT_TRUE(broke);
		// They did overlap and touch, else this proves nothing.
		EXPECT_GT(collidedAfter, 0);
	}
}

TEST(Separation, EndsWhenTheBodiesHaveParted)
{
	BentBreak scene(Solver::Iterative);
	int steps = 0;
	while (!scene.m_joint->isBroken() && steps++ < 960)
		scene.m_world.step(btScalar(1) / 240);
	ASSERT_TRUE(scene.m_joint->isBroken());
	EXPECT_EQ(1, scene.m_world.bullet().getNumConstraints());
	scene.m_b->setLinearVelocity(btVector3(2, 0, 0));
	scene.m_a->setLinearVelocity(btVector3(-2, 0, 0));
	run(scene.m_world, 480, btScalar(1) / 240);
	EXPECT_EQ(0, scene.m_world.bullet().getNumConstraints());
}

TEST(Separation, StillLetsBodiesRestOnEachOther)
{
	// A column crushed at a joint does not telescope: the upper block stays on the lower one.
	World world(Solver::Iterative);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* lower = world.body(0, cube, btTransform::getIdentity());
	btRigidBody* upper = world.body(1000, cube, btTransform(btQuaternion(0, 0, 0, 1), btVector3(0, 1, 0)));
	btElasticPlasticCapacity capacity;
	for (int d = 0; d < BT_EP_DOF_COUNT; ++d)
		capacity.set(d, btScalar(1e7), 8000, btScalar(0.1));
	btElasticPlasticJoint* joint = world.joint(
		*lower, *upper, btTransform(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI), btVector3(0, btScalar(0.5), 0)),
		capacity);
	run(world, 480, btScalar(1) / 240);
	ASSERT_TRUE(joint->isBroken());
	EXPECT_NEAR(0.9, upper->getCenterOfMassPosition().y(), 0.02);
}

TEST(Separation, OutlivesDeletionOfTheBrokenJoint)
{
	BentBreak scene(Solver::Iterative);
	while (!scene.m_joint->isBroken())
		scene.m_world.step(btScalar(1) / 240);
	ASSERT_EQ(1, scene.m_world.bullet().getNumConstraints());
	scene.m_world.action().removeJoint(scene.m_joint);
	EXPECT_EQ(0, scene.m_world.bullet().getNumConstraints());
	run(scene.m_world, 10, btScalar(1) / 240);
}
}  // namespace testSeparation
