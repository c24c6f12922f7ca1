// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Joints in place of Bullet's constraints.

#include <math.h>

#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btConeTwistConstraint.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticConversion.h"
#include "BulletDynamics/ConstraintSolver/btFixedConstraint.h"
#include "BulletDynamics/ConstraintSolver/btGearConstraint.h"
#include "BulletDynamics/ConstraintSolver/btHingeConstraint.h"
#include "BulletDynamics/ConstraintSolver/btPoint2PointConstraint.h"
#include "BulletDynamics/ConstraintSolver/btSliderConstraint.h"
#include "BulletDynamics/ConstraintSolver/btUniversalConstraint.h"
#include "support/Pair.h"
#include "support/Precision.h"

namespace testConversion
{
using namespace ep;
typedef btElasticPlasticConversion Conversion;
typedef std::unique_ptr<Conversion::Joint> JointPointer;

const btTransform TURNED(btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(0.8)), btVector3(4, -5, 6));

/// Two cubes of which either may be fixed, anywhere, and what joins them at a place between them.
struct Bodies
{
	Pair m_pair;
	btRigidBody &m_a, &m_b;
	btTransform m_frameInA, m_frameInB;

	explicit Bodies(bool isFirstFixed = true)
		: m_pair(Solver::Direct, isFirstFixed ? 0 : 12, isFirstFixed ? 12 : 0), m_a(*m_pair.m_a), m_b(*m_pair.m_b)
	{
		m_a.setWorldTransform(TURNED * at(0));
		m_b.setWorldTransform(TURNED * at(1) * btTransform(btQuaternion(btVector3(3, -1, 2).normalized(), 1)));
		const btTransform frame =
			TURNED * at(btScalar(0.5)) * btTransform(btQuaternion(btVector3(0, 1, 1).normalized(), 2));
		m_frameInA = m_a.getWorldTransform().inverse() * frame;
		m_frameInB = m_b.getWorldTransform().inverse() * frame;
	}

	/// Moves body B's frame from body A's: by a way and a turn about an axis, in A's frame.
	void displace(const btVector3& way, const btVector3& axis, btScalar angle)
	{
		const btTransform move(btQuaternion(axis, angle), way);
		m_b.setWorldTransform(m_a.getWorldTransform() * m_frameInA * move * m_frameInB.inverse());
	}
};

/// Which degrees of freedom of a joint are elastic-plastic, bit by bit.
unsigned dofsOf(const Conversion::Joint& joint)
{
	unsigned dofs = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		dofs |= unsigned(joint.getCapacity().isElasticPlastic(i)) << i;
	return dofs;
}

btElasticPlasticCapacity strong() { return evenCapacity(1e6, 1e5); }

const unsigned ALL = 63, TRANSLATIONS = 7;
unsigned allBut(int dof) { return ALL & ~(1u << dof); }

/// Rounding of angles and ways of the order of 1 through some ten rotations.
const double ROUNDING = byPrecision(1e-13, 1e-5);

TEST(Conversion, FixedLocksAll)
{
	for (bool isFirstFixed : {true, false})
	{
		Bodies bodies(isFirstFixed);
		btFixedConstraint fixed(bodies.m_a, bodies.m_b, bodies.m_frameInA, bodies.m_frameInB);
		fixed.setUserConstraintId(77);
		const JointPointer joint(Conversion::fromFixed(fixed, strong()));
		EXPECT_EQ(ALL, dofsOf(*joint));
		EXPECT_FALSE(joint->fault());
		EXPECT_EQ(77, joint->getUserConstraintId());
		EXPECT_NEAR(0, (joint->getFrameA().getOrigin() - joint->getFrameB().getOrigin()).length(), ROUNDING);
		// The x axis along a member.
		const btVector3 along = btVector3(3, -2, 1);
		const JointPointer member(Conversion::fromFixed(fixed, strong(), along));
		EXPECT_NEAR(0, (member->getFrameA().getBasis().getColumn(0) - along.normalized()).length(), ROUNDING);
		EXPECT_NEAR(0, (member->getFrameB().getBasis().getColumn(0) - along.normalized()).length(), ROUNDING);
	}
}

