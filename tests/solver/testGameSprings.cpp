// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Loads that games apply by where bodies are, as springs of their own: grabbers, hovering, controllers.

#include <algorithm>
#include <math.h>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticEnergyAudit.h"
#include "support/Precision.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"
#include "world/World.h"

namespace testGameSprings
{
using namespace ep;

enum Way
{
	FORCE,
	IMPULSE
};

/// A steel bar of six blocks that hangs on nothing but what the game applies: a spring to where it was, without damping.
struct HeldBar
{
	enum
	{
		BLOCKS = 6
	};
	btMatrix3x3 m_turn;
	World m_world;
	Way m_way;
	double m_stiffness = 0;  ///< of all blocks' springs together [N/m]
	btRigidBody* m_blocks[BLOCKS];
	btVector3 m_origins[BLOCKS];

	HeldBar(Way way, double frequency, bool damps, const btMatrix3x3& turn)
		: m_turn(turn), m_world(Solver::Direct, btVector3(0, 0, 0)), m_way(way)
	{
		const double length = 0.5, height = 0.05, mass = 7850 * height * height * length;
		btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(235e6));
		if (!damps)
			steel.m_dampingRatio = 0;
		const btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(
			steel, btElasticPlasticSection::rectangle(btScalar(height), btScalar(height)), btScalar(length),
			btScalar(length));
		btCollisionShape* const box = m_world.box(btVector3(btScalar(length), btScalar(height), btScalar(height)));
		const auto place = [&](double x) { return btTransform(turn, turn * btVector3(btScalar(x), 0, 0)); };
		for (int i = 0; i < BLOCKS; ++i)
		{
			m_blocks[i] = m_world.body(btScalar(mass), box, place(i * length), false);
			m_origins[i] = m_blocks[i]->getCenterOfMassPosition();
			if (i > 0)
				m_world.joint(*m_blocks[i - 1], *m_blocks[i], place((i - 0.5) * length), capacity);
		}
		m_stiffness = pow(2 * SIMD_PI * frequency, 2) * mass;
		m_world.beforeSubsteps(
			[this](btScalar dt)
			{
				for (int i = 0; i < BLOCKS; ++i)
				{
					const btVector3 away = (m_blocks[i]->getCenterOfMassPosition() - m_origins[i]) * m_turn;
					const btVector3 force =
						m_turn * btVector3(0, btScalar(-m_stiffness) * away.y(), btScalar(-m_stiffness) * away.z());
					if (m_way == FORCE)
						m_blocks[i]->applyCentralForce(force);
					else
						m_blocks[i]->applyCentralImpulse(force * dt);
				}
			});
	}

	/// Of its middle, across.
	double height() const
	{
		btVector3 sum(0, 0, 0);
		for (int i = 0; i < BLOCKS; ++i)
			sum += m_blocks[i]->getCenterOfMassPosition() - m_origins[i];
		return double((sum * m_turn).y()) / BLOCKS;
	}
};

TEST(GameSprings, GiveNoMoreThanTheyTake)
{
	// Inner steps had them act half a step late: a bar that was struck twice a second swung ever wider, at 1/30 s by 10^5 times in 20 s.
	for (const Way way : {FORCE, IMPULSE})
		for (const double hz : {30., 60.})
			for (const double frequency : {1., 2.})
				for (const bool damps : {true, false})
				{
					const btMatrix3x3 turn(damps ? btQuaternion(0, 0, 0, 1)
												 : btQuaternion(btVector3(1, 2, 3).normalized(), 2));
					HeldBar bar(way, frequency, damps, turn);
					for (btRigidBody* block : bar.m_blocks)
						block->translate(turn * btVector3(0, btScalar(0.2), 0));
					double most = 0;
					for (int i = 0; i < int(20 * hz); ++i)
					{
						// To and fro across its swing.
						const int strikes = i / int(hz / 2);
						if (i % int(hz / 2) == 5)
							bar.m_blocks[2 + strikes % 2]->applyCentralImpulse(
								turn * btVector3(0, 0, btScalar(strikes % 2 == 0 ? 60 : -60)));
						bar.m_world.step(btScalar(1 / hz));
						if (i >= int(15 * hz))
							most = std::max(most, fabs(bar.height()));
					}
					SCOPED_TRACE(testing::Message() << way << " " << hz << " " << frequency << " " << damps);
					// At 15 steps a swing what the bar's bending does to it counts. Without damping it rings by all of 40 strikes, and its ringing, which
					// the game's springs follow from step to step, gives to its swing, too.
					const double share = !damps ? 0.6 : hz / frequency > 20 ? 0.05 : 0.15;
					EXPECT_NEAR(0.2, most, share * 0.2);
					EXPECT_EQ(0, bar.m_world.action().getNumBroken());
				}
}

