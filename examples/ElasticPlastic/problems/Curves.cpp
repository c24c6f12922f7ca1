// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "problems/Curves.h"

#include <cmath>

#include "problems/Run.h"
#include "world/Place.h"

namespace ep
{
namespace
{
/// A body held by a bar of 1 m.
struct BodyOnBar
{
	World m_world;
	btRigidBody* m_body;
	btElasticPlasticJoint* m_joint;

	BodyOnBar(const Method& method, const btElasticPlasticMaterial& material, double side, double mass)
		: m_world(method, btVector3(0, 0, 0))
	{
		const btScalar half = btScalar(0.5);
		btCollisionShape* const box = m_world.box(btVector3(1, 1, 1));
		btRigidBody* const ground = m_world.body(0, box, at(-half), false);
		m_body = m_world.body(btScalar(mass), box, at(half), false);
		// Or it would buckle when it is pressed.
		m_body->setAngularFactor(0);
		const btElasticPlasticSection section =
			btElasticPlasticSection::rectangle(btScalar(side), btScalar(side)).withFibres(method.fibres);
		m_joint = m_world.joint(*ground, *m_body, at(0), btElasticPlasticCapacity::fromMember(material, section, 1, 1));
	}

	double stretch() const { return double(m_body->getCenterOfMassPosition().x()) - 0.5; }
};

/// Steel that gains 2 GPa for each unit of plastic strain, by the shift of its range of yield alone, pulled and pressed by 1.4 times its
/// yield force, so slowly that the body's inertia does not count. The range is as wide as ever: on the way back it flows from
/// (1.4 - 2) times the yield force on, and ends as far on the other side.
Outcome hardeningCycle(const Method& method, const Stepping& stepping)
{
	const double side = 0.02, area = side * side, youngsModulus = 200e9, yield = 250e6, hardening = 2e9, most = 1.4;
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(yield));
	steel.m_youngsModulus = btScalar(youngsModulus);
	steel.m_ultimatePlasticStrain = 10;
	steel.m_dampingRatio = 0;
	steel.m_kinematicShare = 1;
	steel.m_hardening.push_back({1, btScalar(yield + hardening)});
	BodyOnBar bar(method, steel, side, 10);
	Outcome outcome;
	double ends[2] = {};
	{
		Run run(bar.m_world, stepping, outcome);
		for (const double until : {1., 3.})
		{
			while (run.stepsUntil(until) > 0)
				run.step(
					[&]
					{
						// At its ends it stands still.
						const double share = std::sin((run.time() + run.dt()) * 3.14159265358979323846 / 2);
						bar.m_body->applyCentralForce(btVector3(btScalar(share * most * yield * area), 0, 0));
					});
			ends[until > 1] = bar.stretch();
		}
	}
	const double exact = most * yield / youngsModulus + (most - 1) * yield / hardening;
	outcome.quantities = {{"elongation under tension [m]", ends[0], exact},
						  {"elongation under compression [m]", ends[1], -exact}};
	return outcome;
}

/// A bar of concrete that a body tears as it flies away, and that takes up the crack's energy whatever its speed.
Outcome crackOpening(const Method& method, const Stepping& stepping)
{
	const double side = 0.1, tension = 3e6, compression = 30e6, fracture = 1000, mass = 1e7, speed = 0.005;
	btElasticPlasticMaterial concrete;
	concrete.m_youngsModulus = btScalar(30e9);
	concrete.m_yieldStress = btScalar(compression);
	concrete.m_tensileShare = btScalar(tension / compression);
	concrete.m_crushingStrain = btScalar(0.1);
	concrete.m_fractureEnergy = btScalar(fracture);
	concrete.m_dampingRatio = 0;
	BodyOnBar bar(method, concrete, side, mass);
	bar.m_body->setLinearVelocity(btVector3(btScalar(speed), 0, 0));
	Outcome outcome;
	{
		Run run(bar.m_world, stepping, outcome);
		while (run.stepsUntil(0.5) > 0)
			run.step();
	}
	const double left = double(bar.m_body->getLinearVelocity().x());
	outcome.quantities = {
		{"energy that the crack has taken [J]", bar.m_joint->getPlasticEnergy(), fracture * side * side},
		{"energy that the body has lost [J]", mass * (speed * speed - left * std::fabs(left)) / 2,
		 fracture * side * side}};
	return outcome;
}
}  // namespace

std::vector<Problem> problemsOfCurves()
{
	return {
		{"hardening-cycle", "a bar of steel that hardens kinematically, pulled and pressed",
		 "stress over plastic strain in closed form", hardeningCycle, true},
		{"crack-opening", "a bar of concrete that a body tears", "fracture energy times area", crackOpening, true},
	};
}
}  // namespace ep
