// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "problems/Bars.h"

#include <algorithm>
#include <cmath>

#include "problems/Run.h"
#include "scenes/BlockUnderTension.h"
#include "scenes/ExactOscillator.h"

namespace ep
{
namespace
{
BlockUnderTension::Settings blockOf(const Method& method)
{
	BlockUnderTension::Settings settings;
	settings.method = method;
	return settings;
}

/// The block's own joint, for exact solutions.
ExactOscillator oscillatorOf(const BlockUnderTension& block)
{
	const btElasticPlasticCapacity& capacity = block.m_world.nominal(*block.m_joint);
	return {1 / double(block.m_block->getInvMass()), double(capacity.m_stiffness[BT_EP_AXIAL]),
			double(capacity.m_yield[BT_EP_AXIAL])};
}

Outcome releasedBlock(const Method& method, const Stepping& stepping)
{
	BlockUnderTension block(blockOf(method));
	Outcome outcome;
	double deepest = 0;
	{
		Run run(block.m_world, stepping, outcome);
		while (run.stepsUntil(0.4) > 0)
		{
			run.step();
			deepest = std::max(deepest, double(block.sunk()));
		}
	}
	ExactOscillator exact = oscillatorOf(block);
	exact.advance(10 / double(block.m_block->getInvMass()), 0.4);
	outcome.quantities = {
		{"plastic elongation [m]", double(block.m_joint->getPlasticDeformation(BT_EP_AXIAL)), exact.m_plastic},
		{"deepest place [m]", deepest, exact.m_plastic + exact.m_yield / exact.m_stiffness}};
	return outcome;
}

/// A square wave of 5 Hz for a second, downwards first.
Outcome reversed(const Method& method, const Stepping& stepping, double pull)
{
	BlockUnderTension::Settings settings = blockOf(method);
	settings.gravity = 0;
	BlockUnderTension block(settings);
	Outcome outcome;
	{
		Run run(block.m_world, stepping, outcome);
		const int half = std::max(1, run.stepsUntil(0.1));
		for (int i = 0; i < 10 * half; ++i)
			run.step([&] { block.pull(btScalar(i / half % 2 == 0 ? pull : -pull)); });
	}
	ExactOscillator exact = oscillatorOf(block);
	for (int i = 0; i < 10; ++i)
		exact.advance(i % 2 == 0 ? pull : -pull, 0.1);
	outcome.quantities = {
		{"plastic path [m]", double(block.m_joint->getPlasticPath(BT_EP_AXIAL)), exact.m_path},
		{"plastic offset [m]", double(block.m_joint->getPlasticDeformation(BT_EP_AXIAL)), exact.m_plastic},
		{"dissipated energy [J]", block.m_joint->getPlasticEnergy(), exact.energy()}};
	return outcome;
}

Outcome reversedGently(const Method& method, const Stepping& stepping) { return reversed(method, stepping, 60e3); }
Outcome reversedHard(const Method& method, const Stepping& stepping) { return reversed(method, stepping, 90e3); }

Outcome overloaded(const Method& method, const Stepping& stepping)
{
	BlockUnderTension::Settings settings = blockOf(method);
	settings.mass = 10000;
	settings.ductility = btScalar(0.2);
	BlockUnderTension block(settings);
	Outcome outcome;
	double broken = HUGE_VAL;
	{
		Run run(block.m_world, stepping, outcome);
		while (run.stepsUntil(1) > 0 && !block.m_joint->isBroken())
			run.step();
		btElasticPlasticEvent event;
		while (block.m_world.action().popEvent(event))
			if (event.m_type == BT_EP_EVENT_BREAK)
				broken = event.m_time;
	}
	ExactOscillator exact = oscillatorOf(block);
	double time = 0;
	for (; exact.m_path < double(settings.ductility); time += 1e-5)
		exact.advance(100e3, 1e-5);
	outcome.quantities = {{"time of break [s]", broken, time}};
	return outcome;
}

/// A load P put on at once: P/Py = 1 - 1/(2 mu), with mu the largest elongation over that at yield.
Outcome suddenlyLoaded(const Method& method, const Stepping& stepping, double ductility)
{
	BlockUnderTension::Settings settings = blockOf(method);
	settings.gravity = 0;
	BlockUnderTension block(settings);
	const ExactOscillator exact = oscillatorOf(block);
	const double load = exact.m_yield * (1 - 1 / (2 * ductility));
	Outcome outcome;
	double deepest = 0;
	{
		Run run(block.m_world, stepping, outcome);
		// It stands at its deepest within some periods of 67 ms, the later the more it flows.
		while (run.stepsUntil(0.5) > 0)
		{
			run.step([&] { block.pull(btScalar(load)); });
			deepest = std::max(deepest, double(block.sunk()));
		}
	}
	outcome.quantities = {
		{"largest elongation over that at yield", deepest * exact.m_stiffness / exact.m_yield, ductility}};
	return outcome;
}

Outcome suddenLoad1(const Method& method, const Stepping& stepping) { return suddenlyLoaded(method, stepping, 1); }
Outcome suddenLoad3(const Method& method, const Stepping& stepping) { return suddenlyLoaded(method, stepping, 3); }
Outcome suddenLoad10(const Method& method, const Stepping& stepping) { return suddenlyLoaded(method, stepping, 10); }

/// A disc on a bar: inertia, torsional or bending stiffness and yield moment, all of one size.
struct Disc
{
	static constexpr double MASS = 600, SIDE = 1, STIFFNESS = 4e5, YIELD = 4e3;

