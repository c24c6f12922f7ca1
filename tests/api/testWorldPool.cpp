// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// btDiscreteDynamicsWorldMt has each island solved by whichever solver of a pool is free, several at the same time where Bullet is
// built with threads. The result must not depend on which one it is.

#include <stdint.h>

#include <vector>

#include <gtest/gtest.h>

#include "LinearMath/btThreads.h"
#include "support/Site.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testWorldPool
{
using namespace ep;

/// A pool whose solver is chosen by chance, as threads would have it.
class ChancePool : public btConstraintSolverPoolMt
{
public:
	ChancePool(btConstraintSolver** solvers, int count)
		: btConstraintSolverPoolMt(solvers, count), m_solvers(solvers, solvers + count)
	{
	}
	btScalar solveGroup(btCollisionObject** bodies, int numBodies, btPersistentManifold** manifolds, int numManifolds,
						btTypedConstraint** constraints, int numConstraints, const btContactSolverInfo& info,
						btIDebugDraw* debugDrawer, btDispatcher* dispatcher) override
	{
		m_chance = m_chance * 6364136223846793005u + 1442695040888963407u;
		return m_solvers[size_t(m_chance >> 33) % m_solvers.size()]->solveGroup(
			bodies, numBodies, manifolds, numManifolds, constraints, numConstraints, info, debugDrawer, dispatcher);
	}

private:
	std::vector<btConstraintSolver*> m_solvers;
	uint64_t m_chance = 1;
};

/// A lattice of blocks, joined along the three axes and held at its foot.
void buildLattice(Site& site, int width, int height, btScalar x, const btElasticPlasticCapacity& capacity)
{
	const btVector3 size(btScalar(0.9), btScalar(0.9), btScalar(0.9));
	const auto place = [&](int i, int j, int k) { return at(x + btScalar(i), btScalar(j), btScalar(k)); };
	btRigidBody& ground = site.body(0, btVector3(btScalar(width + 1), 1, btScalar(width + 1)),
									at(x + btScalar(width - 1) / 2, -1, btScalar(width - 1) / 2));
	std::vector<btRigidBody*> blocks;
	const auto blockAt = [&](int i, int j, int k) { return blocks[size_t((j * width + i) * width + k)]; };
	const auto join = [&](btRigidBody& a, btRigidBody& b, const btTransform& pose)
	{
		btTransform frame = b.getWorldTransform();
		frame.setOrigin((pose.getOrigin() + frame.getOrigin()) / 2);
		site.join(a, b, frame, capacity);
	};
	for (int j = 0; j < height; ++j)
		for (int i = 0; i < width; ++i)
			for (int k = 0; k < width; ++k)
			{
				btRigidBody& block = site.body(100, size, place(i, j, k));
				blocks.push_back(&block);
				join(j > 0 ? *blockAt(i, j - 1, k) : ground, block, place(i, j - 1, k));
				if (i > 0)
					join(*blockAt(i - 1, j, k), block, place(i - 1, j, k));
				if (k > 0)
					join(*blockAt(i, j, k - 1), block, place(i, j, k - 1));
			}
}

/// Two large islands, whose factors a world's only solver keeps, and many small ones; balls hit some of them.
void build(Site& site)
{
	btElasticPlasticCapacity capacity = evenCapacity(1e7, 3e4);
	capacity.set(BT_EP_BENDING_Y, btScalar(1e6), btScalar(5e3), btScalar(0.3));
	capacity.set(BT_EP_BENDING_Z, btScalar(1e6), btScalar(5e3), btScalar(0.3));
	for (int i = 0; i < 2; ++i)
		buildLattice(site, 5, 5, btScalar(20 * i), capacity);
	for (int i = 0; i < 12; ++i)
		buildLattice(site, 1, 3 + i % 4, btScalar(60 + 5 * i), capacity);
	for (int i = 0; i < 14; ++i)
	{
		btRigidBody& ball =
			site.body(200, btVector3(1, 1, 1),
					  at(i < 2 ? btScalar(20 * i - 3) : btScalar(60 + 5 * (i - 2) - 3), btScalar(2.2), btScalar(0.1)));
		ball.setLinearVelocity(btVector3(btScalar(8 + i % 3), 0, 0));
	}
}

std::vector<btScalar> placesAfter(Site& site, int steps)
{
	build(site);
	site.run(steps);
	std::vector<btScalar> places;
	for (const auto& body : site.m_bodies)
		for (int i = 0; i < 3; ++i)
			places.push_back(body->getCenterOfMassPosition()[i]);
	for (const auto& joint : site.m_joints)
		places.push_back(joint->isBroken() ? btScalar(-1) : btScalar(joint->getDamage()));
	return places;
}

TEST(WorldPool, AnySolverOfAPoolGivesTheSameBits)
{
	Site one(Site::makePool(1)), some(Site::makePool<ChancePool>(4));
	const std::vector<btScalar> places = placesAfter(one, 60);
	EXPECT_EQ(places, placesAfter(some, 60));
	int damaged = 0;
	for (const auto& joint : one.m_joints)
		damaged += joint->getDamage() > 0;
	EXPECT_GT(damaged, 10);

	// The islands are such that a solver that is the only one uses the factor of the step before.
	Site discrete(Kind::Discrete);
	build(discrete);
	discrete.run(5);
	EXPECT_GT(static_cast<btElasticPlasticConstraintSolver&>(*discrete.m_solver).getStatistics().m_iterations, 0);
}

/// A site whose pool has one solver, which is told, too.
std::unique_ptr<Site> siteOf(btElasticPlasticConstraintSolver*& solver)
{
	solver = new btElasticPlasticConstraintSolver;
	btConstraintSolver* solvers[] = {solver};
	return std::make_unique<Site>(std::unique_ptr<btConstraintSolverPoolMt>(new btConstraintSolverPoolMt(solvers, 1)));
}

/// The number of analyses that a solver in a pool needs for a chain of 4 bodies that becomes one of 3, of 2, and of 4 again.
int countAnalyses(int stepsBetween)
{
	btElasticPlasticConstraintSolver* solver = nullptr;
	const std::unique_ptr<Site> owned = siteOf(solver);
	Site& site = *owned;
	std::vector<btRigidBody*> blocks{&site.body(0, btVector3(1, 1, 1), at(0))};
	for (int i = 1; i < 5; ++i)
	{
		blocks.push_back(&site.body(1, btVector3(1, 1, 1), at(0, btScalar(-2 * i))));
		site.join(*blocks[size_t(i - 1)], *blocks[size_t(i)], at(0, btScalar(1 - 2 * i)), evenCapacity(1e5));
	}
	site.run(stepsBetween);
	for (int i = 3; i > 1; --i)
	{
		site.m_action.breakJoint(*site.m_world, site.m_joints[size_t(i)].get());
		site.run(stepsBetween);
	}
	for (int i = 2; i < 4; ++i)
		site.m_action.repair(site.m_joints[size_t(i)].get());
	site.run(stepsBetween);
	return solver->getStatistics().m_analyses;
}

TEST(WorldPool, TakesNoInnerSteps)
{
	// They would move bodies on which islands of other threads stand. A solver takes them by default, and in a pool whether it has been set up or not.
	for (const bool isSetUp : {false, true})
	{
		btElasticPlasticConstraintSolver* solver = nullptr;
		const std::unique_ptr<Site> site = siteOf(solver);
		if (isSetUp)
		{
			EXPECT_TRUE(solver->setSettings(solver->getSettings()));
		}
		build(*site);
		site->run(60);
		EXPECT_EQ(0, solver->getStatistics().m_innerSteps) << isSetUp;
	}
	Site discrete(Kind::Discrete);
	build(discrete);
	discrete.run(60);
	EXPECT_GT(static_cast<btElasticPlasticConstraintSolver&>(*discrete.m_solver).getStatistics().m_innerSteps, 0);
}

TEST(WorldPool, ASolverOfAnotherWorldBecomesOneOfThePool)
{
	btElasticPlasticConstraintSolver* moved = nullptr;
	{
		Site discrete(Kind::Discrete);
		build(discrete);
		discrete.run(30);
		moved = static_cast<btElasticPlasticConstraintSolver*>(discrete.m_solver.release());
	}
	moved->resetStatistics();
	btConstraintSolver* solvers[] = {moved, new btElasticPlasticConstraintSolver};
	Site some(std::unique_ptr<btConstraintSolverPoolMt>(new ChancePool(solvers, 2))), one(Site::makePool(1));
	EXPECT_EQ(placesAfter(one, 60), placesAfter(some, 60));
	EXPECT_EQ(0, moved->getStatistics().m_innerSteps);
	EXPECT_EQ(0, moved->getStatistics().m_iterations) << "a factor was kept";
	EXPECT_GT(moved->getStatistics().m_solutions, 0) << "it had nothing to do";
}

TEST(WorldPool, AgesItsPlans) { EXPECT_GT(countAnalyses(30), countAnalyses(5)); }

#if BT_THREADSAFE
TEST(WorldPool, ThreadsChangeNoBit)
{
	btITaskScheduler* const scheduler = btCreateDefaultTaskScheduler();
	ASSERT_TRUE(scheduler);
	btSetTaskScheduler(scheduler);
	std::vector<std::vector<btScalar>> places;
	for (int threads : {1, 2, 3, 4, 4})
	{
		scheduler->setNumThreads(threads);
		Site site(Site::makePool(4));
		places.push_back(placesAfter(site, 60));
		EXPECT_EQ(places[0], places.back()) << threads << " threads";
	}
	btSetTaskScheduler(btGetSequentialTaskScheduler());
	delete scheduler;
}
#endif
}  // namespace testWorldPool
