// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The constraint classes: which rows they give, what stays Bullet's, partners of every kind.

#include <math.h>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/JointWorks.h"
#include "support/Pair.h"
#include "support/Precision.h"

namespace testConstraint
{
using namespace ep;

int rowsOf(btTypedConstraint& constraint)
{
	btTypedConstraint::btConstraintInfo1 info;
	constraint.getInfo1(&info);
	return info.m_numConstraintRows;
}

btElasticPlasticCapacity capacityOf(unsigned dofs)
{
	btElasticPlasticCapacity capacity;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (dofs >> i & 1)
			capacity.set(i, 1000, 100);
	return capacity;
}

TEST(Constraint, HasRowsOnlyForWhatItHasCapacityFor)
{
	for (JointClass jointClass : {JointClass::Spring, JointClass::Spring2})
		for (unsigned dofs = 0; dofs < 64; ++dofs)
		{
			Pair pair;
			btElasticPlasticJoint* joint = pair.join(capacityOf(dofs), jointClass);
			int own = 0, locked = 0;
			for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			{
				own += dofs >> i & 1;
				// Bullet's classes come with their linear degrees of freedom locked and the angular ones free; the first class
				// has no row for a lock that is not violated at all.
				locked += i < 3 && !(dofs >> i & 1) && jointClass == JointClass::Spring2;
			}
			EXPECT_EQ(own + locked, rowsOf(joint->getConstraint())) << dofs;
			EXPECT_EQ(own, btElasticPlastic::JointWorks::from(&joint->getConstraint())->m_step.getNumRows());
		}
}

/// Where a body ends on a joint of the given class, made with the last argument and set by the function.
template <class Joint, class Argument, class Set>
btTransform endOn(Argument last, Set set)
{
	Pair pair(Solver::Stock);
	const btTransform inA(btQuaternion(0, 0, 0, 1), btVector3(btScalar(0.5), 0, 0)),
		inB(btQuaternion(0, 0, 0, 1), btVector3(btScalar(-0.5), 0, 0));
	Joint joint(*pair.m_a, *pair.m_b, inA, inB, last);
	joint.setLimit(0, btScalar(-0.1), btScalar(0.2));
	joint.enableSpring(1, true);
	joint.setStiffness(1, 500);
	joint.setLimit(1, 1, -1);
	joint.setLimit(4, btScalar(-0.5), btScalar(0.5));
	set(joint);
	pair.m_world.bullet().addConstraint(&joint);
	pair.m_b->setLinearVelocity(btVector3(1, 1, 0));
	pair.m_b->setAngularVelocity(btVector3(btScalar(0.3), 2, 0));
	run(pair.m_world, 60);
	pair.m_world.bullet().removeConstraint(&joint);
	return pair.m_b->getCenterOfMassTransform();
}

TEST(Constraint, LeavesUntouchedDegreesOfFreedomToBullet)
{
	// No degree of freedom elastic-plastic: bit for bit Bullet's class, with limits, a servo and a spring.
	const auto servo = [](btGeneric6DofSpring2Constraint& joint)
	{
		joint.enableMotor(5, true);
		joint.setServo(5, true);
		joint.setServoTarget(5, btScalar(0.7));
		joint.setTargetVelocity(5, 2);
		joint.setMaxMotorForce(5, 50);
	};
	EXPECT_TRUE(endOn<btGeneric6DofSpring2Constraint>(RO_ZYX, servo) ==
				endOn<btElasticPlastic6DofSpring2Constraint>(RO_ZYX, servo));
}

TEST(Constraint, LeavesUntouchedDegreesOfFreedomToTheFirstClassToo)
{
	const auto nothing = [](btGeneric6DofSpringConstraint&) {};
	EXPECT_TRUE(endOn<btGeneric6DofSpringConstraint>(true, nothing) ==
				endOn<btElasticPlastic6DofSpringConstraint>(true, nothing));
}

TEST(Constraint, MixesPlasticHingeWithBulletsLocks)
{
	// Only bending about z is elastic-plastic, the rest is locked by Bullet: the hinge's energy is
	// what the spin had, read through Bullet's joint feedback from among the other rows, or given by our solver.
	for (Solver solver : {Solver::Stock, Solver::Iterative})
		for (JointClass jointClass : {JointClass::Spring, JointClass::Spring2})
		{
			Pair pair(solver);
			btElasticPlasticCapacity capacity;
			capacity.set(BT_EP_BENDING_Z, btScalar(1e6), 20);
			// At the body's centre, so that its spin is all about the hinge.
			btElasticPlasticJoint* joint =
				pair.m_world.joint(*pair.m_a, *pair.m_b, pair.m_b->getCenterOfMassTransform(), capacity, jointClass);
			if (jointClass == JointClass::Spring)
			{
				auto& base = static_cast<btElasticPlastic6DofSpringConstraint&>(joint->getConstraint());
				base.setLimit(BT_EP_TORSION, 0, 0);
				base.setLimit(BT_EP_BENDING_Y, 0, 0);
			}
			else
			{
				auto& base = static_cast<btElasticPlastic6DofSpring2Constraint&>(joint->getConstraint());
				base.setLimit(BT_EP_TORSION, 0, 0);
				base.setLimit(BT_EP_BENDING_Y, 0, 0);
			}
			pair.m_b->setAngularVelocity(btVector3(0, 0, 6));
			const double kinetic = pair.m_world.kineticEnergy();
			run(pair.m_world, 960, btScalar(1) / 960);
			// Off by one step of motion, because an explicit spring begins a step late; in float also by roundings of 960 steps.
			EXPECT_NEAR(kinetic / 20, joint->getPlasticDeformation(BT_EP_BENDING_Z),
						6. / 960 + byPrecision(0, 1e-4) * kinetic / 20);
			EXPECT_NEAR(kinetic, joint->getWork(), byPrecision(1e-6, 1e-4) * kinetic);
			EXPECT_NEAR(0, pair.m_b->getLinearVelocity().length(), byPrecision(1e-9, 1e-4));
		}
}

TEST(Constraint, SeparatesItsImpulsesFromBulletsRows)
{
	// A load in all directions on a joint of which three degrees of freedom are elastic and three are Bullet's: at rest the
	// elastic ones carry their share, and no solver's reading of it makes them flow.
	for (Solver solver : {Solver::Stock, Solver::Iterative})
	{
		Pair pair(solver);
		pair.m_world.bullet().getSolverInfo().m_numIterations = 200;
		btElasticPlasticCapacity capacity;
		capacity.set(BT_EP_AXIAL, btScalar(1e5), 1000);
		capacity.set(BT_EP_SHEAR_Z, btScalar(1e5), 1000);
		capacity.set(BT_EP_BENDING_Y, btScalar(1e5), 1000);
		btElasticPlasticJoint* joint = pair.join(capacity, JointClass::Spring2);
		auto& base = static_cast<btElasticPlastic6DofSpring2Constraint&>(joint->getConstraint());
		base.setLimit(BT_EP_TORSION, 0, 0);
		base.setLimit(BT_EP_BENDING_Z, 0, 0);
		pair.m_b->setDamping(btScalar(0.9), btScalar(0.9));
		for (int i = 0; i < 600; ++i)
		{
			pair.m_b->applyCentralForce(btVector3(30, 40, 50));
			pair.m_world.step(btScalar(1) / 60);
		}
		EXPECT_NEAR(30, joint->getForce(BT_EP_AXIAL), 0.3);
		EXPECT_NEAR(50, joint->getForce(BT_EP_SHEAR_Z), 0.5);
		// 50 N at half a metre from the joint.
		EXPECT_NEAR(-25, joint->getForce(BT_EP_BENDING_Y), 0.3);
		EXPECT_FALSE(joint->hasYielded());
	}
}

TEST(Constraint, RigidPlasticHoldsThenFlows)
{
	for (Solver solver : {Solver::Stock, Solver::Iterative})
	{
		Pair pair(solver);
		btElasticPlasticCapacity capacity;
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			capacity.setRigidPlastic(i, 1000);
		btElasticPlasticJoint* joint = pair.join(capacity);
		for (int i = 0; i < 60; ++i)
		{
			pair.m_b->applyCentralForce(btVector3(999, 0, 0));
			pair.m_world.step(btScalar(1) / 60);
		}
		EXPECT_NEAR(1, pair.m_b->getCenterOfMassPosition().x(), 1e-5);
		EXPECT_FALSE(joint->hasYielded());
		EXPECT_NEAR(999, joint->getForce(BT_EP_AXIAL), 0.1);
		// 1200 N on 1000 N: 12 kg accelerate with 200 N, 60 steps of semi-implicit Euler.
		for (int i = 0; i < 60; ++i)
		{
			pair.m_b->applyCentralForce(btVector3(1200, 0, 0));
			pair.m_world.step(btScalar(1) / 60);
		}
		const double way = 200. / 12 / 3600 * 60 * 61 / 2;
		EXPECT_NEAR(way, joint->getPlasticDeformation(BT_EP_AXIAL), byPrecision(1e-6, 1e-3) * way);
		EXPECT_NEAR(1000 * way, joint->getState().m_plasticEnergy, byPrecision(1e-6, 1e-3) * 1000 * way);
		// The body, at 200 / 12 m/s, is to give for the second half of the last step in the next one.
		const double owed = 200. / 12 / 120;
		EXPECT_NEAR(1000 * (way - owed), joint->getPlasticEnergy(), byPrecision(1e-6, 1e-3) * 1000 * way);
	}
}

TEST(Constraint, HangsFromAKinematicBodyThatMoves)
{
	// Upwards at constant speed: after the start the joint carries the weight, and nothing flows.
	Pair pair;
	pair.m_world.bullet().setGravity(btVector3(-10, 0, 0));
	pair.m_b->setGravity(btVector3(10, 0, 0));
	makeKinematic(*pair.m_a);
	pair.m_b->setDamping(btScalar(0.99), btScalar(0.99));
	btElasticPlasticJoint* joint = pair.m_world.joint(*pair.m_a, *pair.m_b, pair.m_frame, evenCapacity(1e6, 1000));
	double speed = 0;
	for (int i = 0; i < 600; ++i)
	{
		speed = std::min(1., speed + 0.01);
		btTransform pose = pair.m_a->getWorldTransform();
		pose.getOrigin() -= btVector3(btScalar(speed / 60), 0, 0);
		pair.m_a->setWorldTransform(pose);
		pair.m_world.step(btScalar(1) / 60);
	}
	EXPECT_NEAR(-1, pair.m_b->getLinearVelocity().x(), 1e-3);
	EXPECT_FALSE(joint->hasYielded());
	// Weight, and what damping takes from 12 kg at 1 m/s: 99 % a second, step by step.
	EXPECT_NEAR(120 + 12 * (1 - pow(0.01, 1. / 60)) * 60, joint->getForce(BT_EP_AXIAL), byPrecision(1e-6, 0.1));
}

TEST(Constraint, JoinsABodyToTheWorld)
{
	for (JointClass jointClass : {JointClass::Spring, JointClass::Spring2})
	{
		Pair pair;
		const btTransform inB(btQuaternion(0, 0, 0, 1), btVector3(btScalar(-0.5), 0, 0));
		btTypedConstraint* constraint;
		btElasticPlasticJoint* joint;
		if (jointClass == JointClass::Spring)
		{
			auto* c = new btElasticPlastic6DofSpringConstraint(*pair.m_b, inB);
			constraint = c;
			joint = c;
		}
		else
		{
			auto* c = new btElasticPlastic6DofSpring2Constraint(*pair.m_b, inB);
			constraint = c;
			joint = c;
		}
		pair.m_world.add(constraint);
		ASSERT_TRUE(joint->setCapacity(evenCapacity(1000, 100)));
		ASSERT_TRUE(pair.m_world.action().addJoint(joint));
		pair.m_b->setDamping(btScalar(0.9), btScalar(0.9));
		for (int i = 0; i < 600; ++i)
		{
			pair.m_b->applyCentralForce(btVector3(50, 0, 0));
			pair.m_world.step(btScalar(1) / 60);
		}
		EXPECT_NEAR(50, joint->getForce(BT_EP_AXIAL), 0.5);
		EXPECT_NEAR(1.05, pair.m_b->getCenterOfMassPosition().x(), 1e-3);
	}
}

TEST(Constraint, KeepsTheUsersFeedback)
{
	Pair pair(Solver::Stock);
	btElasticPlasticJoint* joint = pair.join(evenCapacity(1000, 100));
	btJointFeedback mine;
	joint->getConstraint().setJointFeedback(&mine);
	for (int i = 0; i < 60; ++i)
	{
		pair.m_b->applyCentralForce(btVector3(150, 0, 0));
		pair.m_world.step(btScalar(1) / 60);
	}
	EXPECT_EQ(&mine, joint->getConstraint().getJointFeedback());
	EXPECT_TRUE(joint->hasYielded());
	EXPECT_NEAR(-100, mine.m_appliedForceBodyB.x(), 0.1);
	joint->getConstraint().setJointFeedback(nullptr);
	pair.m_world.step(btScalar(1) / 60);
	EXPECT_NE(nullptr, joint->getConstraint().getJointFeedback());
}
}  // namespace testConstraint
