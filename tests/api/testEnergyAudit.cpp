// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Where energy goes, beside exact answers: each way by itself, and that the sum closes.

#include <float.h>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticEnergyAudit.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticStepper.h"
#include "scenes/Member.h"
#include "support/Close.h"
#include "support/Pair.h"
#include "vehicle/Vehicle.h"

namespace testEnergyAudit
{
using ep::at;
using ep::Solver;
using ep::World;

/// What may be left over of the energy at play: velocities and impulses are rounded once a step.
const double ROUNDING = byPrecision(1e-12, 1e-5);
/// What is asked for where nothing is exact.
const double CLOSED = 1e-3;

/// A world whose substeps are audited, as a game does it.
struct Audited
{
	World& m_world;
	btElasticPlasticEnergyAudit m_audit;

	explicit Audited(World& world) : m_world(world), m_audit(world.bullet(), world.action())
	{
		world.bullet().setInternalTickCallback(
			[](btDynamicsWorld* w, btScalar)
			{ static_cast<btElasticPlasticEnergyAudit*>(w->getWorldUserInfo())->begin(); },
			&m_audit, true);
	}
	~Audited() { m_world.bullet().setInternalTickCallback(nullptr, nullptr, true); }

	const btElasticPlasticEnergyBalance& run(int steps, btScalar dt = FRAME)
	{
		::run(m_world, steps, dt);
		return balance();
	}
	const btElasticPlasticEnergyBalance& balance()
	{
		m_audit.begin();
		return m_audit.getBalance();
	}
};

void expectClosed(const btElasticPlasticEnergyBalance& b, double share)
{
	EXPECT_NEAR(b.m_rest, 0, share * b.m_turnover);
	EXPECT_NEAR(b.m_kinetic + b.m_elastic, b.getGiven() - b.getTaken() - b.m_rest, 1e-9 * b.m_turnover);
}

btRigidBody* boxOnGround(World& world, btScalar friction)
{
	world.body(0, world.keep(new btStaticPlaneShape(btVector3(0, 1, 0), 0)), at(0))->setFriction(1);
	btRigidBody* const box = world.body(8, world.box(btVector3(1, 1, 1)), at(0, btScalar(.5)));
	box->setFriction(friction);
	return box;
}

TEST(EnergyAudit, ABoxThatFalls)
{
	World world;
	world.body(3, world.box(btVector3(1, 1, 1)), at(0));
	Audited audited(world);
	const btElasticPlasticEnergyBalance b = audited.run(30);
	// By mean velocities the weight's work is what the box has: 10 m/s^2 for 0.5 s.
	expectClose(0.5 * 3 * 25, b.m_gravity, byPrecision(1e-12, 1e-5));
	expectClose(0.5 * 3 * 25, b.m_kinetic, byPrecision(1e-12, 1e-5));
	// Of sums that -ffast-math adds in any order, 30 of up to 40 J.
	EXPECT_NEAR(b.getTaken(), 0, 30 * 40 * DBL_EPSILON);
	EXPECT_EQ(b.m_others, 0);
	expectClosed(b, ROUNDING);
}

TEST(EnergyAudit, ABoxThatSlidesToItsRest)
{
	for (const Solver solver : {Solver::Stock, Solver::Direct})
	{
		World world(solver);
		btRigidBody* const box = boxOnGround(world, btScalar(.4));
		box->setAngularFactor(0);
		box->setLinearVelocity(btVector3(4, 0, 0));
		Audited audited(world);
		const btElasticPlasticEnergyBalance b = audited.run(120);
		expectClose(0.5 * 8 * 16, b.m_begin);
		// All of its motion, but for what the search of a contact leaves of its fall into it.
		EXPECT_NEAR(b.m_friction, 64, 0.01 * 64);
		EXPECT_NEAR(b.m_contacts, b.m_gravity, 0.01 * 64);
		EXPECT_NEAR(b.m_kinetic, 0, 1e-3);
		expectClosed(b, ROUNDING);
	}
}

TEST(EnergyAudit, ABallThatBounces)
{
	World world(Solver::Stock, btVector3(0, 0, 0));
	world.body(0, world.keep(new btStaticPlaneShape(btVector3(0, 1, 0), 0)), at(0))->setRestitution(1);
	btRigidBody* const ball = world.body(2, world.keep(new btSphereShape(btScalar(.5))), at(0, btScalar(.5)));
	ball->setRestitution(btScalar(.5));
	ball->setLinearVelocity(btVector3(0, -4, 0));
	Audited audited(world);
	const btElasticPlasticEnergyBalance b = audited.run(5);
	expectClose(2, double(ball->getLinearVelocity().y()), byPrecision(1e-6, 1e-4));
	// 16 J, of which half of the speed leaves a quarter.
	expectClose(12, b.m_contacts, byPrecision(1e-6, 1e-4));
	EXPECT_NEAR(b.m_friction, 0, ROUNDING * b.m_turnover);
	expectClosed(b, ROUNDING);
}

TEST(EnergyAudit, APendulumOfBullets)
{
	for (const Solver solver : {Solver::Stock, Solver::Direct})
	{
		World world(solver);
		btRigidBody* const bob = world.body(2, world.keep(new btSphereShape(btScalar(.1))), at(1));
		world.add(new btPoint2PointConstraint(*bob, btVector3(-1, 0, 0)));
		{
			Audited audited(world);
			const btElasticPlasticEnergyBalance b = audited.run(240, btScalar(1) / 240);
			// What the constraint takes is all that is not in the swing.
			EXPECT_NEAR(b.m_constraints, b.m_gravity - b.m_kinetic - b.m_turning, 1e-4 * b.m_turnover);
			EXPECT_LT(std::fabs(b.m_constraints), 0.05 * b.m_turnover);
			expectClosed(b, ROUNDING);
			EXPECT_TRUE(world.constraints()[0]->getJointFeedback() != nullptr) << "it listens to the next step";
			run(world, 1);
			EXPECT_TRUE(world.constraints()[0]->getJointFeedback() == nullptr) << "and not beyond";
			audited.balance();
		}
		EXPECT_TRUE(world.constraints()[0]->getJointFeedback() == nullptr) << "it leaves nothing behind";
	}
}

TEST(EnergyAudit, AMotorGives)
{
	World world(Solver::Stock, btVector3(0, 0, 0));
	btRigidBody* const wheel = world.body(5, world.keep(new btSphereShape(1)), at(0));
	auto* const hinge = new btHingeConstraint(*wheel, btVector3(0, 0, 0), btVector3(0, 0, 1));
	hinge->enableAngularMotor(true, 20, btScalar(.1));
	world.add(hinge);
	Audited audited(world);
	const btElasticPlasticEnergyBalance b = audited.run(60);
	EXPECT_GT(b.m_kinetic, 5);
	EXPECT_NEAR(-b.m_constraints, b.m_kinetic, byPrecision(1e-10, 1e-5) * b.m_kinetic);
	expectClosed(b, byPrecision(1e-10, 1e-5));
}

TEST(EnergyAudit, AJointThatYieldsAndBreaks)
{
	for (const Solver solver : {Solver::Direct, Solver::Iterative})
	{
		Pair pair(solver);
		btElasticPlasticCapacity capacity = ep::evenCapacity(1e7);
		capacity.set(BT_EP_AXIAL, btScalar(1e6), 1000, btScalar(.05));
		btElasticPlasticJoint* const joint = pair.join(capacity);
		pair.m_b->setLinearVelocity(btVector3(4, 0, 0));
		Audited audited(pair.m_world);
		btElasticPlasticEnergyBalance b;
		for (int i = 0; i < 200 && !joint->isBroken(); ++i)
			b = audited.run(1, btScalar(1) / 2000);
		ASSERT_TRUE(joint->isBroken());
		// The yield force along the ductility, and what was in the spring.
		expectClose(1000 * 0.05, b.m_plastic, byPrecision(1e-6, 1e-4));
		expectClose(1000. * 1000 / 2 / 1e6, b.m_broken, byPrecision(1e-6, 1e-3));
		EXPECT_EQ(b.m_elastic, 0);
		expectClose(b.m_begin, 0.5 * 12 * 16);
		EXPECT_NEAR(b.m_kinetic, b.m_begin - 50.5 - b.m_numerical - b.m_damping, 1e-4 * b.m_begin);
		expectClosed(b, byPrecision(1e-10, 1e-5));
	}
}

TEST(EnergyAudit, LoadsGive)
{
	World world(Solver::Direct, btVector3(0, 0, 0));
	btRigidBody* const box = world.body(4, world.box(btVector3(1, 1, 1)), at(0));
	world.beforeSubsteps([&](btScalar) { box->applyForce(btVector3(6, 0, 0), btVector3(0, btScalar(.5), 0)); });
	Audited audited(world);
	const btElasticPlasticEnergyBalance b = audited.run(60);
	const double speed = 6. / 4;
	EXPECT_GT(b.m_loads, 0.5 * 4 * speed * speed) << "it turns, too";
	expectClose(b.m_loads, b.m_kinetic + b.m_turning, byPrecision(1e-12, 1e-5));
	expectClosed(b, ROUNDING);
}

TEST(EnergyAudit, BulletsDamping)
{
	World world(Solver::Direct, btVector3(0, 0, 0));
	btRigidBody* const ball = world.body(4, world.keep(new btSphereShape(1)), at(0));
	ball->setLinearVelocity(btVector3(3, 0, 0));
	ball->setAngularVelocity(btVector3(0, 2, 0));
	ball->setDamping(btScalar(.3), btScalar(.6));
	Audited audited(world);
	const btElasticPlasticEnergyBalance b = audited.run(60);
	// A share of the velocity in a second.
	const double linear = 0.5 * 4 * 9, angular = 0.5 * (0.4 * 4) * 4;
	expectClose(linear * (1 - 0.49) + angular * (1 - 0.16), b.m_bulletDamping, byPrecision(1e-10, 1e-5));
	expectClosed(b, ROUNDING);
}

TEST(EnergyAudit, WhatOthersDoToVelocities)
{
	World world(Solver::Direct, btVector3(0, 0, 0));
	btRigidBody* const box = world.body(4, world.box(btVector3(1, 1, 1)), at(0));
	Audited audited(world);
	audited.run(3);
	box->applyCentralImpulse(btVector3(8, 0, 0));
	audited.run(3);
	box->setLinearVelocity(btVector3(1, 0, 0));
	btElasticPlasticEnergyBalance b = audited.run(3);
	expectClose(0.5 * 4 * 1, b.m_others);
	// One that comes brings what it has, and takes away what it has.
	btRigidBody* const guest = world.body(2, world.box(btVector3(1, 1, 1)), at(9));
	guest->setLinearVelocity(btVector3(0, 5, 0));
	b = audited.run(2);
	expectClose(2 + 25, b.m_others);
	world.bullet().removeRigidBody(guest);
	b = audited.run(2);
	expectClose(2, b.m_others);
	expectClosed(b, ROUNDING);
	audited.m_audit.reset();
	EXPECT_EQ(audited.balance().m_others, 0);
	expectClose(2, audited.balance().m_begin);
}

TEST(EnergyAudit, WhatFallsAsleep)
{
	World world(Solver::Direct, btVector3(0, 0, 0));
	btRigidBody* const box = world.body(4, world.box(btVector3(1, 1, 1)), at(0));
	box->setLinearVelocity(btVector3(btScalar(.01), 0, 0));
	world.allowSleep(btScalar(.02));
	Audited audited(world);
	const btElasticPlasticEnergyBalance b = audited.run(150);
	EXPECT_FALSE(box->isActive());
	expectClose(0.5 * 4 * 1e-4, b.m_sleep, 1e-5);
	EXPECT_NEAR(b.m_others, 0, 1e-9);
}

TEST(EnergyAudit, ABodyThatTumbles)
{
	World world(Solver::Direct, btVector3(0, 0, 0));
	btRigidBody* const box = world.body(6, world.box(btVector3(1, 2, 3)), at(0));
	box->setAngularVelocity(btVector3(3, 5, 2));
	Audited audited(world);
	const btElasticPlasticEnergyBalance b = audited.run(120);
	// Nothing acts on it: what Bullet's steps make of its spin is their own.
	EXPECT_NEAR(b.m_turning, b.m_begin - b.m_kinetic, byPrecision(1e-12, 1e-4) * b.m_begin);
	expectClosed(b, byPrecision(1e-12, 1e-4));
}

TEST(EnergyAudit, ASupportThatMovesAJoint)
{
	Pair pair(Solver::Direct);
	makeKinematic(*pair.m_a);
	pair.join(ep::evenCapacity(1e5));
	// 2 m/s, from the first step: 12 kg are taken along by a spring.
	const btScalar dt = btScalar(1) / 1000;
	int step = 0;
	pair.m_world.beforeSubsteps([&](btScalar h) { pair.m_a->setWorldTransform(at(2 * h * btScalar(++step))); });
	Audited audited(pair.m_world);
	const btElasticPlasticEnergyBalance b = audited.run(400, dt);
	EXPECT_GT(b.m_kinetic, 1);
	// Without it the sum would not close: nobody else gives.
	EXPECT_LT(b.m_constraints, -b.m_kinetic);
	expectClosed(b, CLOSED);
}

TEST(EnergyAudit, AVehicle)
{
	World world(Solver::Direct);
	world.body(0, world.keep(new btStaticPlaneShape(btVector3(0, 1, 0), 0)), at(0));
	ep::Vehicle vehicle(world, ep::VehicleSettings(), at(0));
	world.beforeSubsteps([&](btScalar dt) { vehicle.updateVehicle(dt); });
	Audited audited(world);
	for (int i = 0; i < 300; ++i)
	{
		ep::Controls controls;
		controls.throttle = i < 200 ? 1 : -1;
		vehicle.drive(controls, FRAME);
		audited.run(1);
	}
	const btElasticPlasticEnergyBalance b = audited.balance();
	// Wheels push it by impulses between the steps: weight takes from what suspensions give, all else is drive and brakes.
	EXPECT_GT(b.m_turnover, 1e5);
	EXPECT_NEAR(b.m_others + b.m_gravity - b.m_turning, b.m_kinetic, 1e-4 * b.m_turnover);
	EXPECT_EQ(b.m_contacts, 0);
	expectClosed(b, byPrecision(1e-12, 1e-4));
}

/// A cantilever of steel that a mass falls on, yields, breaks, and slides on the ground.
struct Wreck
{
	World m_world;

