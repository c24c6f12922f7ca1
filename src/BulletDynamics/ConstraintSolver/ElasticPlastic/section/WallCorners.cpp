// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "WallCorners.h"

#include <math.h>

namespace btElasticPlastic
{
namespace
{
/// How distinctly a cluster's pieces are sheared along something on average, from which on they are of walls, and how distinctly all of it is, over that, at most
/// where two of these meet. Of walls at a right angle it is 0 with half of the cluster on each, and 0.64 where it has just the corner, in which the way turns from
/// the one to the other.
const double LEAST_DISTINCT = 0.8, MOST_ALIKE = 0.5;

/// The way in which a piece is sheared, at the angle a from y, as cos(2 a) and sin(2 a), times how distinct it is: 1 if it is a wall's, 0 if it is sheared
/// as easily in any direction.
Region::Point wayOf(const SectionPoint* points, const Slips* slips, double& area)
{
	Region::Point way = {0, 0};
	area = 0;
	for (int i = 0; i < POINTS_OF_A_PIECE; ++i)
	{
		const Region::Point &a = slips[i].m_alongY, &b = slips[i].m_alongZ;
		const double yy = a.m_y * a.m_y + b.m_y * b.m_y, zz = a.m_z * a.m_z + b.m_z * b.m_z,
					 yz = a.m_y * a.m_z + b.m_y * b.m_z;
		area += points[i].m_area;
		if (!(yy + zz > 0))
			continue;
		way.m_y += points[i].m_area * (yy - zz) / (yy + zz);
		way.m_z += points[i].m_area * 2 * yz / (yy + zz);
	}
	return {way.m_y / area, way.m_z / area};
}

/// The ways of a cluster's pieces.
struct Ways
{
	Region::Moments m_moments;
	double m_distinct = 0;

	void add(const Region::Point& way, double area)
	{
		m_moments.m_area += area;
		m_moments.m_y += area * way.m_y;
		m_moments.m_z += area * way.m_z;
		m_moments.m_yy += area * way.m_y * way.m_y;
		m_moments.m_yz += area * way.m_y * way.m_z;
		m_moments.m_zz += area * way.m_z * way.m_z;
		m_distinct += area * hypot(way.m_y, way.m_z);
	}

	bool areOfACorner() const
	{
		return m_distinct > LEAST_DISTINCT * m_moments.m_area &&
			   hypot(m_moments.m_y, m_moments.m_z) < MOST_ALIKE * m_distinct;
	}
};
}  // namespace

size_t partAtCorners(const std::vector<SectionPoint>& points, const std::vector<Slips>& slips, size_t numClusters,
					 std::vector<size_t>& owners)
{
	std::vector<Region::Point> ways;
	std::vector<Ways> all(numClusters);
	for (size_t i = 0; i < owners.size(); ++i)
	{
		double area;
		const size_t first = i * POINTS_OF_A_PIECE;
		ways.push_back(wayOf(&points[first], &slips[first], area));
		all[owners[i]].add(ways[i], area);
	}
	const size_t before = numClusters;
	for (size_t c = 0; c < before; ++c)
	{
		if (!all[c].areOfACorner())
			continue;
		const Region::Moments& m = all[c].m_moments;
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
