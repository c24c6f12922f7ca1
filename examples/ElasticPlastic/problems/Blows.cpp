// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "problems/Blows.h"

#include <cmath>

#include "problems/Run.h"
#include "scenes/BeamOnSupports.h"
#include "scenes/ParkesCantilever.h"

namespace ep
{
namespace
{
/// A body that turns about a hinge: all of its energy but what the hinge stores becomes plastic work.
Outcome hingeStopsBody(const Method& method, const Stepping& stepping)
{
	const double mass = 600, side = 1, stiffness = 4e5, yield = 4e3, spin = 10;
	World world(method, btVector3(0, 0, 0));
	btCollisionShape* cube = world.box(btVector3(btScalar(side), btScalar(side), btScalar(side)));
	btRigidBody* support = world.body(0, cube, btTransform::getIdentity(), false);
	btRigidBody* body = world.body(btScalar(mass), cube, btTransform::getIdentity(), false);
	btElasticPlasticCapacity capacity;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		capacity.set(i, btScalar(i < 3 ? 1e8 : stiffness),
					 i == BT_EP_BENDING_Z ? btScalar(yield) : capacity.unlimited());
	btElasticPlasticJoint* joint = world.joint(*support, *body, btTransform::getIdentity(), capacity);
	body->setAngularVelocity(btVector3(0, 0, btScalar(spin)));
	Outcome outcome;
	Run run(world, stepping, outcome);
	while (run.stepsUntil(1) > 0)
		run.step();
	const double energy = mass * side * side / 6 * spin * spin / 2;
	outcome.quantities = {{"plastic angle [rad]", double(joint->getPlasticDeformation(BT_EP_BENDING_Z)),
						   energy / yield - yield / (2 * stiffness)}};
	return outcome;
}

/// The cantilever struck at its tip: mean over a tenth of a second in which it swings about where it stays.
Outcome parkes(const Method& method, const Stepping& stepping, btScalar tipMass, btScalar velocity, double tip)
{
	ParkesCantilever::Settings settings;
	settings.method = method;
	settings.tipMass = tipMass;
	settings.velocity = velocity;
	ParkesCantilever cantilever(settings);
	Outcome outcome;
	Run run(cantilever.m_world, stepping, outcome);
	const double mean = run.meanUntil(0.2, 0.1, [&] { return cantilever.tip(); });
	outcome.quantities = {{"displacement of the tip that stays [m]", mean, tip}};
	return outcome;
}

// References: explicit integration at 0.1 us (tests/problems/testReferences.cpp). Parkes' own formula, for small deflections and without
// elasticity, gives 0.582 m for the heavy mass.
Outcome parkesHeavy(const Method& method, const Stepping& stepping)
{
	return parkes(method, stepping, btScalar(1.5), 25, 0.61913);
}
Outcome parkesLight(const Method& method, const Stepping& stepping)
{
	return parkes(method, stepping, btScalar(0.3), 50, 0.28831);
}

// Reference: this solver in double with steps of 2 us; with 4, 8, 16 and 130 us it gives 0.3322, 0.3327, 0.3299 and 0.3261 m. The
// box and the blocks touch and part again and again: a per cent is what the answer is good for.
Outcome droppedMass(const Method& method, const Stepping& stepping)
{
	BeamOnSupports::Settings settings;
	settings.method = method;
	BeamOnSupports beam(settings);
	Outcome outcome;
	Run run(beam.m_world, stepping, outcome);
	while (run.stepsUntil(1) > 0)
		run.step();
	outcome.quantities = {{"sag that stays [m]", double(beam.sag()), 0.3330}};
	return outcome;
}
}  // namespace

std::vector<Problem> problemsOfBlows()
{
	return {
		{"hinge-stops-body", "a turning body that a hinge brings to rest", "conservation of energy", hingeStopsBody},
		{"parkes-heavy", "a cantilever struck at its tip, mass ratio 0.96", "explicit integration at 0.1 us",
		 parkesHeavy},
		{"parkes-light", "a cantilever struck at its tip, mass ratio 0.19", "explicit integration at 0.1 us",
		 parkesLight},
		{"dropped-mass", "2 t dropped on a beam that lies on supports", "own solution at 2 us", droppedMass},
	};
}
}  // namespace ep
