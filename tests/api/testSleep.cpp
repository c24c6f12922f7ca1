// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Which bodies of joints sleep, and what wakes them.

#include <memory>

#include <gtest/gtest.h>

#include "support/Pair.h"

namespace testSleep
{
using namespace ep;

/// Lets bodies sleep as Bullet does: below 0.8 m/s and 1 rad/s for two seconds.
void allowSleep(World& world)
{
	for (const auto& body : world.bodies())
		body->forceActivationState(ACTIVE_TAG);
}

btElasticPlasticCapacity thatBreaks(btElasticPlasticCapacity capacity, btScalar ductility)
{
	for (btScalar& each : capacity.m_ductility)
		each = ductility;
	return capacity;
}

/// A block between a wall and a kinematic body that pulls, with a joint to either; without gravity.
struct Pulled
{
	Pair m_pair{Solver::Direct};
	btRigidBody* m_puller;
	btElasticPlasticJoint *m_held, *m_pulled;
	btScalar m_way = 0;

	/// \param isTurned  the block is body B of the joint that is pulled, and pulled the other way along its axis
	explicit Pulled(const btElasticPlasticCapacity& capacity, bool isTurned = false)
	{
		World& world = m_pair.m_world;
		m_puller = world.body(0, world.box(btVector3(1, 1, 1)), at(2), false);
		makeKinematic(*m_puller);
		m_held = m_pair.join(evenCapacity(1e6, 1e5));
		btRigidBody &a = isTurned ? *m_puller : *m_pair.m_b, &b = isTurned ? *m_pair.m_b : *m_puller;
		m_pulled = world.joint(a, b, at(1.5), capacity);
		allowSleep(world);
		m_puller->forceActivationState(DISABLE_DEACTIVATION);
	}

