// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Bodies that stand whatever their velocity: those that the user takes out of the simulation (DISABLE_SIMULATION) while their joints stay, and static ones.

#include <algorithm>

#include <gtest/gtest.h>

#include "support/Close.h"
#include "world/Place.h"
#include "world/World.h"

namespace testFrozenBodies
{
using namespace ep;

/// Three boxes in a row.
struct Row
{
	World m_world;
	btRigidBody* m_bodies[3];
	btElasticPlasticJoint* m_joints[2];

	Row(Solver solver, const btVector3& gravity) : m_world(solver, gravity)
	{
		btCollisionShape* const box = m_world.box(btVector3(btScalar(0.4), btScalar(0.4), btScalar(0.4)));
		btElasticPlasticCapacity capacity;
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			capacity.set(dof, btScalar(1e7), btScalar(2e4), btScalar(0.5));
		for (int i = 0; i < 3; ++i)
			m_bodies[i] = m_world.body(20, box, at(btScalar(i)));
		for (int i = 0; i < 2; ++i)
			m_joints[i] = m_world.joint(*m_bodies[i], *m_bodies[i + 1], at(btScalar(i) + btScalar(0.5)), capacity);
	}

	double energy() const
	{
		double sum = 0;
		for (const btRigidBody* body : m_bodies)
			sum += kineticEnergy(*body, body->getCenterOfMassTransform().getBasis());
		for (const btElasticPlasticJoint* joint : m_joints)
			sum += joint->getElasticEnergy() + joint->getPlasticEnergy();
		return sum;
	}
};

TEST(FrozenBodies, HoldWhatIsJoinedToThem)
{
	// Bullet solves them as if they could move, and leaves them where they are: what hung on one sank by 7 m in 4 s, or broke off upwards.
	for (const Solver solver : {Solver::Direct, Solver::Iterative})
	{
		Row row(solver, btVector3(0, btScalar(-9.81), 0));
		row.m_bodies[0]->forceActivationState(DISABLE_SIMULATION);
		for (int i = 0; i < 240; ++i)
			row.m_world.step(btScalar(1) / 60);
		EXPECT_EQ(btVector3(0, 0, 0), row.m_bodies[0]->getCenterOfMassPosition());
		// The weight of two; ten iterations let them sink by 60 mm.
		EXPECT_NEAR(-2 * 20 * 9.81, row.m_joints[0]->getAppliedForce(BT_EP_SHEAR_Y), 1);
		EXPECT_NEAR(0, row.m_bodies[2]->getCenterOfMassPosition().y(), solver == Solver::Direct ? 1e-3 : 0.1);
		EXPECT_EQ(0, row.m_world.action().getNumBroken());
	}
}

TEST(FrozenBodies, MakeNoEnergy)
{
	// One of three that fly is frozen for two thirds of a second: it stops them, and they had up to 65 times the energy after it.
	for (const Solver solver : {Solver::Direct, Solver::Iterative})
		for (const bool stops : {false, true})
		{
			Row row(solver, btVector3(0, 0, 0));
			for (btRigidBody* body : row.m_bodies)
				body->setLinearVelocity(btVector3(1, btScalar(0.5), 0));
			const double energy = row.energy();
			for (int i = 0; i < 120; ++i)
			{
				btRigidBody& frozen = *row.m_bodies[2];
				if (i == 20 && stops)
					frozen.setLinearVelocity(btVector3(0, 0, 0));
				if (i == 20)
					frozen.forceActivationState(DISABLE_SIMULATION);
				if (i == 60)
					frozen.forceActivationState(ACTIVE_TAG);
				const btTransform place = frozen.getCenterOfMassTransform();
				row.m_world.step(btScalar(1) / 60);
				EXPECT_LT(row.energy(), 1.001 * energy) << i;
				if (i > 20 && i < 60)
				{
					EXPECT_EQ(0, place.getOrigin().distance(frozen.getCenterOfMassPosition()))
						<< i << " " << stops << int(solver);
					EXPECT_EQ(btVector3(1, 1, 1), frozen.getLinearFactor());
				}
			}
		}
}
TEST(FrozenBodies, AreWithoutForceFromTheirLastMotionAndFromLoads)
{
	// Bullet keeps the velocity with which it has moved a body last, and the joint's spring went by it: 164 kN at rest. And it adds what loads do
	// to a body's velocity, whether it can move or not.
	for (const Solver solver : {Solver::Direct, Solver::Iterative})
		for (const bool isLoaded : {false, true})
		{
			Row row(solver, btVector3(0, 0, 0));
			for (btRigidBody* body : row.m_bodies)
				body->setLinearVelocity(btVector3(1, 0, 0));
			for (int i = 0; i < 240; ++i)
			{
				if (i == 20)
					row.m_bodies[2]->forceActivationState(DISABLE_SIMULATION);
				if (isLoaded && i > 120)
					row.m_bodies[2]->applyCentralForce(btVector3(0, 1000, 0));
				// The others come to rest.
				if (i > 20)
					for (int k = 0; k < 2; ++k)
						row.m_bodies[k]->setLinearVelocity(row.m_bodies[k]->getLinearVelocity() * btScalar(0.8));
				row.m_world.step(btScalar(1) / 60);
			}
			for (const btElasticPlasticJoint* joint : row.m_joints)
				for (int dof = 0; dof < 3; ++dof)
					EXPECT_NEAR(0, joint->getForce(dof), 200) << int(solver) << isLoaded << dof;
			EXPECT_EQ(0, row.m_bodies[2]->getLinearVelocity().length());
		}
}
TEST(StaticBodies, StandWhateverVelocityTheyHave)
{
	// Bullet's solver adds a static body's velocity to its joints' rows, and ours took it for a support's motion: at 5 m/s two blocks of 100 kg gained
	// 3.5 kJ in the iterative form, and the direct form told 39 kJ numerical.
	for (const Solver solver : {Solver::Direct, Solver::Iterative})
		for (const bool isSupportB : {false, true})
		{
			btVector3 ends[3];
			double numerical[3], plastic[3];
			for (int run = 0; run < 3; ++run)
			{
				const btScalar speed = btScalar(run == 0 ? 0 : run == 1 ? 5 : 50);
				World world(solver, btVector3(0, btScalar(-9.81), 0));
				btCollisionShape* const box = world.box(btVector3(btScalar(0.4), btScalar(0.4), btScalar(0.4)));
				btElasticPlasticCapacity capacity;
				for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
					capacity.set(dof, btScalar(1e7), btScalar(2e4), btScalar(0.5));
				btRigidBody *bodies[3], *&support = bodies[0];
				for (int i = 0; i < 3; ++i)
					bodies[i] = world.body(i == 0 ? btScalar(0) : btScalar(100), box, at(btScalar(i)));
				btElasticPlasticJoint* joints[2];
				for (int i = 0; i < 2; ++i)
					joints[i] = world.joint(*bodies[isSupportB ? i + 1 : i], *bodies[isSupportB ? i : i + 1],
											at(btScalar(i) + btScalar(0.5)), capacity);
				support->setLinearVelocity(btVector3(speed, speed / 2, -speed));
				support->setAngularVelocity(btVector3(speed / 3, 0, speed / 2));
				for (int i = 0; i < 120; ++i)
					world.step(btScalar(1) / 60);
				ends[run] = bodies[2]->getCenterOfMassPosition();
				numerical[run] = joints[0]->getNumericalEnergy();
				plastic[run] = joints[0]->getPlasticEnergy();
				EXPECT_EQ(0, joints[0]->getDamage());
			}
			for (int run = 1; run < 3; ++run)
			{
				// What is added and taken away again in the iterative form leaves its rounding: of 50 m/s, a millimetre a second in float.
				const btScalar rounding = solver == Solver::Direct ? btScalar(0) : 100 * SIMD_EPSILON;
				EXPECT_LE(ends[run].distance(ends[0]), rounding) << run << isSupportB;
				EXPECT_NEAR(numerical[0], numerical[run], double(rounding) * 1e5) << run << isSupportB;
				EXPECT_EQ(plastic[0], plastic[run]) << run << isSupportB;
			}
		}
}

TEST(StaticBodies, LetWhatBouncesOnThemBounceAsOnAnyOther)
{
	// What is to bounce in the step is told by how fast it comes, of which a static body's velocity is no part: Bullet's rows know nothing of it.
	btVector3 ends[3];
	for (int run = 0; run < 3; ++run)
	{
		Row row(Solver::Direct, btVector3(0, btScalar(-9.81), 0));
		btRigidBody* const slab = row.m_world.body(0, row.m_world.box(btVector3(10, 1, 10)), at(0, -2));
		slab->setRestitution(btScalar(0.8));
		for (btRigidBody* body : row.m_bodies)
			body->setRestitution(btScalar(0.8));
		slab->setLinearVelocity(btVector3(0, btScalar(run == 0 ? 0 : run == 1 ? -20 : 20), 0));
		for (int i = 0; i < 60; ++i)
			row.m_world.step(btScalar(1) / 60);
		EXPECT_GT(row.m_bodies[0]->getCenterOfMassPosition().y(), -1.5);
		ends[run] = row.m_bodies[0]->getCenterOfMassPosition();
	}
	EXPECT_EQ(ends[0], ends[1]);
	EXPECT_EQ(ends[0], ends[2]);
}
}  // namespace testFrozenBodies
