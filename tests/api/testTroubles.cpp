// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What docs/games.md says of structures that sag, shake, explode, won't break or break at once, made to happen.

#include <math.h>

#include <string>

#include <gtest/gtest.h>

#include "support/Site.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testTroubles
{
using namespace ep;

const btTransform UP(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI), btVector3(0, 0, 0));

btElasticPlasticConstraintSolver& solverOf(Site& site)
{
	return static_cast<btElasticPlasticConstraintSolver&>(*site.m_solver);
}

/// The largest speed of any body within so many steps [m/s].
double largestSpeed(Site& site, int steps)
{
	double largest = 0;
	for (int i = 0; i < steps; ++i)
	{
		site.run(1);
		for (const auto& body : site.m_bodies)
			largest = btMax(largest, double(body->getLinearVelocity().length()));
	}
	return largest;
}

/// Gives a world another solver for a while.
struct StockSolver
{
	btSequentialImpulseConstraintSolver m_stock;
	Site& m_site;

	explicit StockSolver(Site& site) : m_site(site) { site.m_world->setConstraintSolver(&m_stock); }
	~StockSolver() { m_site.m_world->setConstraintSolver(m_site.m_solver.get()); }
};

/// Two blocks of 100 kg that overlap each other and a wall by 5 cm, and collide although they are joined.
void buildOverlappingBlocks(Site& site)
{
	btRigidBody* former = &site.body(0, btVector3(1, 1, 1), at(0));
	for (int i = 1; i < 3; ++i)
	{
		btRigidBody& block = site.body(100, btVector3(1, 1, 1), at(btScalar(0.95 * i)));
		site.join(*former, block, at(btScalar(0.95 * i - 0.475)), evenCapacity(1e7, 1e6));
		site.m_world->removeConstraint(site.m_joints.back().get());
		site.m_world->addConstraint(site.m_joints.back().get(), false);
		former = &block;
	}
}

TEST(Troubles, OfAnotherSolverNoIslandIsCounted)
{
	for (bool isOurs : {true, false})
	{
		Site site(Kind::Discrete);
		buildOverlappingBlocks(site);
		if (isOurs)
			site.run(10);
		else
		{
			StockSolver stock(site);
			site.run(10);
		}
		EXPECT_EQ(isOurs ? 10 : 0, solverOf(site).getStatistics().m_islands);
	}
}

TEST(Troubles, JoinedNeighboursThatCollideShakeWithBulletsSolver)
{
	Site direct(Kind::Discrete), other(Kind::Discrete), iterative(Kind::Discrete);
	buildOverlappingBlocks(direct);
	EXPECT_LT(largestSpeed(direct, 180), 0.1);
	buildOverlappingBlocks(other);
	{
		StockSolver stock(other);
		EXPECT_GT(largestSpeed(other, 180), 1);
	}
	solverOf(iterative).setForm(BT_EP_ITERATIVE);
	buildOverlappingBlocks(iterative);
	EXPECT_GT(largestSpeed(iterative, 180), 1);
}

TEST(Troubles, WhatIsBuiltIntoEachOtherFliesApartWithBulletsSolver)
{
	for (bool isOurs : {true, false})
	{
		Site site(Kind::Discrete);
		btRigidBody &wall = site.body(0, btVector3(4, 1, 4), at(0, -2)),
					&plate = site.body(200, btVector3(4, btScalar(0.2), 4), at(0));
		site.join(wall, plate, UP, evenCapacity(1e8, 1e6));
		site.body(50, btVector3(1, 1, 1), at(0, btScalar(0.3)));
		site.body(50, btVector3(1, 1, 1), at(btScalar(0.3), btScalar(0.9)));
		if (isOurs)
			EXPECT_LT(largestSpeed(site, 120), 0.1);
		else
		{
			StockSolver stock(site);
			EXPECT_GT(largestSpeed(site, 120), 1);
		}
	}
}

TEST(Troubles, FramesThatDoNotMeetPull)
{
	for (bool isMended : {false, true})
	{
		Site site(Kind::Discrete, btVector3(0, 0, 0));
		btRigidBody &a = site.body(0, btVector3(1, 1, 1), at(0)), &b = site.body(100, btVector3(1, 1, 1), at(2));
		btElasticPlastic6DofSpring2Constraint joint(a, b, at(1), at(btScalar(-1.005)));
		joint.setCapacity(evenCapacity(1e7, 1e6));
		site.m_world->addConstraint(&joint, true);
		site.m_action.addJoint(&joint);
		if (isMended)
			joint.setReferenceToCurrentPose();
		const double speed = largestSpeed(site, 30);
		EXPECT_TRUE(isMended ? speed < 1e-4 : speed > 0.1) << speed;
		site.m_world->removeConstraint(&joint);
	}
}

TEST(Troubles, AHeavyLoadOnLightBoxesShakesOnSweptContacts)
{
	for (bool isExact : {false, true})
	{
		Site site(Kind::Discrete);
		btElasticPlasticSolverSettings settings = solverOf(site).getSettings();
		if (isExact)
			settings.m_contacts = BT_EP_EXACT_CONTACTS;
		solverOf(site).setSettings(settings);
		btRigidBody &wall = site.body(0, btVector3(1, 1, 1), at(0, -5)),
					&plate = site.body(200, btVector3(8, btScalar(0.2), 4), at(0));
		site.join(wall, plate, UP, evenCapacity(1e8, 1e8));
		for (int i = 0; i < 8; ++i)
			site.body(200, btVector3(btScalar(0.8), btScalar(0.8), btScalar(0.8)),
					  at(btScalar(i - 3.5), btScalar(0.5)));
		site.body(20000, btVector3(8, btScalar(0.5), 2), at(0, btScalar(1.15)));
		site.run(180);
		const double speed = largestSpeed(site, 60);
		EXPECT_TRUE(isExact ? speed < 0.01 : speed > 0.05) << speed;
	}
}

