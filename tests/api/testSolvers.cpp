// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Solvers of every kind, Bullet's and ours, on the same joints.

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/BlockUnderTension.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"
#include "support/Run.h"

namespace testSolvers
{
using namespace ep;

/// Settled sag of the paper's block, all solvers: with damping the block comes to rest.
double sag(Solver solver, int rate, double share)
{
	BlockUnderTension::Settings settings;
	settings.method = solver;
	settings.steelShare = btScalar(share);
	BlockUnderTension block(settings);
	block.m_block->setDamping(btScalar(0.99), btScalar(0.99));
	for (int i = 0; i < 5 * rate; ++i)
		block.m_world.step(btScalar(1) / rate);
	EXPECT_FALSE(block.m_joint->hasYielded());
	return block.sunk();
}

TEST(Solvers, HoldTheBlockAtItsElasticSag)
{
	const double share = 0.002, expected = 60e3 / (200e9 * share / 1.5);
	for (Solver solver : {Solver::Stock, Solver::Nncg, Solver::Iterative})
		for (int rate : {60, 240})
			EXPECT_NEAR(expected, sag(solver, rate, share), 0.01 * expected) << int(solver) << " " << rate;
	// Bullet's MLCP solver leaves a row's compliance out altogether: a spring stiffer than the step resolves is rigid there.
	EXPECT_NEAR(0, sag(Solver::Mlcp, 60, share), 1e-6);
	EXPECT_NEAR(expected, sag(Solver::Mlcp, 960, share), 0.01 * expected);
}

TEST(Solvers, StayFiniteAndLoseEnergyFromSoftToStiff)
{
	// A cantilever of ten cubes, spun and kicked: no solver may blow it up, whatever the stiffness.
	for (Solver solver : {Solver::Stock, Solver::Nncg, Solver::Mlcp, Solver::Iterative})
		for (double stiffness : {1e2, 1e4, 1e5, 1e6, 1e8, 1e12})
			for (int rate : {60, 1000})
			{
				World world(solver, btVector3(0, 0, 0));
				btCollisionShape* cube = world.box(btVector3(1, 1, 1));
				btRigidBody* last = world.body(0, cube, btTransform::getIdentity(), false);
				btElasticPlasticCapacity capacity;
				for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
					capacity.set(i, btScalar(stiffness), btElasticPlasticCapacity::unlimited());
				for (int i = 1; i <= 10; ++i)
				{
					btRigidBody* next = world.body(
						100, cube, btTransform(btQuaternion(0, 0, 0, 1), btVector3(btScalar(i), 0, 0)), false);
					world.joint(*last, *next, btTransform(btQuaternion(0, 0, 0, 1), btVector3(btScalar(i - 0.5), 0, 0)),
								capacity);
					last = next;
				}
				last->setLinearVelocity(btVector3(0, 1, btScalar(0.5)));
				const double before = world.kineticEnergy();
				double largest = 0;
				for (int i = 0; i < 300; ++i)
				{
					world.step(btScalar(1) / rate);
					largest = std::max(largest, world.kineticEnergy());
				}
				// The kick's energy may slosh, not grow.
				EXPECT_LT(largest, 1.05 * before)
					<< "solver " << int(solver) << " stiffness " << stiffness << " rate " << rate;
			}
}

TEST(Solvers, OursIsTheStockSolverWhereThereAreNoJoints)
{
	const auto placesWith = [](Solver solver)
	{
		World world(solver);
		btCollisionShape* cube = world.box(btVector3(1, 1, 1));
		world.body(0, world.box(btVector3(50, 1, 50)), btTransform::getIdentity());
		for (int i = 0; i < 10; ++i)
			world.body(10, cube,
					   btTransform(btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(0.1 * i)),
								   btVector3(btScalar(0.1 * i), btScalar(2 + 1.1 * i), 0)));
		auto* hinge = new btHingeConstraint(*world.bodies()[3], *world.bodies()[4], btVector3(0, 1, 0),
											btVector3(0, -1, 0), btVector3(1, 0, 0), btVector3(1, 0, 0));
		world.add(hinge);
		run(world, 240);
		std::vector<btVector3> places;
		for (const auto& body : world.bodies())
			places.push_back(body->getCenterOfMassPosition());
		return places;
	};
	EXPECT_TRUE(placesWith(Solver::Stock) == placesWith(Solver::Iterative));
}
}  // namespace testSolvers
