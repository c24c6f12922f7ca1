// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Mistakes that were once made, each a scene: frames, partners, steps and capacities out of the ordinary.

#include <math.h>

#include <vector>

#include <gtest/gtest.h>

#include "support/NotFinite.h"
#include "support/Pair.h"
#include "support/Precision.h"
#include "world/World.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testHardJoints
{
using namespace ep;

TEST(HardJoints, TwistsThroughTurnsWithAnOffset)
{
	// Torsion is driven at 2 rad/s through more than a turn; the frames stand 0.2 m apart, a moment of 100 N m bends. The
	// axes have to turn with the bodies: half of log(R) does not, and made thousands of joules from nothing at a full turn.
	Pair pair;
	btElasticPlasticCapacity capacity = evenCapacity(1e5, 1e9);
	capacity.set(BT_EP_TORSION, btScalar(1e5), 10);
	auto* joint = new btElasticPlastic6DofSpring2Constraint(*pair.m_a, *pair.m_b, btTransform::getIdentity(), at(-0.8));
	pair.m_world.add(joint);
	joint->setCapacity(capacity);
	joint->setReferenceToCurrentPose();
	pair.m_world.action().addJoint(joint);
	const int rate = 960;
	double work = 0, fromNowhere = 0;
	for (int i = 0; i < 5 * rate; ++i)
	{
		const btVector3 spin = pair.m_b->getAngularVelocity(), torque((2 - spin.x()) * 50 + 10, 0, 100);
		pair.m_b->applyTorque(torque);
		pair.m_world.step(btScalar(1) / rate);
		work += double(torque.dot(spin + pair.m_b->getAngularVelocity())) / 2 / rate;
		fromNowhere = std::max(
			fromNowhere, pair.m_world.kineticEnergy() + joint->getElasticEnergy() + joint->getPlasticEnergy() - work);
	}
	EXPECT_GT(joint->getPlasticDeformation(BT_EP_TORSION), 9);
	// A step's motion under the moment: 100 N m, 1e-3 rad of elastic bending.
	EXPECT_LT(fromNowhere, 0.5);
}

TEST(HardJoints, AKinematicPressGoesItsWay)
{
	// 0.1 m at 1 m/s against a body that does not budge: 1 mm of it elastic. A kinematic body stands where the step will
	// take it; counted twice its motion overshot by a step.
	for (Solver solver : {Solver::Iterative, Solver::Stock, Solver::Direct})
		for (int rate : {60, 240})
			for (bool pressFirst : {true, false})
			{
				Pair pair(solver, 0, 5e6);
				makeKinematic(*pair.m_a);
				btRigidBody *first = pressFirst ? pair.m_a : pair.m_b, *second = pressFirst ? pair.m_b : pair.m_a;
				btElasticPlasticJoint* joint =
					pair.m_world.joint(*first, *second, pair.m_frame, evenCapacity(1e7, 1e4));
				double x = 0;
				for (int i = 0; i < rate / 5; ++i)
				{
					x -= i < rate / 10 ? 1. / rate : 0;
					pair.m_a->setWorldTransform(at(x));
					pair.m_world.step(btScalar(1) / rate);
				}
				// With Bullet's solver the spring is explicit: it has no force in the first step, whose motion is neither
				// resisted nor plastic.
				const double path = solver == Solver::Stock ? 0.1 - 1. / rate : 0.099;
				EXPECT_NEAR(path, joint->getPlasticPath(BT_EP_AXIAL), 2e-4) << int(solver) << " " << rate;
				// Still at yield but for what the heavy body's 0.2 mm/s give back in the last tenth of a second.
				EXPECT_NEAR(1e4, btFabs(joint->getForce(BT_EP_AXIAL)), 500);
			}
}

TEST(HardJoints, ChangingStepsDoNotFeedAnOscillation)
{
	// Every seventh step is longer, for springs of all frequencies around: the swing may not grow. With constant steps Newmark
	// sloshes within a tenth; a step that jumps by 2 or 4 may add once what is between two of its swings.
	for (double ratio : {1., 2., 4.})
		for (double frequency = 1; frequency < 8; frequency *= 1.02)
		{
			Pair pair;
			btElasticPlasticJoint* joint =
				pair.join(evenCapacity(12 * pow(2 * M_PI * frequency, 2), btElasticPlasticCapacity::unlimited()));
			pair.m_b->setLinearVelocity(btVector3(btScalar(0.1), 0, 0));
			const double before = pair.m_world.kineticEnergy();
			double largest = 0;
			for (int i = 0; i < 600; ++i)
			{
				pair.m_world.step(btScalar((i % 7 == 0 ? ratio : 1) / 60));
				largest = std::max(largest, (pair.m_world.kineticEnergy() + joint->getElasticEnergy()) / before);
			}
			EXPECT_LT(largest, 1.3) << ratio << " " << frequency;
		}
}

TEST(HardJoints, StockRowsHoldAroundTheEdgeOfResolution)
{
	// A free chain, elastic, stiffness scanned through a = 1: sequential impulses on coupled rows with C just below A grew
	// thousandfold.
	for (Solver solver : {Solver::Stock, Solver::Iterative, Solver::Direct})
		for (double stiffness = 1e3; stiffness < 1e5; stiffness *= 1.15)
		{
			World world(solver, btVector3(0, 0, 0));
			btCollisionShape* cube = world.box(btVector3(1, 1, 1));
			unsigned random = 1;
			const auto next = [&random]
			{ return btScalar((random = random * 1664525u + 1013904223u) >> 8) / (1 << 24) - btScalar(0.5); };
			for (int i = 0; i < 12; ++i)
			{
				btRigidBody* body = world.body(12, cube, at(i), false);
				body->setLinearVelocity(btVector3(next(), next(), next()));
				if (i > 0)
					world.joint(*world.bodies()[i - 1], *body, at(i - 0.5),
								evenCapacity(stiffness, btElasticPlasticCapacity::unlimited()));
			}
			const double before = world.kineticEnergy();
			run(world, 300);
			EXPECT_LT(world.kineticEnergy(), 1.1 * before) << int(solver) << " " << stiffness;
		}
}

TEST(HardJoints, HoldsMountains)
{
	// In float Bullet writes 0 for 1 / A where A is below 1e-7: cubes of 8 m and more.
	for (Solver solver : {Solver::Iterative, Solver::Direct})
		for (double side : {6., 8., 20.})
		{
			World world(solver);
			const btScalar mass = btScalar(2000 * side * side * side), s = btScalar(side);
			btRigidBody* support = world.body(0, world.box(btVector3(1, 1, 1)), at(0), false);
			btRigidBody* body = world.body(mass, world.box(btVector3(s, s, s)), at(0, -side / 2), false);
			btElasticPlasticJoint* joint =
				world.joint(*support, *body, btTransform::getIdentity(), evenCapacity(1e4 * mass, 100 * mass));
			body->setDamping(btScalar(0.9), btScalar(0.9));
			run(world, 300);
			EXPECT_NEAR(-10 * mass, joint->getForce(BT_EP_SHEAR_Y), 0.02 * 10 * mass) << side;
		}
}

TEST(HardJoints, NanStaysWhereItIs)
{
	enum Where
	{
		VELOCITY,
		FORCE,
		PLACE,
		TURN
	};
	const btScalar nan = notANumber();
	for (Solver solver : {Solver::Stock, Solver::Iterative, Solver::Direct})
		for (Where where : {VELOCITY, FORCE, PLACE, TURN})
		{
			World world(solver, btVector3(0, 0, 0));
			btCollisionShape* cube = world.box(btVector3(1, 1, 1));
			for (int i = 0; i < 5; ++i)
			{
				btRigidBody* body = world.body(12, cube, at(i), false);
				if (i > 0)
					world.joint(*world.bodies()[i - 1], *body, at(i - 0.5), evenCapacity(1e5, 1e3));
			}
			world.step(btScalar(1) / 60);
			btRigidBody& sick = *world.bodies()[4];
			if (where == VELOCITY)
				sick.setLinearVelocity(btVector3(nan, 0, 0));
			else if (where == FORCE)
				sick.applyCentralForce(btVector3(nan, 0, 0));
			else
				sick.setCenterOfMassTransform(
					where == PLACE ? at(double(nan)) : btTransform(btQuaternion(nan, 0, 0, 1), btVector3(4, 0, 0)));
			run(world, 10);
			for (int i = 0; i < 4; ++i)
				EXPECT_TRUE(btElasticPlasticIsFinite(world.bodies()[i]->getCenterOfMassPosition().length()))
					<< i << " " << where;
		}
}

TEST(HardJoints, HoldsAgainWhereItStands)
{
	// Strength taken away and given back: what moved meanwhile was free, the joint holds from there.
	Pair pair;
	btElasticPlasticCapacity strong = evenCapacity(1e4, 1000), none = strong;
	none.scaleYield(0);
	btElasticPlasticJoint* joint = pair.join(strong);
	for (int i = 0; i < 30; ++i)
	{
		pair.m_b->applyCentralForce(btVector3(500, 0, 0));
		pair.m_world.step(btScalar(1) / 240);
	}
	joint->setCapacity(none);
	EXPECT_EQ(0, joint->getForce(BT_EP_AXIAL));
	pair.m_b->setLinearVelocity(btVector3(1, 0, 0));
	run(pair.m_world, 240, btScalar(1) / 240);
	EXPECT_NEAR(1, pair.m_b->getLinearVelocity().x(), 1e-5);
	pair.m_b->setLinearVelocity(btVector3(0, 0, 0));
	joint->setCapacity(strong);
	run(pair.m_world, 240, btScalar(1) / 240);
	EXPECT_NEAR(0, pair.m_world.kineticEnergy(), 1e-6);
}

TEST(HardJoints, WeakeningDoesNotCreep)
{
	// Far from the origin in float, capacity set anew in every step: the reference stays.
	World world(Solver::Iterative);
	const btScalar far = 1000;
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* support = world.body(0, cube, at(far), false);
	btRigidBody* body = world.body(100, cube, at(far, -1), false);
	btElasticPlasticCapacity capacity = evenCapacity(5e6, 1e4);
	btElasticPlasticJoint* joint = world.joint(*support, *body, at(far, -0.5), capacity);
	for (int i = 0; i < 600; ++i)
	{
		capacity.scaleYield(btScalar(0.999));
		joint->setCapacity(capacity);
		world.step(btScalar(1) / 60);
	}
	// 1000 N on 5e6 N/m, and float's 0.06 mm at 1000 m.
	EXPECT_NEAR(-1, body->getCenterOfMassPosition().y(), byPrecision(1e-3, 2e-3));
	EXPECT_FALSE(joint->hasYielded());
}

TEST(HardJoints, StockSolversSeeFlowBesideAPinnedBody)
{
	// A body pinned by its factors: Bullet's feedback of it is 0, that of its partner is not.
	for (bool pinnedFirst : {true, false})
	{
		Pair pair(Solver::Stock, 12);
		pair.m_a->setLinearFactor(btVector3(0, 0, 0));
		pair.m_a->setAngularFactor(btVector3(0, 0, 0));
		btElasticPlasticCapacity capacity = evenCapacity(1e5, 1e9);
		capacity.set(BT_EP_AXIAL, btScalar(1e5), 100);
		btRigidBody *first = pinnedFirst ? pair.m_a : pair.m_b, *second = pinnedFirst ? pair.m_b : pair.m_a;
		btElasticPlasticJoint* joint = pair.m_world.joint(*first, *second, pair.m_frame, capacity);
		pair.m_b->setLinearVelocity(btVector3(2, 0, 0));
		run(pair.m_world, 480, btScalar(1) / 240);
		// 24 J on 100 N, less what is elastic; the sum over steps is off by a step of motion.
		EXPECT_NEAR(24. / 100, joint->getPlasticPath(BT_EP_AXIAL), 2. / 240);
	}
}

TEST(HardJoints, DisabledJointsAreLeftAlone)
{
	for (Solver solver : {Solver::Iterative, Solver::Direct})
	{
		Pair pair(solver);
		btRigidBody* third = pair.m_world.body(12, pair.m_b->getCollisionShape(), at(2), false);
		btElasticPlasticJoint* first = pair.join(evenCapacity(1e5, 1e3));
		btElasticPlasticJoint* second = pair.m_world.joint(*pair.m_b, *third, at(1.5), evenCapacity(1e5, 1e3));
		pair.m_world.step(btScalar(1) / 60);
		second->getConstraint().setEnabled(false);
		pair.m_b->setLinearVelocity(btVector3(btScalar(0.1), 0, 0));
		third->setLinearVelocity(btVector3(3, 0, 0));
		run(pair.m_world, 60);
		EXPECT_NEAR(3, third->getLinearVelocity().x(), 1e-5);
		EXPECT_LT(pair.m_b->getCenterOfMassPosition().x(), 1.1);
		EXPECT_FALSE(first->hasYielded());
		// Enabled again, under Bullet's own solver: rows with bounds, impulses through its feedback.
		btSequentialImpulseConstraintSolver stock;
		btConstraintSolver* const ours = pair.m_world.bullet().getConstraintSolver();
		pair.m_world.bullet().setConstraintSolver(&stock);
		third->setCenterOfMassTransform(at(2));
		third->setLinearVelocity(btVector3(100, 0, 0));
		second->getConstraint().setEnabled(true);
		pair.m_world.step(btScalar(1) / 60);
		// 1 kN for a sixtieth on 12 kg
		EXPECT_GT(third->getLinearVelocity().x(), 100 - 2);
		pair.m_world.bullet().setConstraintSolver(ours);
	}
}

TEST(HardJoints, RewindsAcrossABreak)
{
	Pair pair;
	btElasticPlasticCapacity capacity = evenCapacity(1e5, 100);
	capacity.m_ductility[BT_EP_AXIAL] = btScalar(0.01);
	btElasticPlasticJoint* joint = pair.join(capacity);
	const btElasticPlasticState saved = joint->getState();
	const btTransform pose = pair.m_b->getCenterOfMassTransform();
	pair.m_b->setLinearVelocity(btVector3(2, 0, 0));
	run(pair.m_world, 60, btScalar(1) / 240);
	ASSERT_TRUE(joint->isBroken());
	EXPECT_EQ(0, pair.m_world.bullet().getNumConstraints());
	EXPECT_TRUE(joint->setState(saved));
	EXPECT_FALSE(joint->isBroken());
	EXPECT_EQ(1, pair.m_world.bullet().getNumConstraints());
	EXPECT_EQ(0, pair.m_world.action().getNumBroken());
	pair.m_b->setCenterOfMassTransform(pose);
	pair.m_b->setLinearVelocity(btVector3(0, 0, 0));
	for (int i = 0; i < 60; ++i)
	{
		pair.m_b->applyCentralForce(btVector3(50, 0, 0));
		pair.m_world.step(btScalar(1) / 240);
	}
	EXPECT_FALSE(joint->isBroken());
	EXPECT_LT(pair.m_b->getCenterOfMassPosition().x(), 1.01);
}
}  // namespace testHardJoints
