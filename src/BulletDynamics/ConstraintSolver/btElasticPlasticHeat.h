// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_HEAT_H
#define BT_ELASTIC_PLASTIC_HEAT_H

#include "LinearMath/btScalar.h"

/// What heat leaves of a material's strength and stiffness, for btElasticPlasticCapacity::heated(). The functions take the temperature in degrees Celsius
/// and are linear between the temperatures of their standards' tables, 1 below the first one, and as the last one above it; what is not finite leaves no number, which heated() refuses. Compared with printed tables:
/// steel, reinforcement, the strength of concrete. Compared with another program's copy of the table: aluminium 6061 to 350 degrees, and the modulus of
/// aluminium. Not compared with anything: 6082 and timber.
struct btElasticPlasticHeat
{
	btScalar m_strength = 1;      ///< over that at 20 degrees, finite, >= 0
	btScalar m_stiffness = 1;     ///< the same; 0 of either: nothing is left
	btScalar m_tensileShare = 1;  ///< what is left in tension over m_strength, finite, >= 0; only fibres know it

	/// Carbon steel, EN 1993-1-2, table 3.1: effective yield strength, at 2 % of strain, and slope of the elastic range.
	static btElasticPlasticHeat steel(btScalar temperature);

	/// Reinforcement of class N, EN 1992-1-2, table 3.2a.
	static btElasticPlasticHeat reinforcement(btScalar temperature, bool isColdWorked = false);

	/// Concrete of normal weight, EN 1992-1-2, table 3.1: with siliceous or calcareous aggregates. The stiffness is that at the origin of the
	/// standard's curve, 3 f_c / 2 e_c1 over that at 20 degrees. Its strength in tension falls likewise: it is next to none.
	static btElasticPlasticHeat concrete(btScalar temperature, bool isCalcareous = false);

	/// Softwood along the grain, EN 1995-1-2, annex B: compression and its modulus, which is the lower one; in tension more of the strength is left.
	static btElasticPlasticHeat timber(btScalar temperature);

	/// Aluminium 6061-T6 and 6082-T6 for up to two hours, EN 1999-1-2, tables 1 and 2: 0.2 % proof strength and modulus.
	static btElasticPlasticHeat aluminium6061(btScalar temperature);
	static btElasticPlasticHeat aluminium6082(btScalar temperature);
};

#endif  // BT_ELASTIC_PLASTIC_HEAT_H
