// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_SECTION_CELLS_H
#define EP_TEST_SECTION_CELLS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

/// A part of a section at a place in it, and the forces at which it yields.
struct SectionCell
{
	double y, z, tension, compression;
};

/// Of N, M_y, M_z.
typedef std::array<double, 3> SectionDirection;

/// What a section of cells bears in a direction q: the most of q_0 N + q_1 M_y + q_2 M_z.
inline double support(const std::vector<SectionCell>& cells, const SectionDirection& q)
{
	double sum = 0;
	for (const SectionCell& cell : cells)
	{
		const double stretch = q[0] + q[1] * cell.z - q[2] * cell.y;
		sum += stretch * (stretch > 0 ? cell.tension : -cell.compression);
	}
	return sum;
}

/// The largest deviation over random directions, each of N, M_y, M_z counting by what the section bears of it alone. The least and the
/// largest ratio of what two convex sets bear, over all directions, are those of their radii.
inline double largestDeviation(const std::vector<SectionCell>& cells, const std::vector<SectionCell>& exact,
							   const SectionDirection& alone, int directions)
{
	std::mt19937 random(1);
	std::normal_distribution<double> normal;
	double most = 0;
	for (int i = 0; i < directions; ++i)
	{
		SectionDirection q;
		for (size_t k = 0; k < 3; ++k)
			q[k] = normal(random) / alone[k];
		most = std::max(most, std::fabs(support(cells, q) / support(exact, q) - 1));
	}
	return most;
}

/// The directions in which few cells miss most of what many bear: the normals of what they bear, in which two of them are not stretched.
inline std::vector<SectionDirection> normalsOf(const std::vector<SectionCell>& cells)
{
	std::vector<SectionDirection> normals;
	for (size_t i = 0; i < cells.size(); ++i)
		for (size_t k = 0; k < i; ++k)
		{
			const SectionCell &a = cells[i], &b = cells[k];
			// (1, z, -y) of the one by that of the other.
			const SectionDirection q = {b.y * a.z - a.y * b.z, a.y - b.y, a.z - b.z};
			if (q == SectionDirection{0, 0, 0})
				continue;
			normals.push_back(q);
			normals.push_back({-q[0], -q[1], -q[2]});
		}
	return normals;
}

#endif  // EP_TEST_SECTION_CELLS_H
