// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Clusters.h"

#include "LinearMath/btMinMax.h"

namespace btElasticPlastic
{
namespace
{
const int LEAST_PIECES = 1000, PIECES_OF_A_CLUSTER = 30, ROUNDS = 40;
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
}  // namespace

std::vector<Cluster> clustersOf(const Region& region, int count)
{
	std::vector<Region> regions;
	region.cut(region.moments().m_area / btMax(LEAST_PIECES, PIECES_OF_A_CLUSTER * count), regions);
	std::vector<Cluster> pieces;
	for (const Region& piece : regions)
	{
		const Region::Moments m = piece.moments();
		pieces.push_back({m.m_y / m.m_area, m.m_z / m.m_area, m.m_area});
	}
	std::vector<Cluster> clusters = spread(pieces, btMin(count, int(pieces.size())));
	for (int round = 0; round < ROUNDS; ++round)
	{
		std::vector<Cluster> sums(clusters.size(), {0, 0, 0});
		for (const Cluster& piece : pieces)
		{
			size_t nearest = 0;
			for (size_t i = 1; i < clusters.size(); ++i)
				if (distance2(piece, clusters[i]) < distance2(piece, clusters[nearest]) * (1 - TIE))
					nearest = i;
			sums[nearest].m_y += piece.m_area * piece.m_y;
			sums[nearest].m_z += piece.m_area * piece.m_z;
			sums[nearest].m_area += piece.m_area;
		}
		clusters.clear();
		for (const Cluster& sum : sums)
			if (sum.m_area > 0)
				clusters.push_back({sum.m_y / sum.m_area, sum.m_z / sum.m_area, sum.m_area});
	}
	return clusters;
}
}  // namespace btElasticPlastic
