// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "WallCorners.h"

#include <math.h>

namespace btElasticPlastic
{
namespace
{
/// How distinctly a cluster's pieces are sheared along something on average, from which on they are of walls, and how distinctly all of it is, over that, at most
/// where two of these meet: of walls at a right angle 0 with half of the cluster on each.
const double LEAST_DISTINCT = 0.8, MOST_ALIKE = 0.5;
/// Square of its radius of gyration about its centroid over its area, from which on it has legs: that over twice the thickness of walls, at a right angle, for
/// each of them. What is more compact is the corner itself, in which the way turns from the one wall to the other: 1/6 of a square.
const double LEAST_LEGS = 0.25;

/// The way in which a piece is sheared, at the angle a from y, as cos(2 a) and sin(2 a), times how distinct it is: 1 if it is a wall's, 0 if it is sheared
/// as easily in any direction.
Region::Point wayOf(const SectionPoint* points, const Slips* slips, double& area)
{
	Region::Point way = {0, 0};
	area = 0;
	for (int i = 0; i < POINTS_OF_A_PIECE; ++i)
	{
		const Region::Moments shear = shearProducts(slips[i]);
		const double sum = shear.m_yy + shear.m_zz;
		area += points[i].m_area;
		if (!(sum > 0))
			continue;
		way.m_y += points[i].m_area * (shear.m_yy - shear.m_zz) / sum;
		way.m_z += points[i].m_area * 2 * shear.m_yz / sum;
	}
	return {way.m_y / area, way.m_z / area};
}

void add(const Region::Point& p, double area, Region::Moments& sum)
{
	sum.m_area += area;
	sum.m_y += area * p.m_y;
	sum.m_z += area * p.m_z;
	sum.m_yy += area * p.m_y * p.m_y;
	sum.m_yz += area * p.m_y * p.m_z;
	sum.m_zz += area * p.m_z * p.m_z;
}

/// What a cluster's pieces are.
struct Pieces
{
	Region::Moments m_places, m_ways;
	double m_distinct = 0;

	bool areOfACorner() const
	{
		if (!(m_places.m_area > 0))
			return false;
		const Region::Moments own = m_places.centred();
		return m_distinct > LEAST_DISTINCT * own.m_area && hypot(m_ways.m_y, m_ways.m_z) < MOST_ALIKE * m_distinct &&
			   own.m_yy + own.m_zz > LEAST_LEGS * own.m_area * own.m_area;
	}
};
}  // namespace

size_t partAtCorners(const std::vector<SectionPoint>& points, const std::vector<Slips>& slips, size_t numClusters,
					 std::vector<size_t>& owners)
{
	std::vector<Region::Point> ways;
	std::vector<Pieces> all(numClusters);
	for (size_t i = 0; i < owners.size(); ++i)
	{
		double area;
		const size_t first = i * POINTS_OF_A_PIECE;
		ways.push_back(wayOf(&points[first], &slips[first], area));
		Pieces& own = all[owners[i]];
		add(ways[i], area, own.m_ways);
		own.m_distinct += area * hypot(ways[i].m_y, ways[i].m_z);
		for (size_t k = first; k < first + POINTS_OF_A_PIECE; ++k)
			add({points[k].m_y, points[k].m_z}, points[k].m_area, own.m_places);
	}
	const size_t before = numClusters;
	for (size_t c = 0; c < before; ++c)
	{
		if (!all[c].areOfACorner())
			continue;
		const Region::Moments& m = all[c].m_ways;
		const PrincipalMoments apart = principalMoments(m.centred());
		for (size_t i = 0; i < owners.size(); ++i)
			if (owners[i] == c && apart.m_axis[0] * (ways[i].m_y - m.m_y / m.m_area) +
										  apart.m_axis[1] * (ways[i].m_z - m.m_z / m.m_area) >
									  0)
				owners[i] = numClusters;
		++numClusters;
	}
	return numClusters;
}
}  // namespace btElasticPlastic
