// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "trials/Handling.h"

#include <cmath>
#include <limits>

#include "scenes/Cantilever.h"
#include "trials/TrialRun.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace ep
{
namespace
{
const double STEP = 1. / 60;

/// A cube of 100 kg that hangs from a fixed one.
struct Pair
{
	World m_world;
	btRigidBody* m_support;
	btRigidBody* m_body;
	btElasticPlasticJoint* m_joint;

	Pair(const TrialSetup& setup, const btElasticPlasticCapacity& capacity, double gravity = 10, double distance = 1)
		: m_world(setup.method, btVector3(0, btScalar(-gravity), 0))
	{
		btCollisionShape* cube = m_world.box(btVector3(1, 1, 1));
		m_support = m_world.body(0, cube, at(0), false);
		m_body = m_world.body(100, cube, at(0, -distance), false);
		m_joint = m_world.joint(*m_support, *m_body, at(0, -distance / 2), capacity);
	}
};

Verdict capacityOf(const TrialSetup& setup, double yield)
{
	Pair pair(setup, evenCapacity(1e6, yield));
	TrialRun run(pair.m_world, setup);
	run.runFor(0.5, STEP);
	const double before = -double(pair.m_body->getLinearVelocity().y());
	run.runFor(0.5, STEP);
	const double v = -double(pair.m_body->getLinearVelocity().y());
	// Held where the yield value is beyond 2 m g, else it falls with what is left of g: the joint's force, mg at most. What it has gained, since velocities may stand half a step
	// before places or with them.
	return yield > 2000 ? run.verdict(v, 0, 1e-2) : run.verdict(2 * (v - before), 10 - yield / 100, 0.02);
}

Verdict infiniteCapacity(const TrialSetup& setup)
{
	Pair pair(setup, evenCapacity(1e6, std::numeric_limits<double>::infinity()));
	TrialRun run(pair.m_world, setup);
	run.runFor(1, STEP);
	// Refused with a message: it is not in the simulation.
	return run.verdict(-double(pair.m_body->getLinearVelocity().y()), 10, 0.02);
}

/// Both anchors at both centres of mass.
Verdict coincident(const TrialSetup& setup)
{
	Pair pair(setup, evenCapacity(1e6, btElasticPlasticCapacity::unlimited()), 10, 0);
	TrialRun run(pair.m_world, setup);
	run.runFor(3, STEP);
	return run.verdict(-double(pair.m_body->getCenterOfMassPosition().y()), 1e-3, 2e-5);
}

/// Frames that stand 10 mm apart and 0.1 rad askew pull themselves together.
Verdict misaligned(const TrialSetup& setup)
{
	World world(setup.method, btVector3(0, 0, 0));
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* support = world.body(0, cube, at(0), false);
	btRigidBody* body = world.body(100, cube, at(0, -1), false);
	const btTransform askew(btQuaternion(btVector3(0, 0, 1), btScalar(0.1)),
							btVector3(btScalar(0.01), btScalar(0.5), 0));
	auto* joint = new btElasticPlastic6DofSpring2Constraint(*support, *body, at(0, -0.5), askew);
	world.add(joint);
	joint->setCapacity(evenCapacity(1e6, btElasticPlasticCapacity::unlimited()));
	world.action().addJoint(joint);
	body->setDamping(btScalar(0.5), btScalar(0.5));
	double largest = 0;
	Verdict verdict;
	for (int i = 0; i < 600; ++i)
	{
		setup.look(world, i * STEP);
		world.step(btScalar(STEP));
		largest = std::max(largest, world.kineticEnergy());
		verdict.isFinite &= std::isfinite(largest);
	}
	// What the springs held: gap and turn, and the turn's arm of half a metre.
	const double held = 0.5 * 1e6 * (0.01 * 0.01 + 0.1 * 0.1) * 2;
	verdict.created = std::max(0., largest / held - 1);
	verdict.value = double(joint->getElasticEnergy());
	verdict.exact = 0;
	verdict.slack = 1e-3 * held;
	return verdict;
}

/// A kinematic support shakes by 0.1 m at 1 Hz: the body follows.
Verdict shaken(const TrialSetup& setup)
{
	Pair pair(setup, evenCapacity(1e6, btElasticPlasticCapacity::unlimited()), 0);
	pair.m_support->setCollisionFlags(pair.m_support->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
	Verdict verdict;
	for (int i = 1; i <= 240; ++i)
	{
		setup.look(pair.m_world, (i - 1) * STEP);
		const double x = 0.1 * std::sin(2 * SIMD_PI * i * STEP);
		pair.m_support->setWorldTransform(at(x));
		pair.m_world.step(btScalar(STEP));
		verdict.isFinite &= std::isfinite(pair.m_world.kineticEnergy());
	}
	verdict.value = double(pair.m_body->getCenterOfMassPosition().x());
	verdict.exact = 0;
	verdict.slack = 2e-3;  // of its own swing, 16 Hz
	return verdict;
}

/// A structure is put elsewhere as a whole, again and again: it hangs as before.
Verdict teleportedWhole(const TrialSetup& setup)
{
	btElasticPlasticCapacity capacity = evenCapacity(1e6, 2000);
	capacity.m_damping = btScalar(0.1);
	Pair pair(setup, capacity);
	TrialRun run(pair.m_world, setup);
	run.runFor(2, STEP);
	for (int i = 0; i < 10; ++i)
	{
		const btVector3 shift(btScalar(i % 2 == 0 ? 100 : -100), 0, 0);
		for (btRigidBody* body : {pair.m_support, pair.m_body})
		{
			btTransform pose = body->getCenterOfMassTransform();
			pose.setOrigin(pose.getOrigin() + shift);
			body->setCenterOfMassTransform(pose);
		}
		run.runFor(0.2, STEP);
	}
	return run.verdict(double(pair.m_joint->getForce(BT_EP_SHEAR_Y)), -1000, 10 + 1e6 * roundingAt(100));
}

/// One of two bodies is put 5 m away: what the joint takes then is plastic flow.
Verdict teleportedApart(const TrialSetup& setup)
{
	Pair pair(setup, evenCapacity(1e6, 2000), 0);
	pair.m_body->setCenterOfMassTransform(at(5, -1));
	Verdict verdict;
	double largest = 0;
	for (int i = 0; i < 600; ++i)
	{
		setup.look(pair.m_world, i * STEP);
		pair.m_world.step(btScalar(STEP));
		largest = std::max(largest, pair.m_world.kineticEnergy());
		verdict.isFinite &= std::isfinite(largest);
	}
	// The work of the yield force and moments from there to the place: no more.
	const double held = 2000 * 5.;
	verdict.created = std::max(0., largest / held - 1);
	return verdict;
}

/// A cantilever sleeps, is woken, and hangs as before.
Verdict asleep(const TrialSetup& setup)
{
	Cantilever::Settings settings;
	settings.method = setup.method;
	Cantilever cantilever(settings);
	TrialRun run(cantilever.m_world, setup);
	run.runFor(2, STEP);
	cantilever.m_world.allowSleep(btScalar(0.5));
	run.runFor(5, STEP);
	const bool slept = !cantilever.m_member.last().isActive();
	cantilever.m_member.last().activate(true);
	run.runFor(1, STEP);
	const double sag = cantilever.staticSag();
	return run.verdict(slept ? double(cantilever.sag()) : -1, sag, 0.01 * sag + roundingAt(2));
}

/// At nine tenths of its yield moment for an hour.
Verdict anHour(const TrialSetup& setup)
{
	Cantilever::Settings settings;
	settings.method = setup.method;
	settings.member.parts = 4;
	settings.member.material.m_yieldStress = btScalar(6.9e6);  // root moment 1540 N m of 1725
	Cantilever cantilever(settings);
	TrialRun run(cantilever.m_world, setup);
	// Loaded gently, for it would yield if gravity came at once.
	for (int i = 0; i < 600; ++i)
	{
		for (btRigidBody* part : cantilever.m_member.m_parts)
			part->setGravity(btVector3(0, btScalar(-9.81 * (i + 1) / 600), 0));
		run.step(STEP);
	}
	run.runFor(10, STEP);
	const double before = double(cantilever.sag());
	run.runFor(3600, STEP);
	double path = 0;
	for (btElasticPlasticJoint* joint : cantilever.m_world.joints())
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			path += double(joint->getPlasticPath(dof));
	return run.verdict(double(cantilever.sag()) - before + path, 0, roundingAt(2));
}

/// A force that is no number on the last of four bodies: the others stay as they are.
Verdict notANumber(const TrialSetup& setup)
{
	World world(setup.method, btVector3(0, 0, 0));
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	for (int i = 0; i < 4; ++i)
	{
		btRigidBody* body = world.body(12, cube, at(i), false);
		if (i > 0)
			world.joint(*world.bodies()[i - 1], *body, at(i - 0.5), evenCapacity(1e5, 1e3));
	}
	for (int i = 0; i < 60; ++i)
	{
		setup.look(world, i * STEP);
		if (i == 10)
			world.bodies()[3]->applyCentralForce(
				btVector3(std::numeric_limits<btScalar>::quiet_NaN(), std::numeric_limits<btScalar>::quiet_NaN(), 0));
		world.step(btScalar(STEP));
	}
	Verdict verdict;
	verdict.value = verdict.exact = 0;
	for (int i = 0; i < 3; ++i)
		verdict.value += double((world.bodies()[i]->getCenterOfMassPosition() - btVector3(btScalar(i), 0, 0)).length());
	verdict.isFinite = std::isfinite(verdict.value);
	verdict.slack = roundingAt(3);
	return verdict;
}
}  // namespace

std::vector<Trial> trialsOfHandling()
{
	std::vector<Trial> trials;
	for (const auto& [yield, name] : {std::pair(1e-9, "tiny"), std::pair(100., "a tenth of what it needs"),
									  std::pair(1e5, "100 times what it needs"), std::pair(1e15, "huge"),
									  std::pair(double(btElasticPlasticCapacity::unlimited()), "unlimited")})
		trials.push_back({"capacity", name, [y = yield](const TrialSetup& setup) { return capacityOf(setup, y); }});
	trials.push_back({"capacity", "infinite (refused)", infiniteCapacity});
	trials.push_back({"frames", "both anchors in both centres", coincident});
	trials.push_back({"frames", "10 mm and 0.1 rad askew", misaligned});
	trials.push_back({"partners", "kinematic, shaking", shaken});
	trials.push_back({"partners", "both put elsewhere", teleportedWhole});
	trials.push_back({"partners", "one put elsewhere", teleportedApart});
	trials.push_back({"long times", "asleep and woken", asleep});
	trials.push_back({"long times", "an hour at 0.9 of yield", anHour});
	trials.push_back({"bad input", "a force that is no number", notANumber});
	return trials;
}
}  // namespace ep
