// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "problems/Curves.h"

#include <cmath>

#include "problems/Run.h"
#include "text/Format.h"
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
	btElasticPlasticCapacity m_capacity;

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
		m_capacity = btElasticPlasticCapacity::fromMember(material, section, 1, 1);
		m_joint = m_world.joint(*ground, *m_body, at(0), m_capacity);
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
/// Mild steel that is the stronger the faster it flows, and stops a body: m v dv = -F (1 + (v / D l)^(1/5)) dx. With v = D l u^5 that is the
/// integral of u^9 / (1 + u). So stiff that what is elastic does not count.
Outcome rateStopsBody(const Method& method, const Stepping& stepping)
{
	const double side = 0.02, yield = 250e6, force = side * side * yield, mass = 1000;
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(yield));
	steel.m_youngsModulus *= 100;
	steel.m_ultimatePlasticStrain = 10;
	steel.m_dampingRatio = 0;
	steel.m_rate = btElasticPlasticRate::mildSteel();
	const double reference = double(steel.m_rate.m_reference);
	Outcome outcome;
	for (const double speed : {5., 10.})
	{
		BodyOnBar bar(method, steel, side, mass);
		bar.m_body->setLinearVelocity(btVector3(btScalar(speed), 0, 0));
		{
			Run run(bar.m_world, stepping, outcome);
			while (run.stepsUntil(0.25) > 0)
				run.step();
		}
		// Of u^n / (1 + u), by I_n = u^n / n - I_(n-1).
		const double u = std::pow(speed / reference, 0.2);
		double integral = std::log1p(u);
		for (int n = 1; n <= 9; ++n)
			integral = std::pow(u, n) / n - integral;
		outcome.quantities.push_back({format("plastic elongation from %.0f m/s [m]", speed),
									  bar.m_joint->getPlasticDeformation(BT_EP_AXIAL),
									  5 * mass * reference * reference / force * integral});
	}
	return outcome;
}

/// A rod that bears 0.4 of what it can and is heated by two degrees a second, by the factors of EN 1993-1-2: at 500 degrees 0.6 of the
/// stiffness are left, and at 629.2 degrees 0.4 of the strength, between 0.47 at 600 and 0.23 at 700.
Outcome rodInFire(const Method& method, const Stepping& stepping)
{
	const double side = 0.02, yield = 250e6, share = 0.4, force = share * side * side * yield, youngsModulus = 200e9;
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(yield));
	steel.m_youngsModulus = btScalar(youngsModulus);
	steel.m_ultimatePlasticStrain = 10;
	BodyOnBar rod(method, steel, side, 100);
	Outcome outcome;
	double atHalf = 0, until = 0;
	{
		Run run(rod.m_world, stepping, outcome);
		const double from = 400, perSecond = 2;
		double temperature = 20;
		while (until == 0 && run.stepsUntil(150) > 0)
		{
			temperature = std::max(20., from + perSecond * (run.time() + run.dt() - 1));
			run.step(
				[&]
				{
					rod.m_joint->setCapacity(rod.m_capacity.heated(btElasticPlasticHeat::steel(btScalar(temperature))));
					rod.m_body->applyCentralForce(btVector3(btScalar(force), 0, 0));
				});
			if (temperature <= 500)
				atHalf = rod.stretch();
			// Many times what it gives elastically.
			if (rod.stretch() > 0.02)
				until = temperature;
		}
	}
	outcome.quantities = {
		{"elongation at 500 degrees [m]", atHalf, share * yield / (0.6 * youngsModulus)},
		{"temperature at which it gives way [degrees Celsius]", until, 600 + 100 * (0.47 - share) / (0.47 - 0.23)}};
	return outcome;
}
}  // namespace

std::vector<Problem> problemsOfCurves()
{
	return {
		{"hardening-cycle", "a bar of steel that hardens kinematically, pulled and pressed",
		 "stress over plastic strain in closed form", hardeningCycle, true},
		{"crack-opening", "a bar of concrete that a body tears", "fracture energy times area", crackOpening, true},
		{"rate-stops-body", "a body stopped by a bar of mild steel that is stronger the faster it flows",
		 "the law of Cowper and Symonds, integrated", rateStopsBody, true},
		{"rod-in-fire", "a rod under load that is heated until it gives way", "factors of EN 1993-1-2, table 3.1",
		 rodInFire, true},
	};
}
}  // namespace ep
