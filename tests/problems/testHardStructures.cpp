// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Structures that are hard for the direct form: mechanisms, redundancy, weakness, failure.

#include <math.h>

#include <gtest/gtest.h>

#include "scenes/Cantilever.h"
#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "support/Run.h"
#include "world/EnergyAudit.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testHardStructures
{
using namespace ep;

TEST(HardStructures, ChainOfHingesIsAMechanismThatSwings)
{
	// A pendulum of ten links: turning about two axes free, about the third a weak spring; places elastic or locked by Bullet.
	for (bool elasticPlaces : {false, true})
	{
		World world(Solver::Direct);
		btCollisionShape* shape = world.box(btVector3(1, btScalar(0.1), btScalar(0.1)));
		btRigidBody* last = world.body(0, shape, at(-0.5, 0), false);
		btElasticPlasticCapacity capacity;
		if (elasticPlaces)
			capacity = evenCapacity(1e7);
		capacity.clear(BT_EP_TORSION);
		capacity.clear(BT_EP_BENDING_Y);
		capacity.set(BT_EP_BENDING_Z, 1, btElasticPlasticCapacity::unlimited());
		std::vector<btRigidBody*> links;
		for (int i = 0; i < 10; ++i)
		{
			links.push_back(world.body(10, shape, at(i + 0.5, 0), false));
			world.joint(*last, *links.back(), at(i, 0), capacity);
			last = links.back();
		}
		double lowest = 0, farthest = 0;
		for (int i = 0; i < 300; ++i)
		{
			world.step(btScalar(1) / 240);
			for (btRigidBody* link : links)
				ASSERT_TRUE(isFinite(*link));
			lowest = std::min(lowest, double(last->getCenterOfMassPosition().y()));
			farthest = std::max(farthest, double(last->getCenterOfMassPosition().length()));
		}
		// In 1.25 s a rod of its length would be about upright.
		EXPECT_LT(lowest, -7);
		// It hangs together. Links turn by up to 0.1 rad a step, which opens a lock by 5 mm; Bullet closes it by a fifth.
		EXPECT_LT(farthest, 9.5 + 10 * 0.01) << elasticPlaces;
		EXPECT_EQ(0, statisticsOf(world).m_fallbacks);
	}
}

TEST(HardStructures, FreeFallingMechanismFalls)
{
	// Nothing holds it: the matrix is the mass plus the joints' null space.
	World world(Solver::Direct);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btElasticPlasticCapacity capacity;
	capacity.set(BT_EP_SHEAR_Y, btScalar(1e9), btElasticPlasticCapacity::unlimited());
	btRigidBody* last = nullptr;
	for (int i = 0; i < 10; ++i)
	{
		btRigidBody* next = world.body(10, cube, at(i, 0), false);
		if (last)
			world.joint(*last, *next, at(i - 0.5, 0), capacity);
		last = next;
	}
	run(world, 60);
	// Semi-implicit Euler.
	EXPECT_NEAR(-10. / 3600 * 60 * 61 / 2, last->getCenterOfMassPosition().y(), byPrecision(1e-9, 1e-4));
	EXPECT_EQ(0, statisticsOf(world).m_fallbacks);
}

TEST(HardStructures, DuplicateJointsShareTheLoad)
{
	World world(Solver::Direct);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* support = world.body(0, cube, at(0, 1), false);
	btRigidBody* block = world.body(1000, cube, at(0, 0), false);
	btElasticPlasticJoint* joints[3];
	for (btElasticPlasticJoint*& joint : joints)
		joint = world.joint(*support, *block, at(0, 0.5), evenCapacity(1e9));
	run(world, 60);
	for (const btElasticPlasticJoint* joint : joints)
		EXPECT_NEAR(10000. / 3, fabs(double(joint->getForce(BT_EP_SHEAR_Y))), byPrecision(0.01, 10));
	EXPECT_EQ(0, statisticsOf(world).m_fallbacks);
}

// Newton's line search crawls where stiff rows begin to yield: no step of 60 converges, for any of these yield values.
TEST(HardStructures, WeakChainFalls)
{
	for (double yield : {1e-6, 1e-3, 1., 100.})
	{
		World world(Solver::Direct);
		btCollisionShape* cube = world.box(btVector3(1, 1, 1));
		btRigidBody* last = world.body(0, cube, at(0, 0), false);
		btElasticPlasticCapacity capacity;
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			capacity.set(i, btScalar(1e9), btScalar(yield));
		for (int i = 1; i < 10; ++i)
		{
			btRigidBody* next = world.body(100, cube, at(i, 0), false);
			world.joint(*last, *next, at(i - 0.5, 0), capacity);
			last = next;
		}
		run(world, 60);
		// Nearly free fall: a joint holds a tenth of a body's weight at most.
		EXPECT_NEAR(-10. / 3600 * 60 * 61 / 2, last->getCenterOfMassPosition().y(), 1e-3 + yield / 1000) << yield;
		EXPECT_EQ(0, statisticsOf(world).m_fallbacks) << yield;
	}
}

TEST(HardStructures, OldFactorsAreAsExactAsNewOnes)
{
	// A stirred net that yields here and there: conjugate gradients with the last step's factor against factorising always.
	btVector3 ends[2];
	long long iterations = 0;
	for (int fresh = 0; fresh < 2; ++fresh)
	{
		World world(Solver::Direct);
		btElasticPlasticSolverSettings settings = solverOf(world).getSettings();
		settings.m_maxIterations = fresh ? 0 : 8;
		solverOf(world).setSettings(settings);
		btCollisionShape* cube = world.box(btVector3(1, 1, 1));
		btRigidBody* wall = world.body(0, cube, at(-1, 0), false);
		const int n = 14;
		std::vector<btRigidBody*> net;
		btElasticPlasticCapacity capacity = evenCapacity(1e8);
		capacity.m_yield[BT_EP_BENDING_Z] = 3e5;
		for (int i = 0; i < n * n; ++i)
		{
			const int x = i / n, z = i % n;
			net.push_back(world.body(100, cube, at(x, 0, z), false));
			net.back()->setLinearVelocity(btVector3(0, btScalar(0.02 * x * z), 0));
			world.joint(x > 0 ? *net[i - n] : *wall, *net[i], at(x - 0.5, 0, z), capacity);
			if (z > 0)
				world.joint(*net[i - 1], *net[i], at(x, 0, z - 0.5), capacity);
		}
		for (int i = 0; i < 60; ++i)
			world.step(btScalar(1) / (i % 7 == 0 ? 240 : 60));
		ends[fresh] = net.back()->getCenterOfMassPosition();
		if (!fresh)
			iterations = statisticsOf(world).m_iterations;
	}
	EXPECT_GT(iterations, 0);
	// Each step is exact to 1e-11 of its momentum; 2e-12 m measured in double, rounded poses in float.
	EXPECT_LT((ends[0] - ends[1]).length(), byPrecision(1e-9, 1e-4));
	EXPECT_GT((ends[1] - btVector3(13, 0, 13)).length(), 0.01);
}

TEST(HardStructures, ASearchThatIsCutKeepsTheLawAndMakesNoEnergy)
{
	// No Newton step allowed, and no iteration of the interior point method: as soon as a joint begins to yield, the search is cut.
	Cantilever cantilever{Cantilever::Settings()};
	btElasticPlasticSolverSettings solverSettings;
	solverSettings.m_maxNewtonSteps = solverSettings.m_maxInteriorIterations = 0;
	solverOf(cantilever.m_world).setSettings(solverSettings);
	btElasticPlasticCapacity capacity = cantilever.m_root->getCapacity();
	capacity.m_yield[BT_EP_BENDING_Z] = 500;
	cantilever.m_root->setCapacity(capacity);
	EnergyAudit audit(cantilever.m_world);
	const btScalar dt = btScalar(1) / 60;
	for (int i = 0; i < 60; ++i)
	{
		audit.step(dt);
		for (const btElasticPlasticJoint* joint : cantilever.m_world.joints())
			for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
				// A thousandth for the rounding of impulses in float.
				EXPECT_LE(std::fabs(joint->getForce(dof)), btScalar(1.001) * joint->getCapacity().m_yield[dof]);
	}
	EXPECT_GT(statisticsOf(cantilever.m_world).m_cutSearches, 0);
	EXPECT_EQ(0, statisticsOf(cantilever.m_world).m_fallbacks);
	EXPECT_EQ(0, statisticsOf(cantilever.m_world).m_newtonSteps);
	EXPECT_LT(audit.created(), byPrecision(1e-9, 1e-5));
	// Back to normal, it is solved exactly again.
	solverOf(cantilever.m_world).setSettings(btElasticPlasticSolverSettings());
	solverOf(cantilever.m_world).resetStatistics();
	run(cantilever.m_world, 60);
	EXPECT_EQ(0, statisticsOf(cantilever.m_world).m_cutSearches);
	for (btRigidBody* part : cantilever.m_member.m_parts)
		EXPECT_TRUE(isFinite(*part));
}
}  // namespace testHardStructures