TEST(Conversion, HingeTurnsAboutZWithinItsLimits)
{
	for (bool refersToA : {true, false})
		for (bool isFirstFixed : {true, false})
		{
			Bodies bodies(isFirstFixed);
			btHingeConstraint hinge(bodies.m_a, bodies.m_b, bodies.m_frameInA, bodies.m_frameInB, refersToA);
			JointPointer joint(Conversion::fromHinge(hinge, strong()));
			EXPECT_EQ(allBut(BT_EP_BENDING_Z), dofsOf(*joint));
			EXPECT_FALSE(joint->getRotationalLimitMotor(2)->isLimited());

			hinge.setLimit(btScalar(-0.3), btScalar(0.7));
			const btVector3 along = TURNED.getBasis() * btVector3(1, 0, 0);
			for (bool hasAxis : {false, true})
			{
				joint.reset(Conversion::fromHinge(hinge, strong(), hasAxis ? along : btVector3(0, 0, 0)));
				const btRotationalLimitMotor2& motor = *joint->getRotationalLimitMotor(2);
				// The way to either limit is the same by both.
				for (btScalar angle : {btScalar(0.2), btScalar(-0.25)})
				{
					bodies.displace(btVector3(0, 0, 0), btVector3(0, 0, 1), angle);
					const double byHinge = hinge.getHingeAngle();
					joint->calculateTransforms();
					const double byJoint = joint->getAngle(2);
					EXPECT_NEAR(fabs(byHinge), fabs(byJoint), ROUNDING);
					const double lower = byHinge + 0.3, upper = 0.7 - byHinge;
					const bool isSame = byHinge * byJoint > 0;
					EXPECT_NEAR(lower, isSame ? byJoint - motor.m_loLimit : motor.m_hiLimit - byJoint, ROUNDING);
					EXPECT_NEAR(upper, isSame ? motor.m_hiLimit - byJoint : byJoint - motor.m_loLimit, ROUNDING);
				}
				bodies.displace(btVector3(0, 0, 0), btVector3(0, 0, 1), 0);
				if (hasAxis)
				{
					const btVector3 z = (bodies.m_a.getWorldTransform() * bodies.m_frameInA).getBasis().getColumn(2);
					EXPECT_NEAR(0, (joint->getFrameA().getBasis().getColumn(2) - z).length(), ROUNDING);
					EXPECT_NEAR((along - z * z.dot(along)).length(),
								joint->getFrameA().getBasis().getColumn(0).dot(along), ROUNDING);
				}
			}
		}
}

TEST(Conversion, Point2PointTurns)
{
	Bodies bodies;
	btPoint2PointConstraint point(bodies.m_a, bodies.m_b, bodies.m_frameInA.getOrigin(), bodies.m_frameInB.getOrigin());
	const JointPointer joint(Conversion::fromPoint2Point(point, strong(), btVector3(0, 0, 5)));
	EXPECT_EQ(TRANSLATIONS, dofsOf(*joint));
	EXPECT_NEAR(0, (joint->getFrameA().getBasis().getColumn(0) - btVector3(0, 0, 1)).length(), ROUNDING);
	EXPECT_NEAR(0, (joint->getFrameB().getBasis().getColumn(0) - btVector3(0, 0, 1)).length(), ROUNDING);
	EXPECT_NEAR(0, (joint->getFrameA().getOrigin() - joint->getFrameB().getOrigin()).length(), ROUNDING);
	for (int i = 0; i < 3; ++i)
		EXPECT_FALSE(joint->getRotationalLimitMotor(i)->isLimited());
}

TEST(Conversion, ConeTwistTurnsWithinItsSpans)
{
	Bodies bodies;
	btConeTwistConstraint cone(bodies.m_a, bodies.m_b, bodies.m_frameInA, bodies.m_frameInB);
	const JointPointer unlimited(Conversion::fromConeTwist(cone, strong()));
	EXPECT_EQ(TRANSLATIONS, dofsOf(*unlimited));
	EXPECT_FALSE(unlimited->getRotationalLimitMotor(0)->isLimited());
	cone.setLimit(btScalar(0.3), btScalar(0.4), btScalar(0.5));  // about z, about y, twist
	const JointPointer joint(Conversion::fromConeTwist(cone, strong()));
	for (int i = 0; i < 3; ++i)
	{
		const double span = i == 0 ? 0.5 : i == 1 ? 0.4 : 0.3;
		EXPECT_NEAR(-span, joint->getRotationalLimitMotor(i)->m_loLimit, ROUNDING);
		EXPECT_NEAR(span, joint->getRotationalLimitMotor(i)->m_hiLimit, ROUNDING);
	}
}

