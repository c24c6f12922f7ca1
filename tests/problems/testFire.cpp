// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Steel in a fire, by the factors of EN 1993-1-2.

#include <cmath>

#include <gtest/gtest.h>

#include "support/Close.h"
#include "support/Run.h"
#include "world/Place.h"

namespace
{
using namespace ep;

const double SIDE = 0.02, YIELD = 250e6, NP = SIDE * SIDE * YIELD, MP = NP * SIDE / 4;

TEST(Fire, HasTheFactorsOfTheStandard)
{
	const double table[][3] = {{-20, 1, 1},          {20, 1, 1},        {100, 1, 1},       {400, 1, 0.7},
							   {500, 0.78, 0.6},     {600, 0.47, 0.31}, {700, 0.23, 0.13}, {900, 0.06, 0.0675},
							   {1100, 0.02, 0.0225}, {1200, 0, 0},      {2000, 0, 0},      {150, 1, 0.95},
							   {550, 0.625, 0.455}};
	for (const auto& line : table)
	{
		const btElasticPlasticHeat heat = btElasticPlasticHeat::steel(btScalar(line[0]));
		EXPECT_NEAR(line[1], heat.m_strength, 1e-6) << line[0];
		EXPECT_NEAR(line[2], heat.m_stiffness, 1e-6) << line[0];
	}
}

btElasticPlasticCapacity capacity(bool withFibres, double lengthA = 1)
{
	const btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE));
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(YIELD));
	steel.m_ultimatePlasticStrain = btScalar(1e6);
	return btElasticPlasticCapacity::fromMember(steel, withFibres ? section.withFibres() : section, btScalar(lengthA),
												1);
}

/// Lets bodies come to rest while they are heated.
void calm(World& world, int steps)
{
	for (int i = 0; i < steps; ++i)
	{
		for (const auto& body : world.bodies())
		{
			body->setLinearVelocity(body->getLinearVelocity() * btScalar(0.9));
			body->setAngularVelocity(body->getAngularVelocity() * btScalar(0.9));
		}
		world.step(btScalar(1) / 240);
	}
}

TEST(Fire, BringsARodDownThatBearsItsLoadNoMore)
{
	// 0.4 is left at 629.2 degrees, between 0.47 at 600 and 0.23 at 700.
	for (const Solver solver : {Solver::Direct, Solver::Iterative})
		for (const bool withFibres : {false, true})
		{
			World world(solver, btVector3(-10, 0, 0));
			btCollisionShape* const box = world.box(btVector3(1, btScalar(0.5), btScalar(0.5)));
			btRigidBody* const load = world.body(btScalar(0.4 * NP / 10), box, at(btScalar(-0.5)), false);
			btElasticPlasticJoint* const joint =
				world.joint(*load, *world.body(0, box, at(btScalar(0.5)), false), at(0), capacity(withFibres));
			const btElasticPlasticCapacity cold = joint->getCapacity();
			const auto heat = [&](double temperature)
			{ return joint->setCapacity(cold.heated(btElasticPlasticHeat::steel(btScalar(temperature)))); };
			calm(world, 240);
			double temperature = 20;
			for (; !joint->hasYielded() && temperature < 1200; temperature += 0.25)
			{
				ASSERT_TRUE(heat(temperature));
				calm(world, 1);
			}
			// The stiffness of fibres is not as their area: the first flows when 0.97 of the strength is reached.
			EXPECT_NEAR(629.2, temperature, withFibres ? 7 : 2);
			// At half of the strength that it needs it falls by a quarter of g at least.
			const double place = load->getCenterOfMassPosition().x();
			ASSERT_TRUE(heat(720));
			run(world, 120, btScalar(1) / 240);
			EXPECT_LT(double(load->getCenterOfMassPosition().x()) - place, -0.5 * 2.5 * 0.5 * 0.5);
		}
}

TEST(Fire, BringsACantileverDown)
{
	// The load bends the root with 0.6 M_p, which is left at 558.1 degrees. Until then it stays where it is: a stiffness that changes under
	// load keeps its force.
	for (const bool withFibres : {false, true})
	{
		World world(Solver::Direct, btVector3(0, -10, 0));
		btCollisionShape* const box = world.box(btVector3(1, btScalar(0.1), btScalar(0.1)));
		const double mass = 0.6 * MP / 10 / 0.5;
		btRigidBody* const ground = world.body(0, box, at(btScalar(-0.5)), false);
		btRigidBody* const beam = world.body(btScalar(mass), box, at(btScalar(0.5)), false);
		btElasticPlasticJoint* const joint = world.joint(*ground, *beam, at(0), capacity(withFibres, 0));
		const btElasticPlasticCapacity cold = joint->getCapacity();
		calm(world, 480);
		const double sag = -double(beam->getCenterOfMassPosition().y());
		double temperature = 20;
		const auto heatTo = [&](double goal)
		{
			for (; temperature < goal; temperature += 0.5)
			{
				ASSERT_TRUE(joint->setCapacity(cold.heated(btElasticPlasticHeat::steel(btScalar(temperature)))));
				calm(world, 1);
			}
		};
		// Fibres of the outermost orbit flow before all of them do: at 0.6 of the moment from 470 degrees on.
		heatTo(440);
		EXPECT_NEAR(sag, -double(beam->getCenterOfMassPosition().y()), 0.02 * sag) << withFibres;
		EXPECT_FALSE(joint->hasYielded());
		heatTo(553);
		EXPECT_LT(-double(beam->getCenterOfMassPosition().y()), 3 * sag);
		heatTo(563);
		EXPECT_TRUE(joint->hasYielded());
		run(world, 240, btScalar(1) / 240);
		EXPECT_LT(double(beam->getCenterOfMassPosition().y()), -5 * sag);
	}
}

TEST(Fire, LeavesNothingAt1200Degrees)
{
	for (const bool withFibres : {false, true})
	{
		const btElasticPlasticCapacity hot = capacity(withFibres).heated(btElasticPlasticHeat::steel(1200));
		EXPECT_FALSE(hot.fault());
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			EXPECT_FALSE(hot.isElasticPlastic(dof));
		btElasticPlasticHeat bad;
		bad.m_strength = btScalar(NAN);
		EXPECT_STREQ("what heat leaves of strength", capacity(withFibres).heated(bad).fault().m_quantity);
		bad = btElasticPlasticHeat();
		bad.m_stiffness = -1;
		EXPECT_STREQ("what heat leaves of stiffness", capacity(withFibres).heated(bad).fault().m_quantity);
	}
}
}  // namespace