	explicit Wreck(Solver solver, double innerError = 0) : m_world(solver)
	{
		m_world.body(0, m_world.keep(new btStaticPlaneShape(btVector3(0, 1, 0), 0)), at(0))->setFriction(1);
		if (auto* const ours = dynamic_cast<btElasticPlasticConstraintSolver*>(m_world.bullet().getConstraintSolver()))
		{
			btElasticPlasticSolverSettings settings = ours->getSettings();
			settings.m_innerError = innerError;
			ours->setSettings(settings);
		}
		const auto material = btElasticPlasticMaterial::steel(btScalar(200e6));
		const auto section = btElasticPlasticSection::rectangle(btScalar(.05), btScalar(.05));
		btRigidBody* before = m_world.body(0, m_world.box(btVector3(1, 4, 1)), at(btScalar(-.5), 2));
		const btScalar length = btScalar(.3);
		for (int i = 0; i < 8; ++i)
		{
			btRigidBody* const block = m_world.body(6, m_world.box(btVector3(length, btScalar(.1), btScalar(.1))),
													at((i + btScalar(.5)) * length, 3));
			block->setFriction(btScalar(.6));
			m_world.joint(
				*before, *block, at(i * length, 3),
				btElasticPlasticCapacity::fromMember(material, section, i == 0 ? 0 : length, length, btScalar(.05)));
			before = block;
		}
		btRigidBody* const mass = m_world.body(800, m_world.box(btVector3(1, 1, 1)), at(2, btScalar(4.2)));
		mass->setLinearVelocity(btVector3(1, -6, btScalar(.5)));
		mass->setFriction(btScalar(.6));
	}
};

TEST(EnergyAudit, TheSumClosesInAWreck)
{
	const struct
	{
		Solver solver;
		double inner;
	} cases[] = {{Solver::Direct, 0}, {Solver::Direct, 0.01}, {Solver::Iterative, 0}, {Solver::Stock, 0}};
	for (const auto& c : cases)
	{
		SCOPED_TRACE(testing::Message() << int(c.solver) << ' ' << c.inner);
		Wreck wreck(c.solver, c.inner);
		Audited audited(wreck.m_world);
		for (int i = 0; i < 120; ++i)
			expectClosed(audited.run(1), CLOSED);
		const btElasticPlasticEnergyBalance b = audited.balance();
		EXPECT_GE(b.m_plastic, c.solver == Solver::Direct ? 100 : 0);
		EXPECT_GT(b.m_contacts, 100);
		EXPECT_GT(b.m_friction, 100);
	}
}

TEST(EnergyAudit, FollowsTheSubstepsOfAStepper)
{
	Wreck wreck(Solver::Direct);
	Audited audited(wreck.m_world);
	btElasticPlasticStepper stepper(
		wreck.m_world.bullet(), wreck.m_world.action(),
		static_cast<btElasticPlasticConstraintSolver*>(wreck.m_world.bullet().getConstraintSolver()), 0.02, FRAME);
	for (int i = 0; i < 60; ++i)
		stepper.step();
	expectClosed(audited.balance(), CLOSED);
	EXPECT_GT(audited.balance().m_plastic, 100);
}

/// A body that has become NaN has no energy. What it had is gone with it, and the balance of the others goes on.
TEST(EnergyAudit, ABodyThatBecomesNaN)
{
	for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
		for (const bool isWithin : {false, true})
		{
			World world(solver);
			btCollisionShape* const cube = world.box(btVector3(1, 1, 1));
			btRigidBody *const falls = world.body(3, cube, at(-20)), *const goesBad = world.body(2, cube, at(20));
			goesBad->setLinearVelocity(btVector3(5, 0, 0));
			Audited audited(world);
			audited.run(10);
			const double kinetic = goesBad->getMass() * btScalar(.5) * goesBad->getLinearVelocity().length2();
			// With -ffast-math clang would take a NaN that it sees for anything.
			const volatile btScalar hidden = std::numeric_limits<btScalar>::quiet_NaN();
			const btScalar nan = hidden;
			if (isWithin)
				goesBad->applyCentralForce(btVector3(nan, 0, 0));
			else
				goesBad->setLinearVelocity(btVector3(nan, 0, 0));
			const btElasticPlasticEnergyBalance b = audited.run(20);
			const double left = 0.5 * 3 * double(falls->getLinearVelocity().length2());
			EXPECT_NEAR(left, b.m_kinetic, left * ROUNDING);
			EXPECT_NEAR(-kinetic, b.m_others, kinetic * ROUNDING) << isWithin;
			expectClosed(b, ROUNDING);
		}
}

TEST(EnergyAudit, ChangesNothing)
{
	std::vector<btVector3> places[2];
	for (const bool isAudited : {false, true})
	{
		Wreck wreck(Solver::Direct, 0.01);
		std::unique_ptr<Audited> audited(isAudited ? new Audited(wreck.m_world) : nullptr);
		run(wreck.m_world, 60);
		for (const auto& body : wreck.m_world.bodies())
		{
			places[isAudited].push_back(body->getCenterOfMassPosition());
			places[isAudited].push_back(body->getAngularVelocity());
		}
	}
	EXPECT_TRUE(places[0] == places[1]);
}
}  // namespace testEnergyAudit