	void pull(btScalar speed, int steps)
	{
		for (int i = 0; i < steps; ++i)
		{
			m_way += speed * FRAME;
			m_puller->setWorldTransform(at(2 + m_way));
			m_pair.m_world.step(FRAME);
		}
	}
};

TEST(Sleep, SlowFlowBreaksAJoint)
{
	for (bool isTurned : {false, true})
	{
		// 1 kN at 1 mm, breaks after 0.2 m more: by the pull of 0.03 m/s after 6.7 s.
		Pulled scene(thatBreaks(evenCapacity(1e6, 1e3), btScalar(0.2)), isTurned);
		scene.pull(btScalar(0.03), 6 * 60);
		EXPECT_FALSE(scene.m_pulled->isBroken());
		scene.pull(btScalar(0.03), 60);
		EXPECT_TRUE(scene.m_pulled->isBroken());
		// The wall's joint gave 1 mm; a way is known to two steps of the pull.
		EXPECT_NEAR(0.2, scene.m_pulled->getPlasticPath(BT_EP_AXIAL), 2 * 0.03 / 60);
	}
}

TEST(Sleep, SlowLoadingIsFollowed)
{
	// 2 kN/m by the two springs in a row, of which 0.05 mm/s make 0.1 N/s: yield, 1.5 N, would be reached after 15 s.
	Pulled scene(evenCapacity(4e3, 3));
	scene.m_held->setCapacity(evenCapacity(4e3, 1e5));
	for (int second = 1; second <= 14; ++second)
	{
		scene.pull(btScalar(5e-5), 60);
		// The load may change by a share of 0.05 of the yield value, 3 N, until it is seen.
		EXPECT_NEAR(0.1 * second, scene.m_pulled->getForce(BT_EP_AXIAL), 0.05 * 3) << second << " s";
	}
}

TEST(Sleep, WhatStandsOnAMovingBodyStaysAwakeOrWakes)
{
	for (bool isKinematic : {true, false})
	{
		SCOPED_TRACE(isKinematic ? "kinematic" : "static");
		Pair pair(Solver::Direct);
		if (isKinematic)
			makeKinematic(*pair.m_a);
		btElasticPlasticJoint* joint = pair.join(evenCapacity(1e4, 1e5));
		allowSleep(pair.m_world);
		run(pair.m_world, 3 * 60);
		ASSERT_FALSE(pair.m_b->isActive());
		// By half a metre, all at once or slowly.
		const int steps = isKinematic ? 20 * 60 : 1;
		for (int i = 1; i <= steps; ++i)
		{
			pair.m_a->setWorldTransform(at(-btScalar(0.5) * btScalar(i) / btScalar(steps)));
			pair.m_world.step(FRAME);
			EXPECT_TRUE(pair.m_b->isActive()) << i;
		}
		if (isKinematic)
			// 12 kg that follow at 25 mm/s on 10 kN/m sway by 0.9 mm.
			EXPECT_NEAR(0.5, pair.m_b->getCenterOfMassPosition().x(), 1e-3);
		else
		{
			// 5 kN by the support's half metre act in the step that comes: on 12 kg by 10 kN/m they are a sway of 4.6 steps.
			run(pair.m_world, 1);
			EXPECT_LT(joint->getForce(BT_EP_AXIAL), 5000);
			EXPECT_GT(joint->getForce(BT_EP_AXIAL), 2500);
		}
	}
}

TEST(Sleep, AtRestEverythingSleeps)
{
	for (Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (btScalar turn : {btScalar(0), btScalar(0.7)})
		{
			// A support that is turned, and far from the origin, where float rounds places to 0.06 mm, of 0.5 mm to yield.
			Pair pair(solver, 0, 12, btVector3(0, -10, 0));
			const btTransform place(btQuaternion(btVector3(1, 2, 3).normalized(), turn), btVector3(1000, 0, 0));
			makeKinematic(*pair.m_a);
			pair.m_a->setWorldTransform(place * at(0));
			pair.m_b->setWorldTransform(place * at(1));
			pair.m_frame = place * pair.m_frame;
			pair.join(evenCapacity(1e6, 500));
			allowSleep(pair.m_world);
			pair.m_a->forceActivationState(DISABLE_DEACTIVATION);
			run(pair.m_world, 10 * 60);
			EXPECT_FALSE(pair.m_b->isActive()) << int(solver) << ", " << turn;
		}
}

TEST(Sleep, AnotherCapacityWakesAndTheSameDoesNot)
{
	Pair pair(Solver::Direct, 0, 12, btVector3(0, -10, 0));
	btElasticPlasticJoint* joint = pair.join(evenCapacity(1e6, 1e4));
	allowSleep(pair.m_world);
	run(pair.m_world, 4 * 60);
	ASSERT_FALSE(pair.m_b->isActive());
	const btScalar height = pair.m_b->getCenterOfMassPosition().y();
	btElasticPlasticCapacity capacity = joint->getCapacity();
	ASSERT_TRUE(joint->setCapacity(capacity));
	EXPECT_FALSE(pair.m_b->isActive());
	// 120 N of weight at a lever of 0.5 m: 50 N m do not hold it.
	capacity.scaleYield(btScalar(0.005));
	ASSERT_TRUE(joint->setCapacity(capacity));
	EXPECT_TRUE(pair.m_b->isActive());
	run(pair.m_world, 60);
	EXPECT_LT(pair.m_b->getCenterOfMassPosition().y(), height - btScalar(0.1));
}

/// Two free bodies that have slept for a while, so that the end of a step passes over their joint.
struct AsleepInSpace
{
	Pair m_pair;
	btElasticPlasticJoint* m_joint;

	explicit AsleepInSpace(Solver solver) : m_pair(solver, 12, 12)
	{
		m_joint = m_pair.join(thatBreaks(evenCapacity(1e6, 1e3), btScalar(0.01)));
		allowSleep(m_pair.m_world);
		run(m_pair.m_world, 3 * 60);
	}

	bool sleeps() const { return !m_pair.m_a->isActive() && !m_pair.m_b->isActive(); }

	int numEvents(btElasticPlasticEventType type)
	{
		int number = 0;
		for (btElasticPlasticEvent event; m_pair.m_world.action().popEvent(event);)
			number += event.m_type == type;
		return number;
	}
};

TEST(Sleep, AJointThatHasSleptYieldsAndBreaksOnceStruck)
{
	for (Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
	{
		AsleepInSpace scene(solver);
		ASSERT_TRUE(scene.sleeps());
		scene.m_pair.m_b->activate();
		// 6 kg of both against each other at 20 m/s are 1200 J, for 10 J until it breaks.
		scene.m_pair.m_b->setLinearVelocity(btVector3(20, 0, 0));
		run(scene.m_pair.m_world, 10);
		EXPECT_TRUE(scene.m_joint->isBroken()) << int(solver);
		EXPECT_EQ(1, scene.numEvents(BT_EP_EVENT_BREAK)) << int(solver);
		EXPECT_EQ(0, scene.m_pair.m_world.bullet().getNumConstraints());
	}
}

TEST(Sleep, AJointThatIsPutBackBrokenLeavesTheWorldThoughItSleeps)
{
	AsleepInSpace scene(Solver::Direct);
	ASSERT_TRUE(scene.sleeps());
	btElasticPlasticState state = scene.m_joint->getState();
	state.m_broken = true;
	ASSERT_TRUE(scene.m_joint->setState(state));
	run(scene.m_pair.m_world, 1);
	EXPECT_EQ(0, scene.m_pair.m_world.bullet().getNumConstraints());
	state.m_broken = false;
	ASSERT_TRUE(scene.m_joint->setState(state));
	run(scene.m_pair.m_world, 1);
	EXPECT_EQ(1, scene.m_pair.m_world.bullet().getNumConstraints());
	EXPECT_EQ(0, scene.m_pair.m_world.action().getNumBroken());
}

TEST(Sleep, ARemovedBodyWakesWhatStoodOnItAndWhatItHeld)
{
	World world(Solver::Direct);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody *ground = world.body(0, cube, at(0, -1)), *pillar = world.body(12, cube, at(0)),
				*top = world.body(12, cube, at(0, 1)), *arm = world.body(12, cube, at(1));
	world.joint(*pillar, *arm, at(btScalar(0.5)), evenCapacity(1e6, 1e4));
	world.joint(*ground, *pillar, at(0, btScalar(-0.5)), evenCapacity(1e6, 1e4));
	allowSleep(world);
	run(world, 4 * 60);
	ASSERT_FALSE(top->isActive() || arm->isActive());
	world.action().removeBody(world.bullet(), *pillar);
	EXPECT_TRUE(top->isActive() && arm->isActive());
	run(world, 12);
	// Half a second's fifth of free fall, at Bullet's steps: g dt^2 n (n + 1) / 2.
	const double fall = 10 * double(FRAME) * double(FRAME) * 12 * 13 / 2;
	EXPECT_NEAR(1 - fall, top->getCenterOfMassPosition().y(),
				2e-3);  // it had settled into its contacts by a millimetre
}

TEST(Sleep, WhatWakesInASubstepHasItsWeight)
{
	for (int substeps : {1, 4})
	{
		Pair pair(Solver::Direct, 0, 12, btVector3(0, -10, 0));
		makeKinematic(*pair.m_a);
		btElasticPlasticJoint* joint = pair.join(evenCapacity(1e7, 1e6));
		allowSleep(pair.m_world);
		run(pair.m_world, 4 * 60);
		ASSERT_FALSE(pair.m_b->isActive());
		const btScalar moment = joint->getForce(BT_EP_BENDING_Z);
		ASSERT_GT(btFabs(moment), 50);
		// The support moves in the first substep, by too little to load the joint.
		pair.m_a->setWorldTransform(at(btScalar(1e-6)));
		pair.m_world.bullet().stepSimulation(btScalar(substeps) * FRAME, substeps, FRAME);
		ASSERT_TRUE(pair.m_b->isActive());
		pair.m_world.bullet().stepSimulation(FRAME, 1, FRAME);
		// Without its weight for a substep it would spring up: 60 N m by a part of them.
		EXPECT_NEAR(moment, joint->getForce(BT_EP_BENDING_Z), 0.01 * btFabs(moment));
	}
}

TEST(Sleep, SmallVibrationsAreSleptThrough)
{
	for (btScalar share : {btScalar(0.05), btScalar(0.0005), btElasticPlasticCapacity::unlimited()})
	{
		Pair pair(Solver::Direct);
		ASSERT_TRUE(pair.m_world.action().setWakingShare(share));
		// 12 kg on 1 kN/m swing at 9.1 rad/s; 1 mm/s makes 0.11 N, of 10 N to yield 1 % to either side.
		pair.join(evenCapacity(1e3, 10));
		allowSleep(pair.m_world);
		pair.m_b->setLinearVelocity(btVector3(btScalar(1e-3), 0, 0));
		run(pair.m_world, 4 * 60);
		EXPECT_EQ(share < btScalar(0.01), pair.m_b->isActive()) << share;
	}
	Pair pair(Solver::Direct);
	EXPECT_FALSE(pair.m_world.action().setWakingShare(-1));
	EXPECT_FALSE(pair.m_world.action().setWakingShare(btScalar(NAN)));
	EXPECT_EQ(btScalar(0.05), pair.m_world.action().getWakingShare());
}

TEST(Sleep, AJointThatHasLeftTheWorldMayHaveLostItsBodies)
{
	Pair pair(Solver::Direct);
	World& world = pair.m_world;
	btBoxShape cube(btVector3(1, 1, 1));
	std::unique_ptr<btRigidBody> wall(new btRigidBody(0, nullptr, &cube)),
		block(new btRigidBody(12, nullptr, &cube, btVector3(8, 8, 8)));
	world.bullet().setGravity(btVector3(0, 0, 0));
	world.bullet().addRigidBody(wall.get());
	world.bullet().addRigidBody(block.get());
	btElasticPlastic6DofSpring2Constraint joint(*wall, *block, at(0), at(0));
	ASSERT_TRUE(joint.setCapacity(evenCapacity(1e6, 1e3)));
	world.bullet().addConstraint(&joint, true);
	ASSERT_TRUE(world.action().addJoint(&joint));
	run(world, 3 * 60);
	ASSERT_FALSE(block->isActive());
	world.bullet().removeConstraint(&joint);
	world.bullet().removeRigidBody(block.get());
	world.bullet().removeRigidBody(wall.get());
	block.reset();
	wall.reset();
	run(world, 2);  // reads no memory of theirs: the sanitizer sees it
	EXPECT_FALSE(joint.isBroken());
}
}  // namespace testSleep
