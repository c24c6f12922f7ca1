// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// A bound on the work of an island in a step: counted, kept to, and without energy from nowhere.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "solver/SmallDestruction.h"
#include "support/AuditedPlay.h"
#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "support/Run.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testWorkBound
{
using namespace ep;

struct Played
{
	long long m_mostWork = 0;  ///< of a step of the world with a single island
	long long m_cut = 0;
	double m_gain = 0;  ///< the most of a step in which a search was cut [J]
	double m_turnover = 0;
	btVector3 m_sum = btVector3(0, 0, 0);  // of bodies' places

	explicit Played(long long maxWork, btElasticPlasticContacts contacts = BT_EP_CONTACTS_BY_ISLAND,
					long long maxInnerWork = btElasticPlasticSolverSettings().m_maxInnerWork)
	{
		const SmallDestruction scene = smallDestructions()[0];
		Stage stage(scene.settings());
		scene.build(stage);
		btElasticPlasticSolverSettings settings = stage.solver()->getSettings();
		settings.m_maxWork = maxWork;
		settings.m_maxInnerWork = maxInnerWork;
		settings.m_contacts = contacts;
		stage.solver()->setSettings(settings);
		m_turnover = playAudited(stage, scene.frames,
								 [&](double gain)
								 {
									 const btElasticPlasticStatistics& statistics = stage.solver()->getStatistics();
									 if (statistics.m_islands == 1)
										 m_mostWork = std::max(m_mostWork, statistics.m_work);
									 m_cut += statistics.m_cutSearches;
									 if (statistics.m_cutSearches > 0)
										 m_gain = std::max(m_gain, gain);
									 stage.solver()->resetStatistics();
								 });
		for (const auto& body : stage.world().bodies())
			m_sum += body->getCenterOfMassPosition();
	}
};

TEST(WorkBound, IsKeptToAndMakesNoEnergy)
{
	const Played free(0);
	EXPECT_EQ(0, free.m_cut);
	const long long bound = free.m_mostWork / 3;
	const Played bounded(bound);
	EXPECT_GT(bounded.m_cut, 0);
	// A step of the search is not begun if it would go beyond.
	EXPECT_LT(bounded.m_mostWork, bound * 12 / 10);
	// As in Destruction.EnergyIsNotGained.
	EXPECT_LE(bounded.m_gain, 1e-6 * bounded.m_turnover + byPrecision(0, 1));
}

TEST(WorkBound, TheLargestNumberIsNoBound)
{
	const long long most = std::numeric_limits<long long>::max();
	const Played free(0, BT_EP_CONTACTS_BY_ISLAND, most / 1000), largest(most, BT_EP_CONTACTS_BY_ISLAND, most);
	EXPECT_EQ(0, largest.m_cut);
	EXPECT_EQ(free.m_mostWork, largest.m_mostWork);
	EXPECT_EQ(free.m_sum, largest.m_sum);
}

TEST(WorkBound, HoweverSmallMakesNoEnergy)
{
	// What is cut short are searches, loops of contacts, and solutions that sweeps of contacts have relied on. Flow that no body has
	// given for is not plastic.
	for (const btElasticPlasticContacts contacts : {BT_EP_SWEPT_CONTACTS, BT_EP_EXACT_CONTACTS})
		for (const long long bound : {1ll, 30000ll, 300000ll})
		{
			const Played bounded(bound, contacts);
			EXPECT_GT(bounded.m_cut, 0);
			EXPECT_LE(bounded.m_gain, 1e-6 * bounded.m_turnover + byPrecision(0, 1)) << bound << " " << contacts;
		}
}

/// A cantilever of boxes, the last of which is struck, of a material that damps: searches are cut when springs and branches are strained.
TEST(WorkBound, LeavesDampedJointsWithinTheirStrength)
{
	const btElasticPlasticCapacity capacities[] = {
		evenCapacity(1e8, 5e3),
		btElasticPlasticCapacity::fromRod(
			btElasticPlasticMaterial::steel(btScalar(1e6)),
			btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres(16), 1)};
	for (btElasticPlasticCapacity capacity : capacities)
		for (const btScalar dt : {FRAME, FRAME / 8, FRAME / 64})
		{
			SCOPED_TRACE(testing::Message() << "fibres " << capacity.hasFibres() << ", step " << dt);
			capacity.m_damping = btScalar(0.06);
			World world(withoutInnerSteps(), btVector3(0, 0, 0));
			btCollisionShape* const cube = world.box(btVector3(1, 1, 1));
			btRigidBody* last = world.body(0, cube, at(0), false);
			for (int i = 1; i <= 6; ++i)
			{
				btRigidBody* const next = world.body(100, cube, at(i), false);
				world.joint(*last, *next, at(i - 0.5), capacity);
				last = next;
			}
			last->setLinearVelocity(btVector3(3, 5, 4));
			const double start = world.kineticEnergy();
			double most = 0;
			for (int i = 0; i < 200; ++i)
			{
				btElasticPlasticSolverSettings settings = solverOf(world).getSettings();
				settings.m_maxWork = i < 20 ? 0 : 1;
				solverOf(world).setSettings(settings);
				world.step(dt);
				double energy = world.kineticEnergy();
				for (const btElasticPlasticJoint* joint : world.joints())
				{
					energy += joint->getElasticEnergy() + joint->getPlasticEnergy() + joint->getDampingEnergy();
					for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
						EXPECT_LE(btFabs(joint->getAppliedForce(dof)), capacity.m_yield[dof] * btScalar(1.001))
							<< i << ' ' << dof;
				}
				most = std::max(most, energy);
			}
			EXPECT_GT(statisticsOf(world).m_cutSearches, 0);
			// At most 0.2 %, before searches are cut: places are half a step ahead of velocities.
			EXPECT_LE(most, start * 1.003);
		}
}

/// The most work of a step in which boxes that are joined in pairs begin in one place, each a millimetre beside the last.
long long mostWorkOfPile(btElasticPlasticContacts contacts, int numBoxes, long long maxWork,
						 const Method& method = withoutInnerSteps())
{
	World world(method);
	btElasticPlasticSolverSettings settings = solverOf(world).getSettings();
	settings.m_maxWork = maxWork;
	settings.m_contacts = contacts;
	solverOf(world).setSettings(settings);
	btCollisionShape* const cube = world.box(btVector3(1, 1, 1));
	world.body(0, world.box(btVector3(100, 1, 100)), at(0, -0.5));
	btRigidBody* last = nullptr;
	for (int i = 0; i < numBoxes; ++i)
	{
		btRigidBody* const next = world.body(100, cube, at(1e-3 * i, 0.4));
		if (i % 2 == 1)
			world.joint(*last, *next, at(1e-3 * i - 5e-4, 0.4), evenCapacity(1e8, 1e5));
		last = next;
	}
	long long most = 0;
	for (int i = 0; i < 5; ++i)
	{
		solverOf(world).resetStatistics();
		world.step(FRAME);
		most = std::max(most, statisticsOf(world).m_work);
		// With its 79 400 contact points a step takes as long as Bullet's: there is no time for several.
		EXPECT_EQ(0, statisticsOf(world).m_innerSteps);
		for (const auto& body : world.bodies())
			EXPECT_TRUE(isFinite(*body));
	}
	return most;
}

TEST(WorkBound, HoldsForBoxesInOnePlace)
{
	// Contacts that are swept leave the system small: 200 boxes take no more than the joints of a bridge.
	EXPECT_LT(mostWorkOfPile(BT_EP_CONTACTS_BY_ISLAND, 200, 0), 200000);
	EXPECT_LT(mostWorkOfPile(BT_EP_CONTACTS_BY_ISLAND, 200, 0, Solver::Direct), 200000);
	// Solved with the joints they are the most of it. A factorisation and a solution are done in any case.
	for (const int numBoxes : {24, 100})
	{
		const long long least = mostWorkOfPile(BT_EP_EXACT_CONTACTS, numBoxes, 1), bound = 4 * least;
		// A loop of the contacts begins with these, and makes a first step of the search without knowing what it takes.
		EXPECT_LT(mostWorkOfPile(BT_EP_EXACT_CONTACTS, numBoxes, bound), bound + 2 * least) << numBoxes;
	}
}

TEST(WorkBound, GivesTheSameBitsAgain)
{
	const Played first(400000), second(400000);
	EXPECT_EQ(first.m_sum, second.m_sum);
	EXPECT_EQ(first.m_mostWork, second.m_mostWork);
}
}  // namespace testWorkBound
