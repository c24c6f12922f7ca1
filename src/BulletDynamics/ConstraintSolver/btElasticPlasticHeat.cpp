// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticHeat.h"

namespace
{
/// A line of EN 1993-1-2, table 3.1.
struct HeatFactors
{
	double m_temperature, m_strength, m_stiffness;
};
const HeatFactors STEEL_FACTORS[] = {{20, 1, 1},        {100, 1, 1},         {200, 1, 0.9},       {300, 1, 0.8},
									 {400, 1, 0.7},     {500, 0.78, 0.6},    {600, 0.47, 0.31},   {700, 0.23, 0.13},
									 {800, 0.11, 0.09}, {900, 0.06, 0.0675}, {1000, 0.04, 0.045}, {1100, 0.02, 0.0225},
									 {1200, 0, 0}};
const int STEEL_COUNT = int(sizeof STEEL_FACTORS / sizeof STEEL_FACTORS[0]);
}  // namespace

btElasticPlasticHeat btElasticPlasticHeat::steel(btScalar temperature)
{
	btElasticPlasticHeat heat;
	const double t = temperature;
	if (t >= STEEL_FACTORS[STEEL_COUNT - 1].m_temperature)
		heat.m_strength = heat.m_stiffness = 0;
	for (int i = 1; i < STEEL_COUNT; ++i)
	{
		const HeatFactors &before = STEEL_FACTORS[i - 1], &next = STEEL_FACTORS[i];
		if (!(t >= before.m_temperature && t < next.m_temperature))
			continue;
		const double share = (t - before.m_temperature) / (next.m_temperature - before.m_temperature);
		heat.m_strength = btScalar(before.m_strength + share * (next.m_strength - before.m_strength));
		heat.m_stiffness = btScalar(before.m_stiffness + share * (next.m_stiffness - before.m_stiffness));
	}
	return heat;
}