TEST(Troubles, ForcesFromPlacesThatTheUserSetsGrow)
{
	struct Refusals : btElasticPlasticListener
	{
		std::string m_last;
		void onRefused(btElasticPlasticJoint&, const char* text) override { m_last = text; }
	} refusals;
	Site site(Kind::Discrete, btVector3(0, 0, 0));
	site.m_action.addListener(&refusals);
	btRigidBody &a = site.body(0, btVector3(1, 1, 1), at(0)), &b = site.body(10, btVector3(1, 1, 1), at(2));
	site.join(a, b, at(1), evenCapacity(1e4));
	b.setLinearVelocity(btVector3(0, btScalar(0.01), 0));
	// A spring of k dt^2 / m = 8, as forces: explicit it is stable up to 4.
	for (int i = 0; i < 1000 && refusals.m_last.empty(); ++i)
	{
		b.applyCentralForce(btVector3(0, btScalar(-8 * 10 * 3600) * b.getCenterOfMassPosition().y(), 0));
		site.run(1);
	}
	EXPECT_NE(std::string::npos, refusals.m_last.find("body B is nan")) << refusals.m_last;
}

TEST(Troubles, WithoutDuctilityItFlowsForEver)
{
	Site site(Kind::Discrete);
	btRigidBody &ceiling = site.body(0, btVector3(1, 1, 1), at(0)),
				&load = site.body(1000, btVector3(1, 1, 1), at(0, -2));
	btElasticPlasticCapacity capacity = evenCapacity(1e8, 1e7);
	capacity.set(BT_EP_AXIAL, btScalar(1e8), 8000);
	const btTransform down(btQuaternion(btVector3(0, 0, 1), -SIMD_HALF_PI), btVector3(0, -1, 0));
	btElasticPlasticJoint& joint = site.join(ceiling, load, down, capacity);
	site.run(240);
	EXPECT_TRUE(joint.hasYielded());
	EXPECT_FALSE(joint.isBroken());
	EXPECT_LT(load.getCenterOfMassPosition().y(), -15);
	EXPECT_LT(joint.getDamage(), 1e-6);
}

TEST(Troubles, LoadGoesPastAJointWhoseBodiesCollide)
{
	for (bool disablesCollisions : {false, true})
	{
		Site site(Kind::Discrete);
		btRigidBody &ground = site.body(0, btVector3(4, 1, 4), at(0, btScalar(-0.5))),
					&block = site.body(1000, btVector3(1, 1, 1), at(0, btScalar(0.5)));
		btElasticPlasticCapacity capacity = evenCapacity(1e8, 1e6);
		capacity.set(BT_EP_AXIAL, btScalar(1e8), 8000, btScalar(0.01));
		btElasticPlasticJoint& joint = site.join(ground, block, UP, capacity);
		if (!disablesCollisions)
		{
			site.m_world->removeConstraint(site.m_joints[0].get());
			site.m_world->addConstraint(site.m_joints[0].get(), false);
		}
		site.run(120);
		EXPECT_EQ(disablesCollisions, joint.isBroken());
	}
}

TEST(Troubles, ABlowAtTheGamesStepDoesLessDamage)
{
	double damage[3];
	for (int i = 0; i < 3; ++i)
	{
		Site site(Kind::Discrete, btVector3(0, 0, 0));
		auto& solver = static_cast<btElasticPlasticConstraintSolver&>(*site.m_solver);
		btElasticPlasticSolverSettings settings = solver.getSettings();
		settings.m_innerError = i == 0 ? 0 : settings.m_innerError;
		ASSERT_TRUE(solver.setSettings(settings));
		btRigidBody &wall = site.body(0, btVector3(1, 1, 1), at(0)), &block = site.body(100, btVector3(1, 1, 1), at(2));
		btElasticPlasticCapacity capacity;
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			capacity.set(dof, btScalar(1e6), btScalar(2e4), btScalar(0.1));
		btElasticPlasticJoint& joint = site.join(wall, block, at(1), capacity);
		btRigidBody& ball = site.body(500, btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)), at(2, 1));
		ball.setLinearVelocity(btVector3(0, btScalar(-2.5), 0));
		const int rate = i < 2 ? 60 : 960;
		for (int step = 0; step < 2 * rate; ++step)
			site.m_world->stepSimulation(btScalar(1) / btScalar(rate), 0);
		damage[i] = joint.getDamage();
	}
	EXPECT_LT(damage[0], 0.7 * damage[2]);
	EXPECT_NEAR(damage[2], damage[1], 0.05 * damage[2]);  // with inner steps, to their error
	EXPECT_GT(damage[2], 0.3);
}

TEST(Troubles, ItBreaksUnderItsOwnWeight)
{
	Site site(Kind::Discrete);
	const auto steel = btElasticPlasticMaterial::steel(btScalar(235e6));
	const auto section = btElasticPlasticSection::rectangle(btScalar(0.05), btScalar(0.05));
	btRigidBody &wall = site.body(0, btVector3(1, 1, 1), at(btScalar(-0.5))),
				&block = site.body(8000, btVector3(2, btScalar(0.05), btScalar(0.05)), at(1));
	btElasticPlasticJoint& joint =
		site.join(wall, block, at(0), btElasticPlasticCapacity::fromMember(steel, section, 0, 2, btScalar(0.05)));
	site.run(5);
	int dof = -1;
	EXPECT_GE(joint.getUtilisation(&dof), 0.99);
	EXPECT_EQ(BT_EP_BENDING_Z, dof);
	site.run(55);
	EXPECT_TRUE(joint.isBroken());
}
}  // namespace testTroubles
