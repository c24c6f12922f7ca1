// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_HEAT_H
#define BT_ELASTIC_PLASTIC_HEAT_H

#include "LinearMath/btScalar.h"

/// What heat leaves of a material's strength and stiffness, for btElasticPlasticCapacity::heated().
struct btElasticPlasticHeat
{
	btScalar m_strength = 1;   ///< over that at 20 degrees, finite, >= 0
	btScalar m_stiffness = 1;  ///< the same; 0 of both: nothing is left

	/// Carbon steel in a fire, EN 1993-1-2, table 3.1: effective yield strength and slope of the elastic range, linear between the table's
	/// temperatures; as at 20 degrees below and 1200 above. The strength is that at 2 % of strain. \param temperature  [degrees Celsius]
	static btElasticPlasticHeat steel(btScalar temperature);
};

#endif  // BT_ELASTIC_PLASTIC_HEAT_H
