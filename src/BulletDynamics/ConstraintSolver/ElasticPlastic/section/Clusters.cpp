// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Clusters.h"

#include <math.h>

#include "LinearMath/btMinMax.h"
#include "WallCorners.h"

namespace btElasticPlastic
{
namespace
{
const int LEAST_PIECES = 2500, PIECES_OF_A_CLUSTER = 30, ROUNDS = 40;
/// Of the area of a rectangle that has a figure's radii of gyration, from which it is a solid one: a triangle has 0.87, thin walls a fifth.
const double SOLID = 0.5;
/// What is symmetric has ties. The first one is taken, and not what a compiler's rounding makes of them.
const double TIE = 1e-9;

double distance2(const Cluster& a, const Cluster& b)
{
	return (a.m_y - b.m_y) * (a.m_y - b.m_y) + (a.m_z - b.m_z) * (a.m_z - b.m_z);
}

/// Each one where area is farthest from those before, the first one farthest from the origin.
std::vector<Cluster> spread(const std::vector<Cluster>& pieces, int count)
{
	std::vector<Cluster> clusters;
	std::vector<double> weight(pieces.size(), -1.);
	Cluster from = {0, 0, 0};
	for (int i = 0; i < count; ++i)
	{
		size_t next = 0;
		for (size_t k = 0; k < pieces.size(); ++k)
		{
			const double away = pieces[k].m_area * distance2(pieces[k], from);
			if (i < 2 || away < weight[k])
				weight[k] = away;
			if (weight[k] > weight[next] * (1 + TIE))
				next = k;
		}
		from = pieces[next];
		clusters.push_back(from);
	}
	return clusters;
}

size_t nearestTo(const Cluster& piece, const std::vector<Cluster>& clusters)
{
	size_t nearest = 0;
	double least = distance2(piece, clusters[0]);
	for (size_t i = 1; i < clusters.size(); ++i)
	{
		const double away = distance2(piece, clusters[i]);
		if (!(away < least * (1 - TIE)))
			continue;
		nearest = i;
		least = away;
	}
	return nearest;
}

/// Puts each one next to the one before, as far as they go.
void arrange(std::vector<Cluster>& clusters)
{
	for (size_t i = 1; i + 1 < clusters.size(); ++i)
	{
		size_t next = i;
		for (size_t k = i + 1; k < clusters.size(); ++k)
			if (distance2(clusters[k], clusters[i - 1]) < distance2(clusters[next], clusters[i - 1]) * (1 - TIE))
				next = k;
		const Cluster nearest = clusters[next];
		clusters[next] = clusters[i];
		clusters[i] = nearest;
	}
}

void add(double factor, const Region::Point& p, Region::Point& sum)
{
	sum.m_y += factor * p.m_y;
	sum.m_z += factor * p.m_z;
}

/// Each cluster is where its pieces are on average, and slips as they do.
/// \param owners  of pieces
std::vector<Cluster> meansOf(const std::vector<SectionPoint>& points, const std::vector<Slips>& slips, size_t count,
							 const std::vector<size_t>& owners)
{
	std::vector<Cluster> clusters(count, {0, 0, 0});
	for (size_t i = 0; i < points.size(); ++i)
		clusters[owners[i / POINTS_OF_A_PIECE]].m_area += points[i].m_area;
	for (size_t i = 0; i < points.size(); ++i)
	{
		Cluster& cluster = clusters[owners[i / POINTS_OF_A_PIECE]];
		const double share = points[i].m_area / cluster.m_area;
		const Region::Point& twist = slips[i].m_twist;
		cluster.m_y += share * points[i].m_y;
		cluster.m_z += share * points[i].m_z;
		add(share, slips[i].m_alongY, cluster.m_slips.m_alongY);
		add(share, slips[i].m_alongZ, cluster.m_slips.m_alongZ);
		add(share, twist, cluster.m_slips.m_twist);
		cluster.m_twistYY += share * twist.m_y * twist.m_y;
		cluster.m_twistYZ += share * twist.m_y * twist.m_z;
		cluster.m_twistZZ += share * twist.m_z * twist.m_z;
	}
	std::vector<Cluster> some;
	for (const Cluster& cluster : clusters)
		if (cluster.m_area > 0)
			some.push_back(cluster);
	return some;
}

/// By which distances between clusters are measured along y and z: of what is solid by its radii of gyration, so that clusters tell as much of axial force and
/// bending in a thin sheet as in a square. Walls have clusters that are compact.
struct Units
{
	double m_y = 1, m_z = 1;
};
Units unitsOf(const Region::Moments& all)
{
	const double gyrationY = sqrt(all.m_yy / all.m_area), gyrationZ = sqrt(all.m_zz / all.m_area);
	Units units;
	if (all.m_area >= SOLID * 12 * gyrationY * gyrationZ)
	{
		units.m_y = gyrationY;
		units.m_z = gyrationZ;
	}
	return units;
}

/// By Lloyd's method.
std::vector<Cluster> gather(const std::vector<Cluster>& pieces, int count)
{
	std::vector<Cluster> clusters = spread(pieces, btMin(count, int(pieces.size())));
	for (int round = 0; round < ROUNDS; ++round)
	{
		std::vector<Cluster> sums(clusters.size(), {0, 0, 0});
		for (const Cluster& piece : pieces)
		{
			Cluster& sum = sums[nearestTo(piece, clusters)];
			sum.m_y += piece.m_area * piece.m_y;
			sum.m_z += piece.m_area * piece.m_z;
			sum.m_area += piece.m_area;
		}
		clusters.clear();
		for (const Cluster& sum : sums)
			if (sum.m_area > 0)
				clusters.push_back({sum.m_y / sum.m_area, sum.m_z / sum.m_area, sum.m_area});
	}
	arrange(clusters);
	return clusters;
}
}  // namespace

std::vector<Cluster> clustersOf(const Region& region, int count)
{
	const Region::Moments all = region.moments();
	const Units units = unitsOf(all);
	const double y = units.m_y, z = units.m_z;
	std::vector<Region> regions;
	region.stretched(1 / y, 1 / z)
		.cut(all.m_area / (y * z) / btMax(LEAST_PIECES, PIECES_OF_A_CLUSTER * count), regions);
	std::vector<Cluster> pieces;
	std::vector<SectionPoint> points;
	for (const Region& piece : regions)
	{
		const Region::Moments m = piece.moments();
		pieces.push_back({m.m_y / m.m_area, m.m_z / m.m_area, m.m_area});
		addPointsOf(m, points);
	}
	const std::vector<Cluster> gathered = gather(pieces, count);
	std::vector<size_t> owners;
	for (const Cluster& piece : pieces)
		owners.push_back(nearestTo(piece, gathered));
	for (SectionPoint& p : points)
		p = {y * p.m_y, z * p.m_z, y * z * p.m_area};
	const std::vector<Slips> slips = slipsOf(points);
	const size_t numClusters = partAtCorners(points, slips, gathered.size(), owners);
	std::vector<Cluster> clusters = meansOf(points, slips, numClusters, owners);
	arrange(clusters);
	return clusters;
}
}  // namespace btElasticPlastic
