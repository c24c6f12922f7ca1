// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_CORNERS_H
#define EP_TEST_CORNERS_H

#include <array>
#include <cmath>
#include <vector>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticSection.h"

/// An outline's corners, y and z.
typedef std::vector<std::array<double, 2>> Corners;

/// With its centre at (y, z), turned by an angle.
inline Corners rectangle(double height, double width, double y = 0, double z = 0, double turn = 0)
{
	Corners corners;
	for (int i = 0; i < 4; ++i)
	{
		const double u = (i == 1 || i == 2 ? 0.5 : -0.5) * height, v = (i < 2 ? -0.5 : 0.5) * width;
		corners.push_back({y + u * std::cos(turn) - v * std::sin(turn), z + u * std::sin(turn) + v * std::cos(turn)});
	}
	return corners;
}

/// So many corners on a circle about (0, 0).
inline Corners circle(double radius, int count)
{
	Corners corners;
	for (int i = 0; i < count; ++i)
		corners.push_back({radius * std::cos(2 * M_PI * i / count), radius * std::sin(2 * M_PI * i / count)});
	return corners;
}

/// \param unit  in which corners are [m]
inline btElasticPlasticSection polygon(const std::vector<Corners>& outlines, double unit = 1)
{
	std::vector<btElasticPlasticSectionPoint> all;
	std::vector<int> counts;
	for (const Corners& outline : outlines)
	{
		counts.push_back(int(outline.size()));
		for (const auto& corner : outline)
			all.push_back({btScalar(unit * corner[0]), btScalar(unit * corner[1])});
	}
	return btElasticPlasticSection::polygon(all.data(), counts.data(), int(counts.size()));
}

#endif  // EP_TEST_CORNERS_H
