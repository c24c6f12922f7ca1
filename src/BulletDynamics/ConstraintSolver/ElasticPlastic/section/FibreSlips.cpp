// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "FibreSlips.h"

#include <math.h>

#include "LinearMath/btMinMax.h"

namespace btElasticPlastic
{
namespace
{
/// What a cluster slips by shears across the way in which it slips most, over that: below it is a thin wall's; and where most of the section is, that of
/// a wall. Compact figures have 0.2 to 1, and less in a sharp corner.
const double THIN = 0.15, WALL = 0.4;
const int TURNS_ROUND = 50;
/// What is symmetric has ties: nothing is turned round for what rounding makes of them.
const double EVEN = 1e-9;

/// Of squares of slips.
PrincipalMoments squaresOf(double yy, double yz, double zz) { return principalMoments({1, 0, 0, yy, zz, yz}); }

/// How a cluster slips by shears, squared.
PrincipalMoments shearOf(const Cluster& cluster) { return principalMoments(shearProducts(cluster.m_slips)); }

/// \param share  of what it slips along, which it slips across
bool slipsAcrossLess(const PrincipalMoments& shear, double share)
{
	return sqrt(shear.m_lesser) < share * sqrt(shear.m_greater);
}

bool areWalls(const std::vector<Cluster>& clusters)
{
	double walls = 0, all = 0;
	for (const Cluster& cluster : clusters)
	{
		all += cluster.m_area;
		walls += slipsAcrossLess(shearOf(cluster), THIN) ? cluster.m_area : 0;
	}
	return walls > all / 2;
}

/// A slip by torsion varies within a cluster, most of all where that spans a wall whose faces slip to and fro. A cluster takes this part of what it varies by, its
/// neighbour that, so that in the sum nothing is left of it, nor of its moments.
struct Variation
{
	double m_slip[2];
	double m_sums[6];  ///< its part, times 1, y and z

	Variation(const Cluster& cluster, size_t index)
	{
		// Where four equal parts of what is spread evenly have their middles.
		static const double levels[] = {0.433, -1.299, 1.299, -0.433, -0.433, 1.299, -1.299, 0.433};
		const Region::Point& mean = cluster.m_slips.m_twist;
		const PrincipalMoments way =
			squaresOf(cluster.m_twistYY - mean.m_y * mean.m_y, cluster.m_twistYZ - mean.m_y * mean.m_z,
					  cluster.m_twistZZ - mean.m_z * mean.m_z);
		for (int k = 0; k < 2; ++k)
		{
			m_slip[k] = levels[index % 8] * sqrt(way.m_greater) * way.m_axis[k];
			m_sums[k] = cluster.m_area * m_slip[k];
			m_sums[2 + k] = m_sums[k] * cluster.m_y;
			m_sums[4 + k] = m_sums[k] * cluster.m_z;
		}
	}

	void turnRound()
	{
		for (double& slip : m_slip)
			slip = -slip;
		for (double& sum : m_sums)
			sum = -sum;
	}
};

/// \param size2  square of a length by which places are measured
void balance(std::vector<Variation>& variations, double size2)
{
	double sums[6] = {};
	for (const Variation& v : variations)
		for (int k = 0; k < 6; ++k)
			sums[k] += v.m_sums[k];
	for (int turn = 0; turn < TURNS_ROUND; ++turn)
		for (Variation& v : variations)
		{
			double square = 0, all = 0;
			for (int k = 0; k < 6; ++k)
			{
				const double part = v.m_sums[k] / (k < 2 ? 1 : size2);
				square += part * v.m_sums[k];
				all += part * sums[k];
			}
			if (!(square < all * (1 - EVEN)))
				continue;
			for (int k = 0; k < 6; ++k)
				sums[k] -= 2 * v.m_sums[k];
			v.turnRound();
		}
}
}  // namespace

std::vector<FibreSlip> fibreSlipsOf(const std::vector<Cluster>& clusters)
{
	std::vector<Variation> variations;
	double area = 0;
	for (const Cluster& cluster : clusters)
	{
		variations.push_back(Variation(cluster, variations.size()));
		area += cluster.m_area;
	}
	balance(variations, area);
	const bool hasWalls = areWalls(clusters);
	std::vector<FibreSlip> slips;
	for (size_t i = 0; i < clusters.size(); ++i)
	{
		const Region::Point& mean = clusters[i].m_slips.m_twist;
		const double* const varies = variations[i].m_slip;
		FibreSlip slip = {{0, 0}, {mean.m_y + varies[0], mean.m_z + varies[1]}};
		const PrincipalMoments shear = shearOf(clusters[i]);
		for (int k = 0; k < 2 && hasWalls && slipsAcrossLess(shear, WALL); ++k)
			slip.m_wall[k] = shear.m_axis[k];
		slips.push_back(slip);
	}
	return slips;
}
}  // namespace btElasticPlastic
