// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_SETTINGS_H
#define EP_CHARPY_SETTINGS_H

#include "world/World.h"

namespace ep::charpy
{
enum class Geometry
{
	Paper,      ///< hammer 20 mm thick with an edge, box-shaped anvils, hinge in the specimen's middle plane
	Repeatable  ///< anvils relieved, striker a wedge (as in ISO 148-2), hinge in the ligament's middle
};

/// How the specimen holds together; rigid: it is one body.
const std::vector<Named<JointKind>>& joints();
const std::vector<Named<Geometry>>& geometries();

/// All of a Charpy impact test, SI units. As made: the repeatable one.
struct Settings
{
	// ---- what is tested
	double length = 0.055;         ///< of the specimen [m]
	double height = 0.01;          ///< of its section, along the blow [m]
	double width = 0.01;           ///< of its section, upright [m]
	double notch = 0.002;          ///< depth, on the side of the anvils [m]
	int pieces = 2;                ///< even: the notch is between the middle ones
	double density = 7800;         ///< [kg/m^3]
	double youngsModulus = 200e9;  ///< [Pa]
	double yieldStress = 400e6;    ///< [Pa]
	double maxRotation = 3;        ///< plastic rotation at which a joint breaks [rad]

	// ---- the machine
	Geometry geometry = Geometry::Repeatable;
	double gap = 0.04;           ///< between the anvils [m]
	double anvilWidth = 0.04;    ///< of each, along the specimen and along the blow [m]
	double hammerLength = 0.5;   ///< along the blow [m]
	double hammerHeight = 0.25;  ///< [m]
	double hammerMass = 19.5;    ///< [kg]
	double draft = 0.04;         ///< length over which the paper's hammer narrows to its edge [m]
	double arm = 1;              ///< from the hammer's axis of rotation straight down to the blow [m]
	double release = 1.91;       ///< angle from which the hammer falls; 1.91 gives a blow of 300 J [rad]
	double shift = 0;            ///< of the hammer and its axis, along the blow [m]
	double gravity = 9.81;       ///< [m/s^2]
	double friction = 0.1;       ///< coefficient of each pair in contact
	double restitution = 0.5;  ///< of the blow on a rigid specimen; whether others spring back is their joints' matter

	// ---- how it is modelled and computed
	JointKind way = kinds::Ep2;
	Solver solver = Solver::Direct;
	int iterations = 50;        ///< of the solver, where it iterates
	double step = 0.1e-3;       ///< in the impact [s]
	double swingStep = 5e-3;    ///< outside of it [s]
	double impactAngle = 0.05;  ///< of the hammer to each side, in which step holds [rad]
	double swingAngle = 0.2;    ///< of the hammer, beyond which swingStep holds; linear between the two [rad]
	double hingeStep = 0.0075;  ///< greatest rotation of the hinge in an internal substep [rad]; 0: no bound
	bool preciseContacts =
		true;  ///< thin margins, clipped faces, penetration goes without energy; false: Bullet's defaults
	double lengthsPerMetre = 50;  ///< Bullet's unit of length: its tolerances, and float, want bodies of size 1

	/// As in the paper: geometry, scheme, time stepping, and Bullet's defaults for all that it leaves open.
	static Settings paper();

	/// What is wrong and how to put it right, empty if nothing is.
	std::string fault() const;

	/// Half of the hammer's thickness. The paper's 20 mm leave no room for a bent specimen of 10 mm between anvils 40 mm
	/// apart, the repeatable one's 14 mm do.
	double hammerHalfThickness() const { return geometry == Geometry::Paper ? 0.01 : 0.007; }

	/// From the hinge to the specimen's face at the anvils [m].
	double hingeHeight() const { return geometry == Geometry::Paper ? height / 2 : notch + (height - notch) / 2; }

	/// M = f_y b h^2 / 4 of the ligament (paper, equation 12) [N m]
	double plasticMoment() const { return yieldStress * width * (height - notch) * (height - notch) / 4; }

	/// Bend at which the specimen fits between the anvils. With half length l, hinge at height c above the face on the
	/// anvils, and half of the bend, t, a half's outer corner is l cos t + c sin t from the middle; it passes when that is
	/// half of the gap g: t = acos(g / (2 sqrt(l^2 + c^2))) + atan(c / l). [rad]
	double passingAngle() const;

	/// What bending it that far takes if it has no elasticity: the paper's expected loss [J].
	double passingEnergy() const { return plasticMoment() * passingAngle(); }

	/// k = E I / l of the ligament, l the distance of the pieces' middles [N m/rad].
	double hingeStiffness() const
	{
		const double ligament = height - notch;
		return youngsModulus * width * ligament * ligament * ligament / 12 / (length / pieces);
	}

	/// The elastic part of the bend, M / k, springs back: M (passing angle - M / k). [J]
	double passingPlasticWork() const
	{
		return plasticMoment() * (passingAngle() - plasticMoment() / hingeStiffness());
	}
};

/// A number that can be set: an option of the command line.
struct Number
{
	const char* name;
	const char* help;  ///< with its unit
	double unit;       ///< of the option over SI
	double low, high;  ///< in the option's unit
	double Settings::*real;
	int Settings::*whole;  ///< one of the two, the other null

	Number(const char* n, const char* h, double u, double from, double to, double Settings::*field)
		: name(n), help(h), unit(u), low(from), high(to), real(field), whole(nullptr)
	{
	}
	Number(const char* n, const char* h, int from, int to, int Settings::*field)
		: name(n), help(h), unit(1), low(from), high(to), real(nullptr), whole(field)
	{
	}
	/// In the option's unit.
	double of(const Settings& s) const { return whole ? s.*whole : s.*real / unit; }
	void set(Settings& s, double value) const
	{
		if (whole)
			s.*whole = int(value);
		else
			s.*real = value * unit;
	}
};
const std::vector<Number>& numbers();
}  // namespace ep::charpy

#endif  // EP_CHARPY_SETTINGS_H