	World m_world;
	btRigidBody* m_body;
	btElasticPlasticJoint* m_joint;
	int m_dof;

	Disc(const Method& method, int dof) : m_world(method, btVector3(0, 0, 0)), m_dof(dof)
	{
		const btTransform middle = btTransform::getIdentity();
		btCollisionShape* cube = m_world.box(btVector3(btScalar(SIDE), btScalar(SIDE), btScalar(SIDE)));
		btRigidBody* support = m_world.body(0, cube, middle, false);
		m_body = m_world.body(btScalar(MASS), cube, middle, false);
		btElasticPlasticCapacity capacity;
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			capacity.set(i, btScalar(i < 3 ? 1e8 : STIFFNESS), i == dof ? btScalar(YIELD) : capacity.unlimited());
		m_joint = m_world.joint(*support, *m_body, middle, capacity);
	}

	static ExactOscillator oscillator() { return {MASS * SIDE * SIDE / 6, STIFFNESS, YIELD}; }
	btVector3 axis() const
	{
		btVector3 a(0, 0, 0);
		a[m_dof - 3] = 1;
		return a;
	}
};

/// Turned by a constant moment for half a second, then let go.
Outcome twistedBar(const Method& method, const Stepping& stepping)
{
	Disc disc(method, BT_EP_TORSION);
	const double moment = 0.9 * Disc::YIELD;
	Outcome outcome;
	{
		Run run(disc.m_world, stepping, outcome);
		for (int i = run.stepsUntil(0.5); i > 0; --i)
			run.step([&] { disc.m_body->applyTorque(disc.axis() * btScalar(moment)); });
	}
	ExactOscillator exact = Disc::oscillator();
	exact.advance(moment, 0.5);
	outcome.quantities = {
		{"plastic twist [rad]", double(disc.m_joint->getPlasticDeformation(BT_EP_TORSION)), exact.m_plastic}};
	return outcome;
}

/// Bent to and fro by a moment that changes its sign every 0.1 s.
Outcome cyclicBending(const Method& method, const Stepping& stepping)
{
	Disc disc(method, BT_EP_BENDING_Z);
	const double moment = 0.9 * Disc::YIELD;
	Outcome outcome;
	ExactOscillator exact = Disc::oscillator();
	{
		Run run(disc.m_world, stepping, outcome);
		const int half = std::max(1, run.stepsUntil(0.1));
		for (int i = 0; i < 10 * half; ++i)
			run.step([&] { disc.m_body->applyTorque(disc.axis() * btScalar(i / half % 2 == 0 ? moment : -moment)); });
	}
	for (int i = 0; i < 10; ++i)
		exact.advance(i % 2 == 0 ? moment : -moment, 0.1);
	outcome.quantities = {
		{"plastic path [rad]", double(disc.m_joint->getPlasticPath(BT_EP_BENDING_Z)), exact.m_path},
		{"plastic angle [rad]", double(disc.m_joint->getPlasticDeformation(BT_EP_BENDING_Z)), exact.m_plastic}};
	return outcome;
}

const char* const OSCILLATOR = "elastic and plastic motion of one degree of freedom, phase by phase in closed form";
}  // namespace

std::vector<Problem> problemsOfBars()
{
	return {
		{"block-released", "6 t let go on a steel joint: yields, then swings", OSCILLATOR, releasedBlock},
		{"block-reversed-60kN", "6 t pulled to and fro by 60 kN at 5 Hz", OSCILLATOR, reversedGently},
		{"block-reversed-90kN", "6 t pulled to and fro by 90 kN at 5 Hz", OSCILLATOR, reversedHard},
		{"block-overloaded", "10 t on a joint that holds 8 t, until it breaks", OSCILLATOR, overloaded},
		{"sudden-load-1", "half the yield force put on at once", "P/Py = 1 - 1/(2 mu)", suddenLoad1},
		{"sudden-load-3", "5/6 of the yield force put on at once", "P/Py = 1 - 1/(2 mu)", suddenLoad3},
		{"sudden-load-10", "19/20 of the yield force put on at once", "P/Py = 1 - 1/(2 mu)", suddenLoad10},
		{"twisted-bar", "a bar twisted by 0.9 of its yield moment put on at once", OSCILLATOR, twistedBar},
		{"cyclic-bending", "a hinge bent to and fro by 0.9 of its yield moment", OSCILLATOR, cyclicBending},
	};
}
}  // namespace ep
