// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <gtest/gtest.h>

#include <cmath>

#include "world/JointReading.h"
#include "world/World.h"

namespace testBulletJoint
{
using namespace ep;

// Bullet's own joints in place of ours, on a block that stands out from a wall: one arm, one known load.

const btScalar LENGTH = 2, MASS = 100, GRAVITY = 10;
const double MOMENT = double(MASS * GRAVITY * LENGTH / 2);  // at the wall [N m]

struct Arm
{
	/// \param strength  yield moment over the moment of its own weight
	explicit Arm(const JointKind& kind, double strength = 2) : m_world(Method(Solver::Stock, kind, 50))
	{
		btRigidBody* const wall = m_world.body(0, m_world.box(btVector3(1, 1, 1)), at(btScalar(-.5)));
		m_arm = m_world.body(MASS, m_world.box(btVector3(LENGTH, btScalar(.2), btScalar(.2))), at(LENGTH / 2));
		btElasticPlasticCapacity capacity;
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			capacity.setRigidPlastic(i, btScalar(100 * MOMENT));
		// Soft enough for a step of 1/480 s: with the arm's inertia about the wall its period is 0.7 s.
		capacity.set(BT_EP_BENDING_Z, btScalar(10 * MOMENT), btScalar(strength * MOMENT), btScalar(.3));
		m_joint = m_world.joint(*wall, *m_arm, at(0), capacity);
	}
	static btTransform at(btScalar x) { return btTransform(btQuaternion(0, 0, 0, 1), btVector3(x, 0, 0)); }
	void run(double seconds)
	{
		for (int i = 0; i < int(seconds * 480 + .5); ++i)
			m_world.step(btScalar(1) / 480);
	}
	JointReading reading() const { return readJoint(m_world, *m_joint); }

	World m_world;
	btRigidBody* m_arm;
	btElasticPlasticJoint* m_joint;
};

TEST(BulletJoint, NamesAreUniqueAndFound)
{
	for (const auto& kind : jointKinds())
	{
		ASSERT_NE(findNamed(jointKinds(), kind.name), nullptr);
		EXPECT_TRUE(*findNamed(jointKinds(), kind.name) == kind.value);
		EXPECT_EQ(nameOf(jointKinds(), kind.value), kind.name);
	}
	EXPECT_EQ(findNamed(jointKinds(), "glue"), nullptr);
}

TEST(BulletJoint, NothingHoldsNothing)
{
	Arm arm(kinds::None);
	arm.run(1);
	EXPECT_FALSE(arm.reading().isThere);
	// Free fall, g t^2 / 2; Bullet counts each step's velocity at its end: half a step more.
	EXPECT_NEAR(double(arm.m_arm->getCenterOfMassPosition().y()), -5 * (1 + 1. / 480), .01);
}

TEST(BulletJoint, RigidTellsItsLoad)
{
	Arm arm(kinds::Rigid, .5);
	arm.run(1);
	const JointReading r = arm.reading();
	// Acts on the wall, which the arm pulls down; sequential impulses are near it within 1 %.
	EXPECT_NEAR(std::fabs(r.force[BT_EP_BENDING_Z]) / MOMENT, 1, .01);
	EXPECT_NEAR(std::fabs(r.force[BT_EP_SHEAR_Y]) / double(MASS * GRAVITY), 1, .01);
	// What the elastic-plastic one would have yielded at, twice over.
	EXPECT_NEAR(r.utilisation, 2, .02);
	EXPECT_EQ(r.limitingDof, BT_EP_BENDING_Z);
	EXPECT_FALSE(r.isBroken);
}

TEST(BulletJoint, BreakingHoldsBelowItsThresholdAndGoesAboveIt)
{
	// The threshold is the least of the yield values as a number: moment and shear force are the same here.
	Arm strong(kinds::Breaking, 3), weak(kinds::Breaking, .5);
	strong.run(1);
	weak.run(1);
	EXPECT_FALSE(strong.reading().isBroken);
	EXPECT_TRUE(weak.reading().isBroken);
	EXPECT_LT(double(weak.m_arm->getCenterOfMassPosition().y()), -3);
}

TEST(BulletJoint, SpringsSwingAboutTheirStaticBend)
{
	for (const JointKind& kind : {kinds::Spring, kinds::Spring2})
	{
		SCOPED_TRACE(nameOf(jointKinds(), kind));
		Arm arm(kind);
		// The bend under its weight is 0.1 rad; let go at 0 it swings to twice that and back, or less with damping.
		double most = 0;
		for (int i = 0; i < 480; ++i)
		{
			arm.run(1. / 480);
			most = std::max(most, std::fabs(arm.reading().deformation[BT_EP_BENDING_Z]));
		}
		EXPECT_GT(most, .1);
		EXPECT_LT(most, .21);
		const JointReading r = arm.reading();
		EXPECT_NEAR(r.elasticEnergy, 10 * MOMENT * std::pow(r.deformation[BT_EP_BENDING_Z], 2) / 2, 1e-3 * MOMENT);
	}
}

TEST(BulletJoint, MotorBrakesUpToThePlasticMoment)
{
	Arm strong(kinds::HingeMotor, 2), weak(kinds::HingeMotor, .5);
	strong.run(1);
	weak.run(.5);
	EXPECT_NEAR(double(strong.m_arm->getCenterOfMassPosition().y()), 0, .01);
	EXPECT_NEAR(std::fabs(weak.reading().force[BT_EP_BENDING_Z]) / (.5 * MOMENT), 1, .01);
	// All that it turns is plastic work: moment times angle.
	const double turn = std::fabs(weak.reading().deformation[BT_EP_BENDING_Z]);
	EXPECT_GT(turn, .1);
	EXPECT_NEAR(weak.reading().plasticEnergy / (.5 * MOMENT * turn), 1, .02);
	EXPECT_FALSE(weak.reading().isBroken);

	Arm ductile(kinds::PlasticHinge, .5);
	ductile.run(2);
	EXPECT_TRUE(ductile.reading().isBroken);  // beyond 0.3 rad
	EXPECT_LT(double(ductile.m_arm->getCenterOfMassPosition().y()), -3);
}
}  // namespace testBulletJoint