TEST(GameSprings, GoOnAfterASnapshot)
{
	HeldBar bar(FORCE, 2, true, btMatrix3x3::getIdentity());
	for (btRigidBody* block : bar.m_blocks)
		block->translate(btVector3(0, btScalar(0.2), 0));
	const auto play = [&]
	{
		bar.m_blocks[3]->applyCentralImpulse(btVector3(0, 0, 60));
		for (int i = 0; i < 30; ++i)
			bar.m_world.step(btScalar(1) / 60);
		return bar.m_blocks[0]->getCenterOfMassPosition();
	};
	play();
	const std::vector<char> saved = bar.m_world.save();
	const btVector3 place = play();
	ASSERT_TRUE(bar.m_world.restore(saved));
	EXPECT_EQ(place, play());
}

TEST(GameSprings, KeepTheBooks)
{
	// What loads give with velocities was booked as gravity's.
	for (const double gravity : {0., 9.81})
	{
		HeldBar bar(FORCE, 2, true, btMatrix3x3::getIdentity());
		double weight = 0, height = 0;
		for (btRigidBody* block : bar.m_blocks)
		{
			block->translate(btVector3(0, btScalar(0.2), 0));
			block->setGravity(btVector3(0, btScalar(-gravity), 0));
			weight += gravity / double(block->getInvMass());
		}
		const double before = bar.height();
		btElasticPlasticEnergyAudit audit(bar.m_world.bullet(), bar.m_world.action());
		for (int i = 0; i < 300; ++i)
		{
			if (i % 30 == 5)
				bar.m_blocks[2]->applyCentralImpulse(btVector3(0, 0, 60));
			audit.begin();
			bar.m_world.step(btScalar(1) / 60);
		}
		height = bar.height() - before;
		const btElasticPlasticEnergyBalance& balance = audit.getBalance();
		EXPECT_GT(balance.m_turnover, 1000);
		EXPECT_NEAR(0, balance.m_rest, byPrecision(1e-9, 1e-4) * balance.m_turnover);
		// Weight times way, but for half a step of speed: velocities are not those of places.
		const double halfStep = weight * 2.6 / 120;
		EXPECT_NEAR(-weight * height, balance.m_gravity, halfStep + byPrecision(1e-9, 1e-2)) << gravity;
		// The springs' potential energy, but for that, too.
		double potential = 0;
		for (int i = 0; i < HeldBar::BLOCKS; ++i)
		{
			const btVector3 away = bar.m_blocks[i]->getCenterOfMassPosition() - bar.m_origins[i];
			potential += bar.m_stiffness / 2 * double(away.y() * away.y() + away.z() * away.z());
		}
		const double atBegin = bar.m_stiffness / 2 * HeldBar::BLOCKS * 0.04;
		EXPECT_NEAR(atBegin - potential, balance.m_loads, 0.1 * balance.m_turnover) << gravity;
	}
}

TEST(GameSprings, AThrustThatComesAtOnceIsNoBlow)
{
	// Two bodies on a spring of 20 Hz that swings at half of what it bears, so that there are inner steps; with the thrust it goes up to 0.9.
	for (const double hz : {30., 60.})
		for (const Way way : {FORCE, IMPULSE})
			for (int phase = 0; phase < 12; ++phase)
			{
				const double mass = 100, omega = 2 * SIMD_PI * 20, stiffness = omega * omega * mass / 2, strength = 1e4;
				World world(Solver::Direct, btVector3(0, 0, 0));
				btCollisionShape* const box = world.box(btVector3(btScalar(0.4), btScalar(0.4), btScalar(0.4)));
				btRigidBody *const a = world.body(btScalar(mass), box, at(0), false), *const b =
																						  world.body(btScalar(mass),
																									 box, at(1), false);
				const btElasticPlasticJoint* const joint =
					world.joint(*a, *b, at(0.5), evenCapacity(stiffness, strength));
				const double speed = 0.5 * strength / stiffness * omega;
				a->setLinearVelocity(btVector3(btScalar(speed / 2), 0, 0));
				b->setLinearVelocity(btVector3(btScalar(-speed / 2), 0, 0));
				// Half of it is for each body, and it swings to twice what it is at rest.
				const double thrust = 0.4 * strength;
				bool isOn = false;
				world.beforeSubsteps(
					[&](btScalar dt)
					{
						const btVector3 force(btScalar(isOn ? -thrust : 0), 0, 0);
						if (way == FORCE)
							a->applyCentralForce(force);
						else
							a->applyCentralImpulse(force * dt);
					});
				for (int i = 0; i < 60; ++i)
				{
					isOn = i >= 10 + phase && i < 40;
					world.step(btScalar(1 / hz));
				}
				if (way == FORCE)
				{
					EXPECT_EQ(0, joint->getPlasticEnergy()) << hz << " " << phase;
				}
				// All of what was given, whenever.
				const double momentum = -thrust * (30 - phase) / hz;
				EXPECT_NEAR(momentum, mass * double(a->getLinearVelocity().x() + b->getLinearVelocity().x()),
							byPrecision(1e-9, 1e-4) * fabs(momentum))
					<< hz << " " << phase;
			}
}
}  // namespace testGameSprings
