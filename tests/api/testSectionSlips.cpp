// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// How sections slip elastically, by energies that are known.

#include <math.h>

#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/section/Slips.h"
#include "support/Corners.h"

namespace testSectionSlips
{
using namespace btElasticPlastic;

/// Integrals of the squares of the slips along y, along z and by a twist.
struct Energies
{
	double m_alongY = 0, m_alongZ = 0, m_twist = 0;
	bool m_isFinite = true;
};

/// \param turn  of the figure about its centroid
Energies energiesOf(const std::vector<Corners>& outlines, double turn = 0, double pieces = 1000)
{
	Region region;
	for (size_t i = 0; i < outlines.size(); ++i)
	{
		Region::Outline outline;
		for (const auto& corner : outlines[i])
			outline.push_back({corner[0], corner[1]});
		if ((areaOf(outline) > 0) != (i == 0))
			outline = Region::Outline(outline.rbegin(), outline.rend());
		region.m_outlines.push_back(outline);
	}
	const Region::Moments all = region.moments();
	region = region.seenFrom(all.m_y / all.m_area, all.m_z / all.m_area, turn);
	std::vector<Region> parts;
	region.cut(all.m_area / pieces, parts);
	std::vector<SectionPoint> points;
	for (const Region& part : parts)
		addPointsOf(part.moments(), points);
	Energies sums;
	const std::vector<Slips> slips = slipsOf(points);
	for (size_t i = 0; i < points.size(); ++i)
	{
		const auto square = [&](const Region::Point& p) { return points[i].m_area * (p.m_y * p.m_y + p.m_z * p.m_z); };
		sums.m_alongY += square(slips[i].m_alongY);
		sums.m_alongZ += square(slips[i].m_alongZ);
		sums.m_twist += square(slips[i].m_twist);
	}
	return sums;
}

TEST(SectionSlips, OfATwistHaveTheTorsionConstant)
{
	const double root = sqrt(3);
	const struct
	{
		const char* m_name;
		std::vector<Corners> m_outlines;
		double m_exact, m_error, m_pieces = 1000;
	} sections[] = {
		{"square", {rectangle(1, 1)}, 0.140577, 0.005},
		{"1 : 2", {rectangle(2, 1)}, 2 * 0.228682, 0.01},
		{"1 : 5", {rectangle(5, 1)}, 5 * 0.291317, 0.01},
		{"equilateral", {{{0, 0}, {0, 1}, {root / 2, 0.5}}}, root / 80, 0.005},
		{"circle", {circle(1, 100)}, M_PI / 2, 0.005},
		{"tube", {circle(1, 100), circle(0.9, 100)}, M_PI / 2 * (1 - pow(0.9, 4)), 0.01},
		// Bredt, and the walls by themselves. A cell of the grid is three walls wide at the corners, with as many pieces as sections have.
		{"box",
		 {rectangle(2, 1), rectangle(1.96, 0.96)},
		 4 * pow(1.98 * 0.98, 2) * 0.02 / (2 * (1.98 + 0.98)) + 2 * (1.98 + 0.98) * pow(0.02, 3) / 3,
		 0.02,
		 2000},
		{"sheet", {rectangle(1, 1e-3)}, 1e-9 / 3 * (1 - 0.63e-3), 0.005}};
	for (const auto& section : sections)
		for (const double turn : {0., 0.4})
			EXPECT_NEAR(1, energiesOf(section.m_outlines, turn, section.m_pieces).m_twist / section.m_exact,
						section.m_error)
				<< section.m_name << ", " << turn;
}

TEST(SectionSlips, OfShearsHaveTheShearArea)
{
	// A rectangle's, 5/6 of its area; a wall's, along itself, and next to nothing across.
	for (const double turn : {0., 0.4})
		EXPECT_NEAR(5. / 6, energiesOf({rectangle(1, 1)}, turn).m_alongY, 0.005) << turn;
	const Energies flat = energiesOf({rectangle(5, 1)});
	EXPECT_NEAR(5. / 6, flat.m_alongY / 5, 0.005);
	EXPECT_NEAR(5. / 6, flat.m_alongZ / 5, 0.02);
	// An I 2 x 1 with walls of 0.02: along the web I^2 over the integral of Q^2 / t over all thin walls; and both flanges, with what a cell of the grid has of the
	// web.
	const double w = 0.01;
	const Energies wide = energiesOf({{{1, -0.5},
									   {1, 0.5},
									   {0.98, 0.5},
									   {0.98, w},
									   {-0.98, w},
									   {-0.98, 0.5},
									   {-1, 0.5},
									   {-1, -0.5},
									   {-0.98, -0.5},
									   {-0.98, -w},
									   {0.98, -w},
									   {0.98, -0.5}}},
									 0, 2000);
	EXPECT_NEAR(1, wide.m_alongY / 0.03753, 0.01);
	EXPECT_NEAR(1, wide.m_alongZ / (2 * 5. / 6 * 0.02), 0.03);
}

TEST(SectionSlips, NeedNoMoreThanAFewPieces)
{
	for (const double pieces : {1., 4., 50.})
	{
		const Energies few = energiesOf({rectangle(2, 1)}, 0.3, pieces);
		for (const double energy : {few.m_alongY, few.m_alongZ, few.m_twist})
		{
			EXPECT_GE(energy, 0) << pieces;
			EXPECT_LT(energy, 3) << pieces;
		}
	}
}
}  // namespace testSectionSlips
