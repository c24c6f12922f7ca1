// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "CellStrength.h"

#include <math.h>

#include "Convex.h"
#include "LinearMath/btMinMax.h"

namespace btElasticPlastic
{
namespace
{
/// What stretches a cell by 1 for each force: 1, z, -y.
double armOf(const Cell& cell, int force)
{
	return force == AXIAL_FORCE ? 1 : force == MOMENT_Y ? cell.m_z : -cell.m_y;
}

/// With what a cell bears a stretch, stretched by it or pressed. Of what is neither, any force between counts; of a section that is symmetric the middle of them leaves nothing.
double boundOf(const Cell& cell, double stretch)
{
	return stretch > 0 ? cell.m_tension : stretch < 0 ? -cell.m_compression : (cell.m_tension - cell.m_compression) / 2;
}

/// In one direction of the force.
double strengthInDirection(const std::vector<Cell>& cells, int force, double sign)
{
	const int others[2] = {(force + 1) % 3, (force + 2) % 3};
	double size[3] = {}, slope[2] = {}, alone = 0, reach[2] = {};
	for (const Cell& cell : cells)
	{
		const double stretch = sign * armOf(cell, force), bound = boundOf(cell, stretch);
		alone += bound * stretch;
		for (int k = 0; k < 2; ++k)
			slope[k] += bound * armOf(cell, others[k]);
		for (int k = 0; k < 3; ++k)
			size[k] = btMax(size[k], fabs(armOf(cell, k)));
	}
	if (!(alone > 0) || !(size[force] > 0))
		return 0;
	// Of what is symmetric nothing is gained by the others.
	bool isLeast = true;
	for (int k = 0; k < 2; ++k)
	{
		isLeast &= fabs(slope[k]) * size[force] <= 1e-6 * alone * size[others[k]];
		reach[k] = size[others[k]] > 0 ? 8 * size[force] / size[others[k]] : 0;
	}
	if (isLeast)
		return alone;
	const auto support = [&](double first, double second)
	{
		double sum = 0;
		for (const Cell& cell : cells)
		{
			const double stretch =
				sign * armOf(cell, force) + first * armOf(cell, others[0]) + second * armOf(cell, others[1]);
			sum += stretch * boundOf(cell, stretch);
		}
		return sum;
	};
	return leastOf([&](double first)
				   { return leastOf([&](double second) { return support(first, second); }, reach[1]); },
				   reach[0]);
}
}  // namespace

double strengthAlone(const std::vector<Cell>& cells, SectionForce force)
{
	return btMax(strengthInDirection(cells, force, 1), strengthInDirection(cells, force, -1));
}
}  // namespace btElasticPlastic
