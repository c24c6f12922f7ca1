// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "problems/Sections.h"

#include <cmath>

#include "problems/LimitLoad.h"
#include "text/Format.h"

namespace ep
{
namespace
{
const double PI = 3.14159265358979323846, YIELD = 250e6;

/// A load, put on in proportion, and what it is of.
struct Load
{
	std::string name;
	double force[BT_EP_DOF_COUNT];
};

Load load(const std::string& name, double axial, double momentY, double momentZ)
{
	return {name, {axial, 0, 0, 0, momentY, momentZ}};
}

// ---- what a section bears, by a neutral line across it: below it all is stretched, above it all is pressed

/// Part of a section between two heights.
struct Strip
{
	double low, high, width, tension, compression;
};

/// \param turned  whether the line is along y, and heights are along z
Load atNeutralLine(const std::vector<Strip>& strips, double line, bool turned = false)
{
	double axial = 0, moment = 0;
	for (const Strip& s : strips)
	{
		const double cut = std::min(std::max(line, s.low), s.high);
		axial += s.width * (s.tension * (cut - s.low) - s.compression * (s.high - cut));
		moment -=
			s.width * (s.tension * (cut * cut - s.low * s.low) - s.compression * (s.high * s.high - cut * cut)) / 2;
	}
	const std::string name = format("neutral line %s %.0f mm", turned ? "z =" : "y =", 1000 * line);
	// A turn about y stretches what is at positive z.
	return turned ? load(name, axial, -moment, 0) : load(name, axial, 0, moment);
}

/// Of a ring.
Load atNeutralLine(double radius, double inner, double line)
{
	double above = 0, first = 0;
	for (const double sign : {1., -1.})
	{
		const double r = sign > 0 ? radius : inner, cosine = r > 0 ? std::min(1., line / r) : 1.,
					 angle = std::acos(cosine);
		above += sign * r * r * (angle - std::sin(angle) * cosine);
		first += sign * 2 * std::pow(r * std::sin(angle), 3) / 3;
	}
	const double area = PI * (radius * radius - inner * inner);
	return load(format("neutral line y = %.0f mm", 1000 * line), YIELD * (area - 2 * above), 0, 2 * YIELD * first);
}

// ---- the library's

/// A body held by one section, in its middle.
struct HeldBody
{
	World m_world;
	btRigidBody* m_body;

	HeldBody(const Method& method, const btElasticPlasticCapacity& capacity) : m_world(method, btVector3(0, 0, 0))
	{
		const btTransform middle = btTransform::getIdentity();
		btCollisionShape* const cube = m_world.box(btVector3(1, 1, 1));
		// Smaller than the body around it: faces in one plane would flicker.
		const btScalar within = btScalar(0.9);
		btRigidBody* const support = m_world.body(0, m_world.box(btVector3(within, within, within)), middle, false);
		m_body = m_world.body(3000, cube, middle, false);
		m_world.joint(*support, *m_body, middle, capacity);
	}

	void load(const Load& load, double share)
	{
		btVector3 sum[2];
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			sum[dof / 3][dof % 3] = btScalar(share * load.force[dof]);
		m_body->applyCentralForce(sum[0]);
		m_body->applyTorque(sum[1]);
	}