TEST(Conversion, SliderSlidesAndTurnsWithinItsLimits)
{
	Bodies bodies;
	btSliderConstraint slider(bodies.m_a, bodies.m_b, bodies.m_frameInA, bodies.m_frameInB, true);
	slider.setLowerLinLimit(btScalar(-0.1));
	slider.setUpperLinLimit(btScalar(0.2));
	slider.setLowerAngLimit(btScalar(-0.3));
	slider.setUpperAngLimit(btScalar(0.4));
	JointPointer joint(Conversion::fromSlider(slider, strong()));
	EXPECT_EQ(allBut(BT_EP_AXIAL) & allBut(BT_EP_TORSION), dofsOf(*joint));
	bodies.displace(btVector3(btScalar(0.15), 0, 0), btVector3(1, 0, 0), btScalar(0.25));
	slider.calculateTransforms(bodies.m_a.getWorldTransform(), bodies.m_b.getWorldTransform());
	slider.testLinLimits();
	slider.testAngLimits();
	joint->calculateTransforms();
	EXPECT_NEAR(0.15, slider.getLinearPos(), ROUNDING);
	EXPECT_NEAR(0.15, joint->getRelativePivotPosition(0), ROUNDING);
	EXPECT_NEAR(-0.1, joint->getTranslationalLimitMotor()->m_lowerLimit.x(), ROUNDING);
	EXPECT_NEAR(0.2, joint->getTranslationalLimitMotor()->m_upperLimit.x(), ROUNDING);
	const btRotationalLimitMotor2& motor = *joint->getRotationalLimitMotor(0);
	const double byJoint = joint->getAngle(0), bySlider = slider.getAngularPos();
	EXPECT_NEAR(0.25, fabs(byJoint), ROUNDING);
	const bool isSame = bySlider * byJoint > 0;
	EXPECT_NEAR(bySlider + 0.3, isSame ? byJoint - motor.m_loLimit : motor.m_hiLimit - byJoint, ROUNDING);
	// A slider as it is made turns nowhere: lower above upper limit slides freely.
	btSliderConstraint fresh(bodies.m_a, bodies.m_b, bodies.m_frameInA, bodies.m_frameInB, true);
	joint.reset(Conversion::fromSlider(fresh, strong()));
	EXPECT_EQ(allBut(BT_EP_AXIAL), dofsOf(*joint));
	EXPECT_FALSE(joint->getTranslationalLimitMotor()->isLimited(0));
}

TEST(Conversion, SixDofKeepsLimitsMotorsAndSprings)
{
	Bodies bodies;
	btGeneric6DofConstraint old(bodies.m_a, bodies.m_b, bodies.m_frameInA, bodies.m_frameInB, true);
	btGeneric6DofSpring2Constraint spring(bodies.m_a, bodies.m_b, bodies.m_frameInA, bodies.m_frameInB, RO_ZYX);
	const auto limit = [](auto& constraint)
	{
		constraint.setLimit(1, btScalar(-0.1), btScalar(0.2));
		constraint.setLimit(2, 0, 0);
		constraint.setLimit(0, 0, 0);
		constraint.setLimit(3, btScalar(-0.3), btScalar(0.4));
		constraint.setLimit(4, 0, 0);
		constraint.setLimit(5, 1, -1);
	};
	limit(old);
	limit(spring);
	spring.enableSpring(1, true);
	spring.setStiffness(1, 123);
	for (btTypedConstraint* each : {static_cast<btTypedConstraint*>(&old), static_cast<btTypedConstraint*>(&spring)})
	{
		const JointPointer joint(Conversion::from(*each, strong()));
		EXPECT_EQ((1u << BT_EP_AXIAL) | (1u << BT_EP_SHEAR_Z) | (1u << BT_EP_BENDING_Y), dofsOf(*joint));
		EXPECT_EQ(btScalar(-0.1), joint->getTranslationalLimitMotor()->m_lowerLimit.y());
		EXPECT_EQ(btScalar(0.2), joint->getTranslationalLimitMotor()->m_upperLimit.y());
		EXPECT_EQ(btScalar(-0.3), joint->getRotationalLimitMotor(0)->m_loLimit);
		EXPECT_EQ(btScalar(0.4), joint->getRotationalLimitMotor(0)->m_hiLimit);
		EXPECT_FALSE(joint->getRotationalLimitMotor(2)->isLimited());
		EXPECT_EQ(each == &spring, joint->getTranslationalLimitMotor()->m_enableSpring[1]);
		if (each == &spring)
		{
			EXPECT_EQ(123, joint->getTranslationalLimitMotor()->m_springStiffness.y());
			EXPECT_EQ(RO_ZYX, joint->getRotationOrder());
		}
	}
}

