// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Input that is finite, of which no solution is: it would take a velocity beyond what a number can hold.

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "support/Run.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testNotFinite
{
using namespace ep;

/// A pair of bodies that float, and one that hangs beside it.
struct Pairs
{
	World m_world;
	std::vector<btRigidBody*> m_bodies;
	std::vector<btElasticPlasticJoint*> m_joints;

	explicit Pairs(Solver solver) : m_world(solver, btVector3(0, 0, 0))
	{
		btCollisionShape* const cube = m_world.box(btVector3(1, 1, 1));
		for (int i = 0; i < 4; ++i)
			m_bodies.push_back(m_world.body(btScalar(i < 2    ? inPrecision(1e-60, 1e-4)
													 : i == 2 ? 0
															  : 12),
											cube, place(i), false));
		for (int i = 0; i < 4; i += 2)
			m_joints.push_back(&*m_world.joint(
				*m_bodies[size_t(i)], *m_bodies[size_t(i) + 1], at(btScalar(0.5), 0, place(i).getOrigin().z()),
				evenCapacity(1e6, i == 0 ? double(btElasticPlasticCapacity::greatestYield()) : 1e6)));
		m_bodies[3]->setGravity(btVector3(0, -10, 0));
		run(m_world, 10);
	}

	static btTransform place(int i) { return at(btScalar(i % 2), 0, btScalar(i < 2 ? 0 : 10)); }

	/// By a force that is finite, and gives a body of so little mass more than the largest velocity in each step.
	void takeApart()
	{
		m_world.beforeSubsteps(
			[this](btScalar)
			{ m_bodies[1]->applyCentralForce(btVector3(std::numeric_limits<btScalar>::max() / 20, 0, 0)); });
		m_bodies[0]->setLinearVelocity(btVector3(1, 2, 3));
		m_bodies[1]->setAngularVelocity(btVector3(0, 0, 1));
	}
};

TEST(NotFinite, IsNotWritten)
{
	for (Solver solver : {Solver::Direct, Solver::Iterative})
	{
		Pairs pairs(solver), quiet(solver);
		EXPECT_EQ(0, statisticsOf(pairs.m_world).m_notFinite);
		pairs.takeApart();
		const btElasticPlasticState before = pairs.m_joints[0]->getState();
		run(pairs.m_world, 5);
		run(quiet.m_world, 5);
		EXPECT_EQ(5, statisticsOf(pairs.m_world).m_notFinite);
		EXPECT_EQ(0, statisticsOf(quiet.m_world).m_notFinite);
		for (const btRigidBody* body : pairs.m_bodies)
			EXPECT_TRUE(isFinite(*body));
		// The island moves on as it did, and its joint stays as it is.
		EXPECT_EQ(btVector3(1, 2, 3), pairs.m_bodies[0]->getLinearVelocity());
		EXPECT_EQ(btVector3(0, 0, 1), pairs.m_bodies[1]->getAngularVelocity());
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			EXPECT_EQ(before.m_force[dof], pairs.m_joints[0]->getState().m_force[dof]);
		EXPECT_EQ(0, pairs.m_joints[0]->getPlasticEnergy());
		// The other one knows nothing of it, where islands are solved by themselves.
		if (solver == Solver::Direct)
		{
			EXPECT_EQ(quiet.m_bodies[3]->getLinearVelocity(), pairs.m_bodies[3]->getLinearVelocity());
			EXPECT_EQ(quiet.m_bodies[3]->getCenterOfMassPosition(), pairs.m_bodies[3]->getCenterOfMassPosition());
			EXPECT_EQ(quiet.m_joints[1]->getForce(1), pairs.m_joints[1]->getForce(1));
		}
		EXPECT_TRUE(isFinite(*pairs.m_bodies[3]));
		// Put back, it holds again.
		pairs.m_world.beforeSubsteps(nullptr);
		pairs.m_bodies[0]->setLinearVelocity(btVector3(0, 0, 0));
		pairs.m_bodies[0]->setCenterOfMassTransform(at(0));
		pairs.m_bodies[1]->setCenterOfMassTransform(at(1));
		pairs.m_bodies[1]->setAngularVelocity(btVector3(0, 0, 0));
		run(pairs.m_world, 5);
		EXPECT_EQ(5, statisticsOf(pairs.m_world).m_notFinite);
		EXPECT_EQ(6, pairs.m_joints[0]->getNumCommittedRows());
		EXPECT_LT(pairs.m_bodies[1]->getLinearVelocity().length(), 1e-3);
	}
}
}  // namespace testNotFinite
