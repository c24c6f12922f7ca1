// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// A bound on the work of an island in a step: counted, kept to, and without energy from nowhere.

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/destruction/Stage.h"
#include "solver/SmallDestruction.h"
#include "support/Precision.h"
#include "world/EnergyAudit.h"

namespace
{
using namespace ep;

struct Played
{
	long long m_mostWork = 0, m_cut = 0;
	double m_gain = 0, m_turnover = 0;
	btVector3 m_sum = btVector3(0, 0, 0);  // of bodies' places

	explicit Played(long long maxWork, btElasticPlasticContacts contacts = BT_EP_CONTACTS_BY_ISLAND)
	{
		const SmallDestruction scene = smallDestructions()[0];
		Stage stage(scene.settings());
		scene.build(stage);
		btElasticPlasticSolverSettings settings = stage.solver()->getSettings();
		settings.m_maxWork = maxWork;
		settings.m_contacts = contacts;
		stage.solver()->setSettings(settings);
		EnergyAudit audit(stage.world());
		while (stage.frame() < scene.frames)
		{
			stage.playScript();
			stage.solver()->resetStatistics();
			audit.begin();
			stage.step();
			audit.end(btScalar(Stage::FRAME));
			m_mostWork = std::max(m_mostWork, stage.solver()->getStatistics().m_work);
			m_cut += stage.solver()->getStatistics().m_cutSearches;
			m_gain = std::max(m_gain, audit.gain() - audit.bulletsRecovery());
		}
		m_turnover = audit.turnover();
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
	// A step of the search is not begun if it would go beyond; pieces of the wall are islands of their own.
	EXPECT_LT(bounded.m_mostWork, bound * 12 / 10);
	// As in Destruction.EnergyIsNotGained.
	EXPECT_LE(bounded.m_gain, 1e-6 * bounded.m_turnover + byPrecision(0, 1));
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

TEST(WorkBound, GivesTheSameBitsAgain)
{
	const Played first(400000), second(400000);
	EXPECT_EQ(first.m_sum, second.m_sum);
	EXPECT_EQ(first.m_mostWork, second.m_mostWork);
}
}  // namespace