TEST(Conversion, FindsTheTypeAndRefusesOthers)
{
	Bodies bodies;
	const btVector3 anchor = bodies.m_a.getWorldTransform() * bodies.m_frameInA.getOrigin();
	btFixedConstraint fixed(bodies.m_a, bodies.m_b, bodies.m_frameInA, bodies.m_frameInB);
	btHingeConstraint hinge(bodies.m_a, bodies.m_b, bodies.m_frameInA, bodies.m_frameInB);
	btSliderConstraint slider(bodies.m_a, bodies.m_b, bodies.m_frameInA, bodies.m_frameInB, true);
	btPoint2PointConstraint point(bodies.m_a, bodies.m_b, btVector3(0, 0, 0), btVector3(0, 0, 0));
	btConeTwistConstraint cone(bodies.m_a, bodies.m_b, bodies.m_frameInA, bodies.m_frameInB);
	btUniversalConstraint universal(bodies.m_a, bodies.m_b, anchor, btVector3(0, 0, 1), btVector3(0, 1, 0));
	btGearConstraint gear(bodies.m_a, bodies.m_b, btVector3(1, 0, 0), btVector3(1, 0, 0));
	btElasticPlastic6DofSpring2Constraint already(bodies.m_a, bodies.m_b, bodies.m_frameInA, bodies.m_frameInB);
	const std::pair<btTypedConstraint*, unsigned> expected[] = {{&fixed, ALL},
																{&hinge, allBut(BT_EP_BENDING_Z)},
																{&slider, allBut(BT_EP_AXIAL)},
																{&point, TRANSLATIONS},
																{&cone, TRANSLATIONS}};
	for (const auto& each : expected)
	{
		const JointPointer joint(Conversion::from(*each.first, strong()));
		ASSERT_TRUE(joint);
		EXPECT_EQ(each.second, dofsOf(*joint)) << each.first->getConstraintType();
	}
	EXPECT_EQ(TRANSLATIONS, dofsOf(*JointPointer(Conversion::from(universal, strong()))) & TRANSLATIONS);
	EXPECT_FALSE(JointPointer(Conversion::from(gear, strong())));
	EXPECT_FALSE(JointPointer(Conversion::from(already, strong())));
	btElasticPlasticCapacity bad;
	bad.set(BT_EP_AXIAL, -1, 1);
	EXPECT_TRUE(JointPointer(Conversion::fromFixed(fixed, bad))->fault());
}

TEST(Conversion, AReplacedHingeSwingsAsBefore)
{
	for (bool isReplaced : {false, true})
	{
		Pair pair(Solver::Direct, 0, 12, btVector3(0, -10, 0));
		World& world = pair.m_world;
		btHingeConstraint hinge(*pair.m_a, *pair.m_b, at(btScalar(0.5)), at(btScalar(-0.5)));
		hinge.setLimit(btScalar(-0.5), btScalar(0.5));
		world.bullet().addConstraint(&hinge, true);
		JointPointer joint;
		if (isReplaced)
			joint.reset(Conversion::replace(world.bullet(), world.action(), hinge, strong()));
		EXPECT_EQ(1, world.bullet().getNumConstraints());
		EXPECT_FALSE(pair.m_a->checkCollideWith(pair.m_b));
		run(world, 120);
		// It hangs at the limit of 0.5 rad: by 0.24 m of its half length. Both give a little at the stop.
		EXPECT_NEAR(-0.5 * sin(0.5), pair.m_b->getCenterOfMassPosition().y(), 0.01);
		if (joint)
		{
			EXPECT_NEAR(120, fabs(joint->getForce(BT_EP_SHEAR_Y)) + fabs(joint->getForce(BT_EP_AXIAL)), 60);
		}
		world.bullet().removeConstraint(isReplaced ? static_cast<btTypedConstraint*>(joint.get()) : &hinge);
	}
}
}  // namespace testConversion
