// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// btElasticPlasticSolverSettings::m_keepsSwings: what comes to yield by swinging beyond its equilibrium.

#include <math.h>

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "support/Repeats.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testSwings
{
using namespace ep;

void keepSwings(World& world)
{
	btElasticPlasticSolverSettings settings = solverOf(world).getSettings();
	settings.m_keepsSwings = true;
	solverOf(world).setSettings(settings);
}

/// A steel cantilever of 4 m in eight blocks with 3 t at its tip. It takes 28 steps of 1/60 s to swing to and fro.
struct LoadedCantilever
{
	static constexpr int BLOCKS = 8;
	static constexpr double LENGTH = 4, BLOCK = LENGTH / BLOCKS;  // [m]

	World m_world;
	btRigidBody* m_tip = nullptr;
	double m_plasticMoment = 0;  ///< [N m]
	std::mt19937 m_random{1};
	std::uniform_real_distribution<double> m_jitter{-1, 1};

	LoadedCantilever(const Method& method, bool hasFibres) : m_world(method, btVector3(0, 0, 0))
	{
		const btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(235e6);
		btElasticPlasticSection section =
			btElasticPlasticSection::iSection(btScalar(0.2), btScalar(0.2), btScalar(0.009), btScalar(0.015));
		if (hasFibres)
			section = section.withFibres();
		btCollisionShape* const box = m_world.box(btVector3(btScalar(BLOCK), btScalar(0.2), btScalar(0.2)));
		btRigidBody* last = m_world.body(0, box, at(-BLOCK / 2), false);
		for (int i = 0; i < BLOCKS; ++i)
		{
			const double mass = 7850 * double(section.m_area) * BLOCK + (i == BLOCKS - 1 ? 3000 : 0);
			m_tip = m_world.body(btScalar(mass), box, at(BLOCK * (i + 0.5)), false);
			const btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(
				steel, section, btScalar(i > 0 ? BLOCK : 0), btScalar(BLOCK), btScalar(0.2));
			m_plasticMoment = double(capacity.m_yield[BT_EP_BENDING_Z]);
			m_world.joint(*last, *m_tip, at(BLOCK * i), capacity);
			last = m_tip;
		}
	}

	/// A force across the tip comes on at once, and stays. \param share  of what the foot bears
	/// \param jitter  by which share steps are longer or shorter at most
	/// \return plastic energy after 3 s [J]
	double load(double share, double hz, double jitter = 0)
	{
		const double force = share * m_plasticMoment / (LENGTH - BLOCK / 2);
		for (int i = 0; i < int(3 * hz); ++i)
		{
			m_tip->applyCentralForce(btVector3(0, btScalar(-force), 0));
			m_world.step(btScalar((1 + jitter * m_jitter(m_random)) / hz));
		}
		double plastic = 0;
		for (const btElasticPlasticJoint* joint : m_world.joints())
			plastic += joint->getPlasticEnergy();
		return plastic;
	}
};

TEST(Swings, LoadsThatComeOnAtOnceDoTheirDamage)
{
	// Damped by row, 18 to 72 % of it is missing at 1/60 s, and 8 to 23 % at 1/240 s.
	for (const bool hasFibres : {false, true})
		for (const double share : {0.65, 0.8, 0.95})
		{
			const double exact = LoadedCantilever(withoutInnerSteps(), hasFibres).load(share, 3840);
			for (const double hz : {30., 60., 240.})
			{
				LoadedCantilever cantilever(Solver::Direct, hasFibres);
				keepSwings(cantilever.m_world);
				// What inner steps are right to; the reference still lacks 1 %.
				EXPECT_NEAR(exact, cantilever.load(share, hz), 0.05 * exact) << hasFibres << share << " " << hz;
			}
		}
}

TEST(Swings, AreKeptWhereTheFrameTimeWavers)
{
	// What differs from the last step by anything had no past: at +-5 % a third of the damage was missing again.
	for (const bool hasFibres : {false, true})
	{
		LoadedCantilever even(Solver::Direct, hasFibres), wavering(Solver::Direct, hasFibres);
		keepSwings(even.m_world);
		keepSwings(wavering.m_world);
		const double exact = even.load(0.8, 60);
		EXPECT_NEAR(exact, wavering.load(0.8, 60, 0.05), 0.05 * exact) << hasFibres;
	}
}

TEST(Swings, OfRandomChainsGainNothing)
{
	// Struck and shaken chains that flow. In a single step more may be told than there is, by half a step's power, but nothing is made.
	std::mt19937 random(1);
	const auto between = [&](double least, double most)
	{ return std::uniform_real_distribution<double>(least, most)(random); };
	double worst = 0, worstEnd = 0;
	for (int run = 0; run < repeats(300, 60); ++run)
	{
		World world(Solver::Direct, btVector3(0, 0, 0));
		keepSwings(world);
		btCollisionShape* const box = world.box(btVector3(btScalar(0.5), btScalar(0.2), btScalar(0.2)));
		const int blocks = 2 + run % 7;
		const bool isHeld = run % 3 > 0;
		std::vector<btRigidBody*> bodies;
		const double stiffness = pow(10, between(4, 9)), yield = pow(10, between(1, 4));
		for (int i = 0; i < blocks; ++i)
		{
			bodies.push_back(world.body(btScalar(i == 0 && isHeld ? 0 : between(5, 100)), box, at(0.5 * i), false));
			if (i > 0)
			{
				btElasticPlasticCapacity capacity = evenCapacity(stiffness, yield);
				capacity.m_damping = btScalar(0.01);
				world.joint(*bodies[size_t(i - 1)], *bodies[size_t(i)], at(0.5 * i - 0.25), capacity);
			}
		}
		for (btRigidBody* body : bodies)
			if (body->getInvMass() > 0)
			{
				body->setLinearVelocity(
					btVector3(btScalar(between(-1, 1)), btScalar(between(-1, 1)), btScalar(between(-1, 1))));
				body->setAngularVelocity(
					btVector3(btScalar(between(-2, 2)), btScalar(between(-2, 2)), btScalar(between(-2, 2))));
			}
		const double hz = run % 2 ? 60 : 240;
		const double atPlay = world.kineticEnergy();
		double most = 0, energy = 0;
		for (int i = 0; i < int(2 * hz); ++i)
		{
			world.step(btScalar(1 / hz));
			energy = world.kineticEnergy();
			for (const btElasticPlasticJoint* joint : world.joints())
				energy += joint->getElasticEnergy() + joint->getPlasticEnergy() + joint->getDampingEnergy();
			most = std::max(most, energy / atPlay - 1);
		}
		worst = std::max(worst, most);
		worstEnd = std::max(worstEnd, energy / atPlay - 1);
	}
	EXPECT_LT(worst, 0.003);
	EXPECT_LT(worstEnd, 0.0005);
}

TEST(Swings, AreKeptWhereNothingElseGivesEnergyToThem)
{
	// Whatever touches the structure, and what does not damp, has the scheme that calms down.
	for (const bool isAsked : {false, true})
		for (const int hindrance : {0, 1, 2})
		{
			double after[2];
			for (const bool keeps : {false, true})
			{
				World world(Solver::Direct, btVector3(0, 0, 0));
				if (keeps && isAsked)
					keepSwings(world);
				btCollisionShape* const box = world.box(btVector3(1, 1, 1));
				btRigidBody *last = world.body(0, box, at(0)), *tip = nullptr;
				for (int i = 1; i <= 4; ++i)
				{
					btElasticPlasticCapacity capacity = evenCapacity(1e7, 1e9);
					capacity.m_damping = btScalar(hindrance == 1 ? 0 : 0.01);
					tip = world.body(100, box, at(i));
					world.joint(*last, *tip, at(i - 0.5), capacity);
					last = tip;
				}
				if (hindrance == 2)
					world.body(1, box, at(4, 1));
				tip->setLinearVelocity(btVector3(0, 0, 1));
				for (int i = 0; i < 60; ++i)
					world.step(btScalar(1) / 60);
				after[keeps] = double(tip->getCenterOfMassPosition().z());
			}
			EXPECT_EQ(isAsked && hindrance == 0, after[0] != after[1]) << isAsked << hindrance;
		}
}
}  // namespace testSwings
