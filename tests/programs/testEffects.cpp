// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What is seen and heard of breaks, blows and charges.

#include <gtest/gtest.h>

#include <cmath>

#include "effects/Effects.h"
#include "world/Charge.h"

namespace testEffects
{
using namespace ep;

const btScalar STEP = btScalar(1) / 240;

/// A ball above the ground.
struct Fall
{
	World world;
	btRigidBody* ball;
	Effects effects;

	explicit Fall(btScalar mass, btScalar height)
	{
		world.body(0, world.keep(new btStaticPlaneShape(btVector3(0, 1, 0), 0)), btTransform::getIdentity());
		ball = world.body(mass, world.keep(new btSphereShape(btScalar(.5))),
						  btTransform(btQuaternion(0, 0, 0, 1), btVector3(0, height + btScalar(.5), 0)));
	}

	std::vector<Burst> run(int steps)
	{
		std::vector<Burst> all;
		for (int i = 0; i < steps; ++i)
		{
			effects.beforeStep(world);
			world.step(STEP);
			effects.afterStep(world, STEP);
			all.insert(all.end(), effects.bursts().begin(), effects.bursts().end());
		}
		return all;
	}
};

TEST(Effects, BlowHasTheEnergyOfWhatStrikes)
{
	// 100 kg from 1.25 m: 5 m/s. The step in which it touches has gone on for at most one step of gravity: 0.8 %.
	Fall fall(100, btScalar(1.25));
	const std::vector<Burst> bursts = fall.run(480);
	ASSERT_EQ(bursts.size(), 1u) << "and none while it lies";
	EXPECT_EQ(bursts[0].kind, Burst::Kind::Blow);
	EXPECT_NEAR(bursts[0].energy, 1250, 25);
	EXPECT_NEAR(double(bursts[0].place.y()), 0, .03);
}

TEST(Effects, BlowOfTwoThatAreFreeHasTheirCommonMass)
{
	Fall fall(100, 10);
	fall.world.bullet().setGravity(btVector3(0, 0, 0));
	fall.ball->setGravity(btVector3(0, 0, 0));
	btRigidBody* const other = fall.world.body(300, fall.world.keep(new btSphereShape(btScalar(.5))),
											   btTransform(btQuaternion(0, 0, 0, 1), btVector3(2, btScalar(10.5), 0)));
	other->setGravity(btVector3(0, 0, 0));
	other->setLinearVelocity(btVector3(-6, 0, 0));
	const std::vector<Burst> bursts = fall.run(120);
	ASSERT_EQ(bursts.size(), 1u);
	EXPECT_NEAR(bursts[0].energy, .5 * 75 * 36, 1);
}

TEST(Effects, DustAndSparksAreMoreWithMoreEnergyAndGo)
{
	size_t last = 0;
	for (double energy : {1e2, 1e3, 1e4, 1e5, 1e6})
		for (bool isSteel : {false, true})
		{
			Particles particles, again;
			for (Particles* each : {&particles, &again})
				each->add({Burst::Kind::Break, btVector3(0, 3, 0), energy, isSteel});
			const std::vector<Puff> puffs = particles.puffs(), same = again.puffs();
			ASSERT_EQ(puffs.size(), same.size());
			for (size_t i = 0; i < puffs.size(); ++i)
				EXPECT_EQ(puffs[i].trace, same[i].trace) << "the same each time";
			EXPECT_GT(puffs.size(), isSteel ? last : 0);
			last = isSteel ? puffs.size() : last;
			for (int i = 0; i < 60 * 4; ++i)
				particles.step(btScalar(1) / 60);
			EXPECT_TRUE(particles.puffs().empty());
		}
	Particles quiet;
	quiet.add({Burst::Kind::Break, btVector3(0, 3, 0), 5, true});
	EXPECT_TRUE(quiet.puffs().empty()) << "what hardly anybody would see";
}

TEST(Charge, GivesTheImpulseOfItsWave)
{
	// 8 kg: 400 * 8^(2/3) = 1600 Pa s m. A ball's box of 1 m^2 at 4 m gets 400 N s; so does, by a fourth of that, one 16 m away.
	Fall fall(100, 0);
	btRigidBody* const far = fall.world.body(100, fall.world.keep(new btSphereShape(btScalar(.5))),
											 btTransform(btQuaternion(0, 0, 0, 1), btVector3(16, btScalar(.5), 0)));
	fall.ball->setWorldTransform(btTransform(btQuaternion(0, 0, 0, 1), btVector3(0, btScalar(.5), 4)));
	btVector3 low, high;
	fall.ball->getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
	const double area = double((high.x() - low.x()) * (high.y() - low.y()));
	blowCharge(fall.world, btVector3(0, btScalar(.5), 0), 8);
	EXPECT_NEAR(double(fall.ball->getLinearVelocity().z()), 4 * area, 1e-3);
	EXPECT_NEAR(double(far->getLinearVelocity().x()), area, 1e-3);
	EXPECT_EQ(fall.ball->getLinearVelocity().x(), 0);
}
}  // namespace testEffects
