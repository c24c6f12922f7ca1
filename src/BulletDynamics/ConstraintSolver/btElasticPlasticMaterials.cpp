// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticMaterials.h"

#include <string.h>

namespace
{
enum RateKind
{
	NO_RATE,
	MILD,
	HIGH_TENSILE,
	ALLOY,
	PRESSED  ///< concrete
};

/// One line of the table, in the units in which standards print it.
struct Line
{
	const char* m_name;
	const char* m_source;
	double m_youngs;  ///< [GPa]
	double m_poisson;
	double m_density;         ///< [kg/m^3]
	double m_strength;        ///< in compression [MPa]
	double m_tension;         ///< [MPa]
	double m_ultimateStrain;  ///< plastic, in tension
	double m_crushingStrain;  ///< plastic; 0: the same
	double m_damping;         ///< [%] of critical
	RateKind m_rate = NO_RATE;
	double m_shear = 0;         ///< strength [MPa], 0: by von Mises
	double m_shearModulus = 0;  ///< [GPa], 0: isotropic
	double m_friction = 0;
};

const char* const STEEL = "EN 1993-1-1, 3.2.6 and table 3.1; least elongation by EN 10025-2, table 7";
const char* const FINE_STEEL = "EN 1993-1-1, 3.2.6 and table 3.1; least elongation by EN 10025-3";
const char* const BOLTS = "EN 1993-1-8, table 3.1: f_yb; least elongation by EN ISO 898-1";
const char* const BARS = "EN 1992-1-1, 3.2.7 and table C.1";
const char* const CONCRETE =
	"EN 1992-1-1, table 3.1 and 3.1.3; no tension as in 6.1; shear without pressure 12.6.3: f_ctk,0.05";
const char* const ALUMINIUM = "EN 1999-1-1, 3.2.5 and table 3.2b, extruded, 6082 of more than 5 mm";
const char* const TIMBER = "EN 338:2009, C24";
const char* const TIMBER_ACROSS =
	"EN 338:2009, C24; shear that rolls fibres by EN 1995-1-1, 6.1.7: twice the tension; its "
	"modulus a tenth of that along";

/// Crushed at a strain of 0.35 %, of which the plastic part is given.
double crushing(double strength, double youngs) { return 0.0035 - strength / (1000 * youngs); }

const Line TABLE[] = {
	{"S235", STEEL, 210, 0.3, 7850, 235, 235, 0.26, 0, 1, MILD},
	{"S275", STEEL, 210, 0.3, 7850, 275, 275, 0.23, 0, 1, MILD},
	{"S355", STEEL, 210, 0.3, 7850, 355, 355, 0.22, 0, 1, HIGH_TENSILE},
	{"S420", FINE_STEEL, 210, 0.3, 7850, 420, 420, 0.19, 0, 1, HIGH_TENSILE},
	{"S460", FINE_STEEL, 210, 0.3, 7850, 460, 460, 0.17, 0, 1, HIGH_TENSILE},
	{"A992", "ASTM A992: 50 ksi, 18 % in 8 in; AISC 360 for the modulus", 200, 0.3, 7850, 345, 345, 0.18, 0, 1,
	 HIGH_TENSILE},
	{"bolt 4.6", BOLTS, 210, 0.3, 7850, 240, 240, 0.22, 0, 1, HIGH_TENSILE},
	{"bolt 8.8", BOLTS, 210, 0.3, 7850, 640, 640, 0.12, 0, 1, HIGH_TENSILE},
	{"bolt 10.9", BOLTS, 210, 0.3, 7850, 900, 900, 0.09, 0, 1, HIGH_TENSILE},
	{"B500A", BARS, 200, 0.3, 7850, 500, 500, 0.025, 0, 1, HIGH_TENSILE},
	{"B500B", BARS, 200, 0.3, 7850, 500, 500, 0.05, 0, 1, HIGH_TENSILE},
	{"B500C", BARS, 200, 0.3, 7850, 500, 500, 0.075, 0, 1, HIGH_TENSILE},
	{"C20/25", CONCRETE, 30, 0.2, 2400, 20, 0, 0.0035, crushing(20, 30), 3, PRESSED, 1.5},
	{"C25/30", CONCRETE, 31, 0.2, 2400, 25, 0, 0.0035, crushing(25, 31), 3, PRESSED, 1.8},
	{"C30/37", CONCRETE, 33, 0.2, 2400, 30, 0, 0.0035, crushing(30, 33), 3, PRESSED, 2},
	{"C35/45", CONCRETE, 34, 0.2, 2400, 35, 0, 0.0035, crushing(35, 34), 3, PRESSED, 2.2},
	{"C40/50", CONCRETE, 35, 0.2, 2400, 40, 0, 0.0035, crushing(40, 35), 3, PRESSED, 2.5},
	{"C45/55", CONCRETE, 36, 0.2, 2400, 45, 0, 0.0035, crushing(45, 36), 3, PRESSED, 2.7},
	{"C50/60", CONCRETE, 37, 0.2, 2400, 50, 0, 0.0035, crushing(50, 37), 3, PRESSED, 2.9},
	{"6061-T6", ALUMINIUM, 70, 0.3, 2700, 240, 240, 0.08, 0, 1, ALLOY},
	{"6082-T6", ALUMINIUM, 70, 0.3, 2700, 260, 260, 0.1, 0, 1, ALLOY},
	{"GJL-250", "EN 1561, annex A: typical values of EN-GJL-250", 110, 0.26, 7200, 840, 250, 0.003, 0.1, 1, NO_RATE,
	 290},
	{"C24 along", TIMBER, 11, 0.3, 420, 21, 14, 0.001, 0.01, 4, NO_RATE, 4, 0.69},
	{"C24 across", TIMBER_ACROSS, 0.37, 0.3, 420, 2.5, 0.4, 0.001, 0.05, 4, NO_RATE, 0.8, 0.069},
	{"clay brick",
	 "EN 1996-1-1, 3.6 to 3.8: f_k = 5 MPa, E = 1000 f_k, G = 0.4 E, bond 0.1 MPa across bed joints; shear 3.6.2: 0.2 "
	 "MPa and 0.4 of the pressure",
	 5, 0.2, 1800, 5, 0.1, 1e-4, crushing(5, 5), 5, NO_RATE, 0.2, 2, 0.4},
	{"float glass", "EN 572-1: modulus, density, 45 MPa in bending", 70, 0.2, 2500, 45, 45, 1e-5, 0, 1},
	{"toughened glass", "EN 572-1; EN 12150-1: 120 MPa in bending", 70, 0.2, 2500, 120, 120, 1e-5, 0, 1},
};
const int COUNT = int(sizeof TABLE / sizeof TABLE[0]);

btElasticPlasticMaterial materialOf(const Line& line)
{
	btElasticPlasticMaterial m;
	m.m_youngsModulus = btScalar(line.m_youngs * 1e9);
	m.m_poissonsRatio = btScalar(line.m_poisson);
	m.m_density = btScalar(line.m_density);
	m.m_yieldStress = btScalar(line.m_strength * 1e6);
	m.m_tensileShare = btScalar(line.m_tension / line.m_strength);
	m.m_ultimatePlasticStrain = btScalar(line.m_ultimateStrain);
	m.m_crushingStrain = btScalar(line.m_crushingStrain);
	m.m_shearYield = BT_EP_VON_MISES;
	m.m_dampingRatio = btScalar(line.m_damping / 100);
	m.m_shearStrength = btScalar(line.m_shear * 1e6);
	m.m_shearModulus = btScalar(line.m_shearModulus * 1e9);
	m.m_friction = btScalar(line.m_friction);
	return m;
}

btElasticPlasticRate rateOf(RateKind kind)
{
	switch (kind)
	{
		case MILD:
			return btElasticPlasticRate::mildSteel();
		case HIGH_TENSILE:
			return btElasticPlasticRate::highTensileSteel();
		case ALLOY:
			return btElasticPlasticRate::aluminium();
		case PRESSED:
			return btElasticPlasticRate::concrete();
		case NO_RATE:
			break;
	}
	return btElasticPlasticRate();
}
}  // namespace

int btElasticPlasticReadyMaterial::count() { return COUNT; }

btElasticPlasticReadyMaterial btElasticPlasticReadyMaterial::at(int index)
{
	const Line& line = TABLE[index >= 0 && index < COUNT ? index : 0];
	return {line.m_name, line.m_source, materialOf(line), rateOf(line.m_rate)};
}

btElasticPlasticMaterial btElasticPlasticReadyMaterial::find(const char* name)
{
	for (const Line& line : TABLE)
		if (name && strcmp(name, line.m_name) == 0)
			return materialOf(line);
	btElasticPlasticMaterial none;
	none.m_density = 0;
	return none;
}
