// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "test/Settings.h"

#include <cmath>
#include <cstdio>

namespace ep::charpy
{
const std::vector<Named<JointKind>>& joints()
{
	// Without a joint there is nothing to test.
	static const std::vector<Named<JointKind>> ways(jointKinds().begin() + 1, jointKinds().end());
	return ways;
}

const std::vector<Named<Geometry>>& geometries()
{
	static const std::vector<Named<Geometry>> names = {{"paper", Geometry::Paper},
													   {"repeatable", Geometry::Repeatable}};
	return names;
}

Settings Settings::paper()
{
	Settings s;
	s.geometry = Geometry::Paper;
	s.way = kinds::Ep2Paper;
	s.solver = Solver::Stock;
	s.iterations = 10;
	s.friction = 0.25;  // Bullet's default of 0.5 on both bodies
	s.restitution = 0;
	s.hingeStep = 0;
	s.preciseContacts = false;
	s.lengthsPerMetre = 1;
	return s;
}

double Settings::passingAngle() const
{
	const double l = length / 2, c = hingeHeight();
	return 2 * (std::acos(gap / 2 / std::hypot(l, c)) + std::atan(c / l));
}

const std::vector<Number>& numbers()
{
	using S = Settings;
	static const std::vector<Number> numbers = {
		{"dt", "Time step in the impact [ms]", 1e-3, 1e-4, 5, &S::step},
		{"hinge-step", "Greatest rotation of the hinge in an internal substep, 0: no bound [rad]", 1, 0, 1,
		 &S::hingeStep},
		{"iterations", "Of the solver, where it iterates", 1, 100000, &S::iterations},
		{"friction", "Coefficient of friction of all contacts", 1, 0, 2, &S::friction},
		{"restitution", "Of the blow on a rigid specimen", 1, 0, 1, &S::restitution},
		{"yield", "Yield stress [MPa]", 1e6, 1, 1e5, &S::yieldStress},
		{"max-rotation", "Plastic rotation at which a joint breaks [rad]", 1, 1e-6, 100, &S::maxRotation},
		{"notch", "Depth of the notch [mm]", 1e-3, 0, 90, &S::notch},
		{"width", "Of the specimen's section, upright [mm]", 1e-3, 1, 100, &S::width},
		{"height", "Of the specimen's section, along the blow [mm]", 1e-3, 1, 100, &S::height},
		{"length", "Of the specimen [mm]", 1e-3, 1, 1000, &S::length},
		{"pieces", "Of the specimen, an even number", 2, 64, &S::pieces},
		{"density", "Of the specimen [kg/m^3]", 1, 1, 1e5, &S::density},
		{"youngs-modulus", "Of the specimen [GPa]", 1e9, 1e-3, 1e4, &S::youngsModulus},
		{"release", "Angle from which the hammer falls [rad]", 1, 0.02, 2.8, &S::release},
		{"hammer-mass", "Mass of the hammer [kg]", 1, 1e-2, 1e5, &S::hammerMass},
		{"hammer-length", "Of the hammer, along the blow [m]", 1, 0.05, 10, &S::hammerLength},
		{"hammer-height", "Of the hammer, upright [m]", 1, 0.02, 10, &S::hammerHeight},
		{"draft", "Length over which the paper's hammer narrows to its edge [mm]", 1e-3, 1, 9000, &S::draft},
		{"arm", "From the hammer's axis down to the blow [m]", 1, 0.25, 10, &S::arm},
		{"shift", "Of the hammer along the blow [um]", 1e-6, -2000, 2000, &S::shift},
		{"gap", "Between the anvils [mm]", 1e-3, 1, 1000, &S::gap},
		{"anvil-width", "Of each, along the specimen and along the blow [mm]", 1e-3, 5, 1000, &S::anvilWidth},
		{"gravity", "Acceleration of gravity [m/s^2]", 1, 0.1, 1000, &S::gravity},
		{"swing-dt", "Time step outside of the impact [ms]", 1e-3, 1e-4, 20, &S::swingStep},
		{"impact-angle", "Of the hammer, below which dt holds [rad]", 1, 0.01, 0.5, &S::impactAngle},
		{"swing-angle", "Of the hammer, beyond which swing-dt holds [rad]", 1, 0.01, 2, &S::swingAngle},
		{"lengths-per-metre", "Bullet's units of length in a metre", 1, 1, 1e4, &S::lengthsPerMetre},
	};
	return numbers;
}

std::string Settings::fault() const
{
	std::string found;
	const auto check = [this, &found](const Number& n, double low, double high, const char* why = "")
	{
		const double value = n.of(*this), slack = 1e-9 * (std::fabs(low) + std::fabs(high));  // of changing units
		if (!found.empty() || (value >= low - slack && value <= high + slack))
			return;
		char text[256];
		std::snprintf(text, sizeof text, "--%s is %g; it must be a number from %g to %g%s (%s)", n.name, value, low,
					  high, why, n.help);
		found = text;
	};
	for (const Number& n : numbers())
		check(n, n.low, n.high);

	// Its centre of mass is not straight below the axis when it strikes; upside down it would fall the other way.
	const double highest = M_PI - std::atan(hammerLength / 2 / arm) - 0.05;
	// What depends on others, bounds in SI units.
	const struct
	{
		double Settings::*field;
		double low, high;
		const char* why;
	} bounds[] = {
		{&Settings::notch, 0, 0.9 * height, ", 0.9 of --height"},
		{&Settings::gap, 2 * hammerHalfThickness(), 0.98 * length, ", from the hammer's thickness to 0.98 of --length"},
		{&Settings::draft, 1e-3, 0.9 * hammerLength, ", 0.9 of --hammer-length"},
		{&Settings::release, swingAngle, btMin(highest, 2.8), ", from --swing-angle to the hammer upside down"},
		{&Settings::swingStep, step, 0.02, ", not below --dt"},
		{&Settings::swingAngle, impactAngle, 2, ", not below --impact-angle"},
		{&Settings::hingeStep, hingeStep > 0 ? 1e-4 : 0, 1, ""}};
	for (const auto& b : bounds)
		for (const Number& n : numbers())
			if (n.real == b.field)
				check(n, b.low / n.unit, b.high / n.unit, b.why);
	if (found.empty() && pieces % 2 != 0)
		found = "--pieces is " + std::to_string(pieces) + "; it must be even: the notch is between the middle ones";
	if (found.empty() && passingAngle() >= M_PI)
		found =
			"the specimen does not fit between the anvils, however it bends: a lower --height or a wider --gap helps";
	return found;
}
}  // namespace ep::charpy