	/// The larger of way and turn [m], [rad].
	double give() const
	{
		const btTransform& pose = m_body->getCenterOfMassTransform();
		return std::max(double(pose.getOrigin().length()), double(pose.getRotation().getAngleShortestPath()));
	}
};

/// The factor on each load that is exact at which the section flows.
/// \param outcome  what is known of other sections of the problem
Outcome strengthOf(const Method& method, const Stepping& stepping, const btElasticPlasticMaterial& material,
				   const btElasticPlasticSection& section, const std::vector<Load>& loads, Outcome outcome = {})
{
	// What stands gives by less than 2 mrad in a joint as short as that, and has long been flowing all over at the limit.
	const btScalar length = btScalar(0.05);
	const double limit = 0.02;
	const btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(material, section, length, length);
	for (const Load& load : loads)
	{
		const double factor = limitFactor(
			[&](double f)
			{
				HeldBody held(method, capacity);
				return stands(
					held, stepping, outcome, limit, [&](double share) { held.load(load, f * share); },
					[&] { return held.give(); });
			});
		outcome.quantities.push_back({load.name + ", load over the exact one", factor, 1});
	}
	return outcome;
}

/// As exact answers have it: so stiff that all of a section flows before it has turned much, a web beside its middle, too.
btElasticPlasticMaterial perfect(double youngsModulus, double yield)
{
	btElasticPlasticMaterial material;
	material.m_youngsModulus = btScalar(5 * youngsModulus);
	material.m_yieldStress = btScalar(yield);
	material.m_ultimatePlasticStrain = btScalar(1e6);
	material.m_dampingRatio = 0;
	material.m_shearYield = BT_EP_VON_MISES;
	return material;
}

btElasticPlasticMaterial steel() { return perfect(200e9, YIELD); }

const double WIDTH = 0.1, HEIGHT = 0.2, AXIAL = WIDTH * HEIGHT * YIELD, MOMENT_Z = AXIAL * HEIGHT / 4,
			 MOMENT_Y = AXIAL * WIDTH / 4;

btElasticPlasticSection rectangle(const Method& method)
{
	return btElasticPlasticSection::rectangle(btScalar(WIDTH), btScalar(HEIGHT)).withFibres(method.fibres);
}

Outcome rectangleBearing(const Method& method, const Stepping& stepping)
{
	std::vector<Load> loads;
	// m = 1 - n^2
	for (const double n : {0., 0.25, 0.5, 0.75})
		loads.push_back(load(format("N / Np = %.2f", n), n * AXIAL, 0, (1 - n * n) * MOMENT_Z));
	// With the neutral line along the diagonal, and parallel to it where it cuts a quarter off: 2/3, and 1 - sqrt(2)/3.
	loads.push_back(load("both moments", 0, MOMENT_Y * 2 / 3, MOMENT_Z * 2 / 3));
	const double both = 1 - std::sqrt(2.) / 3;
	loads.push_back(load("both moments and N / Np = 0.50", 0.5 * AXIAL, both * MOMENT_Y, both * MOMENT_Z));
	return strengthOf(method, stepping, steel(), rectangle(method), loads);
}

Outcome circleBearing(const Method& method, const Stepping& stepping)
{
	const double r = 0.1;
	std::vector<Load> loads;
	for (const double line : {0., 0.04, 0.08})
		loads.push_back(atNeutralLine(r, 0, line));
	return strengthOf(method, stepping, steel(), btElasticPlasticSection::circle(btScalar(r)).withFibres(method.fibres),
					  loads);
}

Outcome tubeBearing(const Method& method, const Stepping& stepping)
{
	const double r = 0.1, inner = 0.09;
	std::vector<Load> loads;
	for (const double line : {0.02, 0.06})
		loads.push_back(atNeutralLine(r, inner, line));
	return strengthOf(method, stepping, steel(),
					  btElasticPlasticSection::tube(btScalar(r), btScalar(inner)).withFibres(method.fibres), loads);
}

/// IPE 200 with sharp corners.
Outcome iSectionBearing(const Method& method, const Stepping& stepping)
{
	const double b = 0.1, h = 0.2, web = 0.0056, flange = 0.0085, inner = h / 2 - flange;
	const std::vector<Strip> upright = {{-h / 2, -inner, b, YIELD, YIELD},
										{-inner, inner, web, YIELD, YIELD},
										{inner, h / 2, b, YIELD, YIELD}},
							 turned = {{-b / 2, b / 2, 2 * flange, YIELD, YIELD},
									   {-web / 2, web / 2, 2 * inner, YIELD, YIELD}};
	std::vector<Load> loads;
	for (const double line : {0.04, 0.095})
		loads.push_back(atNeutralLine(upright, line));
	for (const double line : {0., 0.01})
		loads.push_back(atNeutralLine(turned, line, true));
	const auto s = [](double x) { return btScalar(x); };
	return strengthOf(method, stepping, steel(),
					  btElasticPlasticSection::iSection(s(b), s(h), s(web), s(flange)).withFibres(method.fibres),
					  loads);
}

/// Concrete of 30 MPa that cracks without a force, with bars of 500 MPa, two each at some heights.
Outcome concreteBearing(const Method& method, const Stepping& stepping, const std::vector<double>& heights, double bar,
						const std::vector<double>& lines)
{
	const double b = 0.3, h = 0.5, thin = 1e-3, concreteYield = 30e6, barYield = 500e6;
	btElasticPlasticMaterial concrete = perfect(30e9, concreteYield);
	concrete.m_tensileShare = 0;
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(b), btScalar(h));
	// Three per cent take more of concrete than of steel, as only a part of it bears.
	section = section.withFibres(method.fibres > 0 ? method.fibres : 36);
	std::vector<Strip> strips = {{-h / 2, h / 2, b, 0, concreteYield}};
	for (const double y : heights)
	{
		for (const double z : {-0.11, 0.11})
			section.addBar(btScalar(y), btScalar(z), btScalar(bar), perfect(200e9, barYield));
		strips.push_back({y - thin / 2, y + thin / 2, 2 * bar / thin, barYield, barYield});
	}
	std::vector<Load> loads;
	for (const double line : lines)
		loads.push_back(atNeutralLine(strips, line));
	return strengthOf(method, stepping, concrete, section, loads);
}

const double BAR = 314.16e-6;

Outcome columnBearing(const Method& method, const Stepping& stepping)
{
	return concreteBearing(method, stepping, {-0.21, 0.21}, BAR, {0.2, 0., -0.2});
}

/// The first one is pure bending, N = 0.
Outcome beamBearing(const Method& method, const Stepping& stepping)
{
	const double pressed = 4 * BAR * 500e6 / (0.3 * 30e6);
	return concreteBearing(method, stepping, {-0.21}, 2 * BAR, {0.25 - pressed, 0.07, -0.07});
}

/// Where all of a section is stressed alike, normal and shear force lie on a circle (von Mises), and so do normal force and torsion of a
/// thin tube. Bending with shear, in a section that stays plane and is sheared alike all over, at a slip of a half heights for each
/// radian: m = sqrt(1 + a^2) - a^2 asinh(1/a), v = a asinh(1/a).
Outcome shearBearing(const Method& method, const Stepping& stepping)
{
	const double shear = AXIAL / std::sqrt(3.);
	std::vector<Load> loads = {{"0.6 of the axial force and 0.8 of the shear", {0.6 * AXIAL, 0.8 * shear}}};
	for (const double a : {0.25, 1.})
	{
		const double v = a * std::asinh(1 / a), m = std::sqrt(1 + a * a) - a * v;
		Load both = load(format("V / Vp = %.2f and bending", v), 0, 0, m * MOMENT_Z);
		both.force[BT_EP_SHEAR_Y] = v * shear;
		loads.push_back(both);
	}
	const Outcome ofRectangle = strengthOf(method, stepping, steel(), rectangle(method), loads);
	const double r = 0.1, inner = 0.095, axial = PI * (r * r - inner * inner) * YIELD,
				 torsion = 2 * PI / 3 * (r * r * r - inner * inner * inner) * YIELD / std::sqrt(3.);
	loads = {{"0.6 of a tube's axial force and 0.8 of its torsion", {0.6 * axial, 0, 0, 0.8 * torsion}}};
	return strengthOf(method, stepping, steel(),
					  btElasticPlasticSection::tube(btScalar(r), btScalar(inner)).withFibres(method.fibres), loads,
					  ofRectangle);
}
}  // namespace

std::vector<Problem> problemsOfSections()
{
	const char* const line = "limit analysis: stresses on either side of a neutral line";
	return {
		{"section-rectangle", "axial force and bending about one axis and both", line, rectangleBearing, true},
		{"section-circle", "axial force and bending of a solid circle", line, circleBearing, true},
		{"section-tube", "axial force and bending of a tube", line, tubeBearing, true},
		{"section-i", "axial force and bending of an IPE 200 about either axis", line, iSectionBearing, true},
		{"section-concrete", "axial force and bending of reinforced concrete", line, columnBearing, true},
		{"section-concrete-beam", "the same with bars at the bottom alone", line, beamBearing, true},
		{"section-shear", "shear or torsion with axial force or bending",
		 "limit analysis by von Mises of sections that stay plane", shearBearing, true},
	};
}
}  // namespace ep
