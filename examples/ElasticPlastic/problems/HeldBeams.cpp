// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "problems/HeldBeams.h"

#include <cmath>

#include "problems/Run.h"
#include "scenes/StruckBeam.h"
#include "text/Format.h"
#include "world/Place.h"

namespace ep
{
namespace
{
const double BEAM_YIELD = 250e6;

/// So stiff that next to nothing is elastic, as theory has it.
btElasticPlasticMaterial stiffSteel(double factor)
{
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(BEAM_YIELD));
	steel.m_youngsModulus *= btScalar(factor);
	steel.m_ultimatePlasticStrain = btScalar(1e6);
	steel.m_dampingRatio = 0;
	return steel;
}

/// Haythornthwaite's beam (1957): rigid and perfectly plastic, 1 m between two supports that hold its ends in all directions, with a body in the middle. First it
/// bends; as it sags it comes under tension, which takes of the moments, and in the end it hangs as a cable.
namespace held
{
const double SIDE = 0.02, LENGTH = 1;

/// Two halves that weigh next to nothing.
StruckBeam::Settings settings(const Method& method, double mass, double speed)
{
	StruckBeam::Settings s;
	s.method = method;
	s.halfParts = 1;
	s.length = LENGTH;
	s.height = s.width = SIDE;
	s.density = 50;
	s.mass = mass;
	s.speed = speed;
	const btElasticPlasticMaterial steel = stiffSteel(1000);
	const btElasticPlasticSection section =
		btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE)).withFibres(method.fibres);
	s.capacity = [=](btScalar lengthA, btScalar lengthB)
	{ return btElasticPlasticCapacity::fromMember(steel, section, lengthA, lengthB); };
	return s;
}

/// At which it begins to flow: 8 Mp / L [N].
double load() { return 8 * BEAM_YIELD * SIDE * SIDE * SIDE / 4 / LENGTH; }

/// What it has taken up when it sags by w: the load for that is Pc (1 + (w / h)^2) until w is the height h, and 2 Pc w / h from then on [J].
double energyAt(double sag)
{
	const double w = sag / SIDE;
	return load() * SIDE * (w < 1 ? w + w * w * w / 3 : 1. / 3 + w * w);
}

/// The way back [m].
double sagAfter(double energy)
{
	double low = 0, high = 10 * SIDE;
	for (int i = 0; i < 100; ++i)
	{
		const double middle = (low + high) / 2;
		(energyAt(middle) < energy ? low : high) = middle;
	}
	return low;
}
}  // namespace held

/// Pushed by a body that it hardly slows down: what it has taken up when it sags by a half, one, two and four times its height.
Outcome pushedBeam(const Method& method, const Stepping& stepping)
{
	const double mass = 1e5, speed = 0.25;
	StruckBeam beam(held::settings(method, mass, speed));
	Outcome outcome;
	Run run(beam.m_world, stepping, outcome);
	for (const double heights : {0.5, 1., 2., 4.})
	{
		while (run.stepsUntil(1) > 0 && beam.sag() < heights * held::SIDE)
			run.step();
		const double left = beam.sagRate();
		outcome.quantities.push_back({format("energy taken up at a sag of %.1f heights [J]", heights),
									  mass * (speed * speed - left * left) / 2, held::energyAt(beam.sag())});
	}
	return outcome;
}

/// The largest value of what goes from x0 to x1 in a time, by its rates at both ends: of the cubic that has all four.
double mostOnTheWay(double x0, double v0, double x1, double v1, double dt)
{
	// The rate is v0 + b t + c t^2, t from 0 to 1.
	const double b = 6 * (x1 - x0) / dt - 4 * v0 - 2 * v1, c = 3 * (v0 + v1) - 6 * (x1 - x0) / dt;
	if (!(v0 > 0 && v1 < 0))
		return std::max(x0, x1);
	// The root at which it falls.
	const double t = 2 * v0 / (std::sqrt(std::max(b * b - 4 * c * v0, 0.)) - b);
	return x0 + dt * t * (v0 + t * (b / 2 + t * c / 3));
}

/// It lasts for a step or two of a game.
double largestSag(StruckBeam& beam, const Stepping& stepping, Outcome& outcome)
{
	double most = 0;
	Run run(beam.m_world, stepping, outcome);
	while (run.stepsUntil(0.25) > 0)
	{
		const double before = beam.sag(), rateBefore = beam.sagRate();
		run.step();
		most = std::max(most, mostOnTheWay(before, rateBefore, beam.sag(), beam.sagRate(), run.dt()));
	}
	return most;
}

