// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Random things dropped on random structures: bodies have no more energy than at the start.

#include <math.h>

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "scenes/Member.h"
#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "support/Repeats.h"

namespace testDrops
{
using namespace ep;

/// A box, a sphere or a capsule over a beam, a plate or a portal frame of 2 to 24 blocks a member.
class RandomDrop
{
public:
	explicit RandomDrop(unsigned seed) : m_world(Solver::Direct), m_random(seed)
	{
		m_mass = spread(1, 1e4);
		m_height = spread(.1, 10);
		m_restitution = uniform(0, 1) < .5 ? 0 : uniform(0, .5);
		const double rates[] = {30, 60, 120, 240};
		m_rate = rates[int(uniform(0, 4))];
		Member::Settings settings;
		settings.material = btElasticPlasticMaterial::steel(btScalar(250e6));
		settings.parts = 2 + int(uniform(0, 23));
		settings.collides = true;
		build(int(uniform(0, 3)), settings);
		addFalling(int(uniform(0, 3)));
		for (const auto& body : m_world.bodies())
			body->setRestitution(btScalar(sqrt(m_restitution)));
	}

	World m_world;
	double m_mass, m_height, m_restitution, m_rate;

	/// Kinetic and potential [J].
	double bodiesEnergy() const
	{
		double energy = m_world.kineticEnergy();
		for (const auto& body : m_world.bodies())
			if (body->getInvMass() > 0)
				energy += GRAVITY * double(body->getCenterOfMassPosition().y()) / double(body->getInvMass());
		return energy;
	}
	double fall() const { return m_mass * GRAVITY * m_height; }

	static constexpr double GRAVITY = 10;

private:
	void build(int kind, Member::Settings settings)
	{
		btCollisionShape* const cube = m_world.box(btVector3(HALF, HALF, HALF) * 2);
		const auto support = [&](double x, double y) -> btRigidBody&
		{ return *m_world.body(0, cube, at(btScalar(x), btScalar(y)), false); };
		if (kind == 2)
		{
			const btMatrix3x3 upwards(0, -1, 0, 1, 0, 0, 0, 0, 1);
			const btScalar storey = 2;
			Member beam(m_world, settings, at(0), LENGTH);
			settings.parts = std::max(2, settings.parts / 3);
			for (const bool isFirst : {true, false})
			{
				const btScalar x = isFirst ? -HALF : LENGTH + HALF;
				Member column(m_world, settings, btTransform(upwards, btVector3(x, -storey - HALF, 0)), storey);
				column.joinStart(m_world, support(double(x), double(-storey - 2 * HALF)));
				isFirst ? beam.joinStart(m_world, column.last()) : beam.joinEnd(m_world, column.last());
			}
			return;
		}
		if (kind == 1)
		{
			settings.width = 1;
			settings.height = HALF;
		}
		Member member(m_world, settings, at(0), LENGTH);
		member.joinStart(m_world, support(double(-HALF), 0));
		member.joinEnd(m_world, support(double(LENGTH + HALF), 0));
	}

	void addFalling(int kind)
	{
		btCollisionShape* const shape = kind == 0   ? m_world.box(btVector3(btScalar(.6), btScalar(.6), btScalar(.6)))
										: kind == 1 ? m_world.keep(new btSphereShape(btScalar(.3)))
													: m_world.keep(new btCapsuleShape(btScalar(.2), btScalar(.4)));
		const btVector3 axis = btVector3(btScalar(.3), btScalar(.5), btScalar(.8)).normalized();
		const double turn = uniform(0, 1) < .5 ? 0 : uniform(0, 3), x = uniform(.3, 3.7), z = uniform(-.2, .2);
		const btVector3 place(btScalar(x), btScalar(.6 + m_height), btScalar(z));
		m_world.body(btScalar(m_mass), shape, btTransform(btQuaternion(axis, btScalar(turn)), place));
	}

	double uniform(double least, double most) { return std::uniform_real_distribution<double>(least, most)(m_random); }
	double spread(double least, double most) { return exp(uniform(log(least), log(most))); }

	const btScalar LENGTH = 4, HALF = btScalar(.05);
	std::mt19937 m_random;
};

/// \param innerError  for inner steps, 0: none
void dropAll(double innerError, int drops)
{
	for (unsigned seed = 0; seed < unsigned(drops); ++seed)
	{
		RandomDrop drop(seed);
		btElasticPlasticSolverSettings settings = solverOf(drop.m_world).getSettings();
		settings.m_innerError = innerError;
		ASSERT_TRUE(solverOf(drop.m_world).setSettings(settings));
		const double before = drop.bodiesEnergy(), seconds = sqrt(2 * drop.m_height / RandomDrop::GRAVITY) + .6;
		double most = before;
		for (int i = 0; i < int(seconds * drop.m_rate); ++i)
		{
			drop.m_world.step(btScalar(1 / drop.m_rate));
			most = std::max(most, drop.bodiesEnergy());
		}
		SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << drop.m_mass << " kg from " << drop.m_height
										<< " m, restitution " << drop.m_restitution << ", rate " << drop.m_rate);
		// Rounding. (What joints tell besides may be half a step ahead, see limits.md.)
		EXPECT_LE(most, before + byPrecision(1e-9, 1e-5) * drop.fall());
	}
}

/// The largest axial force of any joint until things have landed [N].
double largestPull(unsigned seed, bool isFine)
{
	RandomDrop drop(seed);
	btElasticPlasticSolverSettings settings = solverOf(drop.m_world).getSettings();
	settings.m_innerError = isFine ? 0 : settings.m_innerError;
	EXPECT_TRUE(solverOf(drop.m_world).setSettings(settings));
	const double fall = sqrt(2 * drop.m_height / RandomDrop::GRAVITY), fine = 15360;
	double largest = 0, time = 0;
	while (time < fall + .4)
	{
		// Where nothing has happened yet the world's own steps will do.
		const double rate = isFine && time > .9 * fall ? fine : drop.m_rate;
		drop.m_world.step(btScalar(1 / rate));
		time += 1 / rate;
		for (const btElasticPlasticJoint* joint : drop.m_world.joints())
			largest = std::max(largest, fabs(double(joint->getAppliedForce(BT_EP_AXIAL))));
	}
	return largest;
}

TEST(Drops, PullAsHardAsInShortSteps)
{
	// Of 300 of these the ones whose pull is 3 to 6 times that of steps of 1/3840 s, which damp its waves: it is that of steps of 1/15360 s.
	for (const unsigned seed : {51u, 120u, 129u})
	{
		const double ratio = largestPull(seed, false) / largestPull(seed, true);
		EXPECT_LT(ratio, 2) << seed;
		EXPECT_GT(ratio, .5) << seed;
	}
}

TEST(Drops, MakeNoEnergy) { dropAll(0, repeats(2000, 200)); }

TEST(Drops, MakeNoneInInnerSteps) { dropAll(0.05, repeats(2000, 80)); }
}  // namespace testDrops
