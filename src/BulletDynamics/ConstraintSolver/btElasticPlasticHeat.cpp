// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticHeat.h"

#include "btElasticPlasticFault.h"

namespace
{
/// A point of a factor's curve.
struct HeatPoint
{
	double m_temperature, m_factor;
};

template <int N>
btScalar heatFactor(const HeatPoint (&points)[N], btScalar temperature)
{
	// What is no temperature leaves no number, and a capacity refuses that.
	if (!btElasticPlasticIsFinite(double(temperature)))
		return temperature;
	const double t = temperature;
	for (int i = 0; i < N; ++i)
		if (!(t >= points[i].m_temperature))
		{
			if (i == 0)
				break;
			const HeatPoint &before = points[i - 1], &next = points[i];
			const double share = (t - before.m_temperature) / (next.m_temperature - before.m_temperature);
			return btScalar(before.m_factor + share * (next.m_factor - before.m_factor));
		}
	return btScalar(t >= points[0].m_temperature ? points[N - 1].m_factor : points[0].m_factor);
}

template <int N, int M>
btElasticPlasticHeat heatOf(const HeatPoint (&strength)[N], const HeatPoint (&stiffness)[M], btScalar temperature)
{
	btElasticPlasticHeat heat;
	heat.m_strength = heatFactor(strength, temperature);
	heat.m_stiffness = heatFactor(stiffness, temperature);
	return heat;
}

const HeatPoint STEEL_STRENGTH[] = {{400, 1},    {500, 0.78},  {600, 0.47},  {700, 0.23}, {800, 0.11},
									{900, 0.06}, {1000, 0.04}, {1100, 0.02}, {1200, 0}};
const HeatPoint STEEL_STIFFNESS[] = {{100, 1},      {500, 0.6},    {600, 0.31},    {700, 0.13}, {800, 0.09},
									 {900, 0.0675}, {1000, 0.045}, {1100, 0.0225}, {1200, 0}};

const HeatPoint BARS_STIFFNESS[] = {{100, 1},    {500, 0.6},   {600, 0.31},  {700, 0.13}, {800, 0.09},
									{900, 0.07}, {1000, 0.04}, {1100, 0.02}, {1200, 0}};
const HeatPoint COLD_WORKED_STRENGTH[] = {{300, 1},    {400, 0.94}, {500, 0.67},  {600, 0.4},   {700, 0.12},
										  {800, 0.11}, {900, 0.08}, {1000, 0.05}, {1100, 0.03}, {1200, 0}};
const HeatPoint COLD_WORKED_STIFFNESS[] = {{100, 1},    {200, 0.87},  {300, 0.72},  {400, 0.56},
										   {500, 0.4},  {600, 0.24},  {700, 0.08},  {800, 0.06},
										   {900, 0.05}, {1000, 0.03}, {1100, 0.02}, {1200, 0}};

const HeatPoint SILICEOUS_STRENGTH[] = {{100, 1},   {200, 0.95}, {300, 0.85}, {400, 0.75},  {500, 0.6},   {600, 0.45},
										{700, 0.3}, {800, 0.15}, {900, 0.08}, {1000, 0.04}, {1100, 0.01}, {1200, 0}};
const HeatPoint CALCAREOUS_STRENGTH[] = {{100, 1},    {200, 0.97}, {300, 0.91}, {400, 0.85},  {500, 0.74},  {600, 0.6},
										 {700, 0.43}, {800, 0.27}, {900, 0.15}, {1000, 0.06}, {1100, 0.02}, {1200, 0}};
/// e_c1 over that at 20 degrees, 0.0025.
const HeatPoint CONCRETE_STRAIN[] = {{20, 1}, {100, 1.6}, {200, 2.2}, {300, 2.8}, {400, 4}, {500, 6}, {600, 10}};

const HeatPoint TIMBER_COMPRESSION[] = {{20, 1}, {100, 0.25}, {300, 0}};
const HeatPoint TIMBER_TENSION[] = {{20, 1}, {100, 0.65}, {300, 0}};
const HeatPoint TIMBER_STIFFNESS[] = {{20, 1}, {100, 0.35}, {300, 0}};

const HeatPoint ALUMINIUM_6061_STRENGTH[] = {{20, 1},     {100, 0.95}, {150, 0.91}, {200, 0.79},
											 {250, 0.55}, {300, 0.31}, {350, 0.1},  {550, 0}};
const HeatPoint ALUMINIUM_6082_STRENGTH[] = {{20, 1},     {100, 0.9}, {150, 0.79}, {200, 0.65},
											 {250, 0.38}, {300, 0.2}, {350, 0.11}, {550, 0}};
const HeatPoint ALUMINIUM_STIFFNESS[] = {{20, 1},     {50, 0.99},  {100, 0.97}, {150, 0.93}, {200, 0.86},
										 {250, 0.78}, {300, 0.68}, {350, 0.54}, {400, 0.4},  {550, 0}};
}  // namespace

btElasticPlasticHeat btElasticPlasticHeat::steel(btScalar temperature)
{
	return heatOf(STEEL_STRENGTH, STEEL_STIFFNESS, temperature);
}

btElasticPlasticHeat btElasticPlasticHeat::reinforcement(btScalar temperature, bool isColdWorked)
{
	// Of hot rolled bars strength is as of other steel.
	return isColdWorked ? heatOf(COLD_WORKED_STRENGTH, COLD_WORKED_STIFFNESS, temperature)
						: heatOf(STEEL_STRENGTH, BARS_STIFFNESS, temperature);
}

btElasticPlasticHeat btElasticPlasticHeat::concrete(btScalar temperature, bool isCalcareous)
{
	btElasticPlasticHeat heat;
	heat.m_strength =
		isCalcareous ? heatFactor(CALCAREOUS_STRENGTH, temperature) : heatFactor(SILICEOUS_STRENGTH, temperature);
	heat.m_stiffness = heat.m_strength / heatFactor(CONCRETE_STRAIN, temperature);
	return heat;
}

btElasticPlasticHeat btElasticPlasticHeat::timber(btScalar temperature)
{
	btElasticPlasticHeat heat = heatOf(TIMBER_COMPRESSION, TIMBER_STIFFNESS, temperature);
	if (heat.m_strength > 0)
		heat.m_tensileShare = heatFactor(TIMBER_TENSION, temperature) / heat.m_strength;
	return heat;
}

btElasticPlasticHeat btElasticPlasticHeat::aluminium6061(btScalar temperature)
{
	return heatOf(ALUMINIUM_6061_STRENGTH, ALUMINIUM_STIFFNESS, temperature);
}

btElasticPlasticHeat btElasticPlasticHeat::aluminium6082(btScalar temperature)
{
	return heatOf(ALUMINIUM_6082_STRENGTH, ALUMINIUM_STIFFNESS, temperature);
}