Outcome struckBeam(const Method& method, const Stepping& stepping)
{
	const double mass = 500;
	Outcome outcome;
	for (const double energy : {25., 100., 400., 900.})
	{
		StruckBeam beam(held::settings(method, mass, std::sqrt(2 * energy / mass)));
		double most = 0;
		{
			Run run(beam.m_world, stepping, outcome);
			while (run.stepsUntil(0.25) > 0)
			{
				run.step();
				most = std::max(most, beam.sag());
			}
		}
		outcome.quantities.push_back(
			{format("largest sag after a blow of %.0f J [m]", energy), most, held::sagAfter(energy)});
	}
	return outcome;
}

/// The same with elasticity and mass of their own. By explicit integration of ever more parts (tests/problems/testFibres.cpp): 9.999, 9.951, 9.929 and 9.917 mm with 20,
/// 40, 80 and 160 of them for the slowest one.
Outcome struckSteel(const Method& method, const Stepping& stepping)
{
	const struct
	{
		double m_speed, m_sag;
	} blows[] = {{1, 9.906e-3}, {2, 23.10e-3}, {4, 46.31e-3}};
	Outcome outcome;
	for (const auto& blow : blows)
	{
		const btElasticPlasticSection section =
			btElasticPlasticSection::rectangle(btScalar(0.02), btScalar(0.02)).withFibres(method.fibres);
		StruckBeam beam(StruckBeam::ofSteel(method, section, blow.m_speed));
		outcome.quantities.push_back({format("largest sag after a blow at %.0f m/s [m]", blow.m_speed),
									  largestSag(beam, stepping, outcome), blow.m_sag});
	}
	return outcome;
}

/// By another program of planar beams in as many parts, at 1/3840 s.
Outcome struckConcrete(const Method& method, const Stepping& stepping)
{
	Outcome outcome;
	for (const bool isHeld : {false, true})
	{
		const btElasticPlasticSection section =
			btElasticPlasticSection::rectangle(btScalar(0.3), btScalar(0.5)).withFibres(method.fibres);
		StruckBeam beam(StruckBeam::ofConcrete(method, section, isHeld, 1e-6));
		outcome.quantities.push_back(
			{isHeld ? "largest sag with ends that are held [m]" : "largest sag with an end that may move along [m]",
			 largestSag(beam, stepping, outcome), isHeld ? 0.0712 : 0.2038});
	}
	return outcome;
}

/// A body at one section, 0.1 m high, that bears 20 kN and 500 N m, flies along the axis and turns. Flow is along the normal of m + n^2 = 1.
Outcome flyingBody(const Method& method, const Stepping& stepping)
{
	const double height = 0.1, width = 0.8e-3, mass = 20e3, inertia = 483.334, speed = 0.04, spin = 0.4;
	World world(method, btVector3(0, 0, 0));
	btCollisionShape* const box = world.box(btVector3(1, 1, 1));
	// Smaller than the body around it: faces in one plane would flicker.
	const btScalar within = btScalar(0.9);
	btRigidBody* const ground = world.body(0, world.box(btVector3(within, within, within)), at(0), false);
	btRigidBody* const body = world.body(btScalar(mass), box, at(0), false);
	body->setMassProps(btScalar(mass), btVector3(btScalar(inertia), btScalar(inertia), btScalar(inertia)));
	body->updateInertiaTensor();
	const btElasticPlasticSection section =
		btElasticPlasticSection::rectangle(btScalar(width), btScalar(height)).withFibres(method.fibres);
	btElasticPlasticJoint* const joint =
		world.joint(*ground, *body, at(0), btElasticPlasticCapacity::fromMember(stiffSteel(1000), section, 1, 1));
	body->setLinearVelocity(btVector3(btScalar(speed), 0, 0));
	body->setAngularVelocity(btVector3(0, 0, btScalar(spin)));
	Outcome outcome;
	Run run(world, stepping, outcome);
	while (run.stepsUntil(1) > 0)
		run.step();
	// By integration of the rigid-plastic equations (tests/problems/testReferences.cpp).
	outcome.quantities = {{"plastic elongation [m]", double(joint->getPlasticDeformation(BT_EP_AXIAL)), 0.986894e-3},
						  {"plastic angle [rad]", double(joint->getPlasticDeformation(BT_EP_BENDING_Z)), 0.0893338}};
	return outcome;
}
}  // namespace

std::vector<Problem> problemsOfHeldBeams()
{
	const char* const cable = "Haythornthwaite's rigid-plastic beam";
	return {
		{"beam-held-pushed", "a beam held at both ends, pushed until it hangs as a cable", cable, pushedBeam, true},
		{"beam-held-struck", "a beam held at both ends, struck", cable, struckBeam, true},
		{"beam-of-steel-struck", "a slender beam of steel held at both ends, struck", "explicit integration in strips",
		 struckSteel, true},
		{"beam-of-concrete-struck", "a beam of reinforced concrete with ends that may move or are held, struck",
		 "explicit integration in strips", struckConcrete, true},
		{"body-flies-and-turns", "a body that one section stops along its axis and about it",
		 "rigid-plastic integration", flyingBody, true},
	};
}
}  // namespace ep
