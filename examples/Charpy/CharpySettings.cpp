#include "CharpySettings.h"

#include <cmath>
#include <cstdio>

namespace ep
{
const std::vector<Named<JointKind>>& charpyWays()
{
	// Without a joint there is nothing to test.
	static const std::vector<Named<JointKind>> ways(jointKinds().begin() + 1, jointKinds().end());
	return ways;
}

const std::vector<Named<CharpyGeometry>>& charpyGeometries()
{
	static const std::vector<Named<CharpyGeometry>> names = {{"paper", CharpyGeometry::Paper},
															 {"repeatable", CharpyGeometry::Repeatable}};
	return names;
}

CharpySettings CharpySettings::paper()
{
	CharpySettings s;
	s.geometry = CharpyGeometry::Paper;
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

double CharpySettings::passingAngle() const
{
	const double l = length / 2, c = hingeHeight();
	return 2 * (std::acos(gap / 2 / std::hypot(l, c)) + std::atan(c / l));
}

namespace
{
struct Range
{
	const char* quantity;
	double value, low, high;
};

std::string outOfRange(const Range& r)
{
	char text[256];
	std::snprintf(text, sizeof text, "%s is %g; it must be a number from %g to %g", r.quantity, r.value, r.low, r.high);
	return text;
}
}  // namespace

std::string CharpySettings::fault() const
{
	const Range ranges[] = {
		{"length of the specimen [m]", length, 1e-3, 1},
		{"height of its section [m]", height, 1e-3, 0.1},
		{"width of its section [m]", width, 1e-3, 0.1},
		{"depth of the notch [m]", notch, 0, 0.9 * height},
		{"number of pieces", double(pieces), 2, 64},
		{"density [kg/m^3]", density, 1, 1e5},
		{"Young's modulus [Pa]", youngsModulus, 1e6, 1e13},
		{"yield stress [Pa]", yieldStress, 1e5, 1e11},
		{"maximum rotation [rad]", maxRotation, 1e-6, 100},
		{"gap between the anvils [m]", gap, 1e-3, 0.98 * length},
		{"width of an anvil [m]", anvilWidth, 5e-3, 1},
		{"length of the hammer [m]", hammerLength, 0.05, 10},
		{"height of the hammer [m]", hammerHeight, 0.02, 10},
		{"mass of the hammer [kg]", hammerMass, 1e-2, 1e5},
		{"draft of the hammer [m]", draft, 1e-3, 0.9 * hammerLength},
		{"arm of the hammer [m]", arm, 0.25, 10},
		{"angle of release [rad]", release, swingAngle, 2.8},
		{"shift of the hammer [m]", shift, -2e-3, 2e-3},
		{"gravity [m/s^2]", gravity, 0.1, 1000},
		{"friction", friction, 0, 2},
		{"restitution", restitution, 0, 1},
		{"iterations", double(iterations), 1, 1e6},
		{"time step in the impact [s]", step, 1e-7, 5e-3},
		{"time step of the swing [s]", swingStep, step, 0.02},
		{"impact angle [rad]", impactAngle, 0.01, 0.5},
		{"swing angle [rad]", swingAngle, impactAngle, 2},
		{"rotation of the hinge in a substep [rad]", hingeStep, 0, 1},
		{"lengths per metre", lengthsPerMetre, 1, 1e4},
	};
	for (const Range& r : ranges)
		if (!(r.value >= r.low && r.value <= r.high))
			return outOfRange(r);
	if (hingeStep > 0 && hingeStep < 1e-4)
		return outOfRange({"rotation of the hinge in a substep [rad] (0: no bound)", hingeStep, 1e-4, 1});
	if (pieces % 2 != 0)
		return "number of pieces (--pieces) is " + std::to_string(pieces) +
			   "; it must be even: the notch is between the middle ones";
	return std::string();
}
}  // namespace ep
