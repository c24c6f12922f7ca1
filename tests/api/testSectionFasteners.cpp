// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Bolts and welds as sections, against closed forms and searches that share nothing with them.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticCapacity.h"
#include "support/Close.h"
#include "support/SectionCells.h"

namespace testSectionFasteners
{
typedef btElasticPlasticSection Section;

/// What is computed in double from numbers of the precision, and rounded once.
const double ROUNDED = byPrecision(1e-9, 2e-6);
const double M20 = 245e-6;  // A_s [m^2]

Section bolts(const std::vector<std::pair<double, double>>& places, double area = M20, double turn = 0,
			  double shift = 0)
{
	std::vector<btElasticPlasticSectionPoint> points;
	for (const auto& p : places)
		points.push_back({btScalar(p.first * std::cos(turn) - p.second * std::sin(turn) + shift),
						  btScalar(p.first * std::sin(turn) + p.second * std::cos(turn) - shift)});
	return Section::bolts(points.data(), int(points.size()), btScalar(area));
}

Section welds(const std::vector<std::array<double, 4>>& lines, double throat, double turn = 0)
{
	std::vector<btElasticPlasticSectionLine> all;
	const auto at = [&](double y, double z) -> btElasticPlasticSectionPoint {
		return {btScalar(y * std::cos(turn) - z * std::sin(turn)), btScalar(y * std::sin(turn) + z * std::cos(turn))};
	};
	for (const auto& l : lines)
		all.push_back({at(l[0], l[1]), at(l[2], l[3])});
	return Section::welds(all.data(), int(all.size()), btScalar(throat));
}

TEST(SectionFasteners, FourBolts)
{
	for (const double turn : {0., 0.4})
	{
		const Section s = bolts({{0.1, 0.05}, {0.1, -0.05}, {-0.1, 0.05}, {-0.1, -0.05}}, M20, turn, 0.3);
		ASSERT_FALSE(s.m_fault);
		EXPECT_NEAR(turn, s.m_turn, 1e-5);
		EXPECT_NEAR(0.3, s.m_centroid[0], 1e-6);
		EXPECT_NEAR(-0.3, s.m_centroid[1], 1e-6);
		const double own = M20 * M20 / (4 * M_PI), edge = std::sqrt(M20 / M_PI);
		expectClose(4 * M20, s.m_area, ROUNDED);
		expectClose(4 * (M20 * 0.05 * 0.05 + own), s.m_secondMoment[0], 10 * ROUNDED);
		expectClose(4 * (M20 * 0.1 * 0.1 + own), s.m_secondMoment[1], 10 * ROUNDED);
		expectClose(4 * M20 * 0.05, s.m_plasticModulus[0], 10 * ROUNDED);
		expectClose(4 * M20 * 0.1, s.m_plasticModulus[1], 10 * ROUNDED);
		expectClose(4 * M20 * std::hypot(0.1, 0.05), s.m_plasticTorsionModulus, 10 * ROUNDED);
		expectClose(4 * (M20 * 0.0125 + 2 * own), s.m_torsionConstant, 10 * ROUNDED);
		expectClose(0.1 + edge, s.m_outerFibre[0], 10 * ROUNDED);
		expectClose(0.05 + edge, s.m_outerFibre[1], 10 * ROUNDED);
		expectClose(4 * M20, s.m_plasticShearArea[0], ROUNDED);
		ASSERT_EQ(4, s.withFibres().m_fibres.size());
		expectClose(M20, s.withFibres().m_fibres[2].m_area, ROUNDED);
	}
}

TEST(SectionFasteners, OneBoltIsARodAndARowBendsItsBolts)
{
	const double r = 0.01;
	const Section one = bolts({{0.2, 0.1}}, M_PI * r * r), rod = Section::circle(btScalar(r));
	for (int i = 0; i < 2; ++i)
	{
		expectClose(rod.m_secondMoment[i], one.m_secondMoment[i], ROUNDED);
		expectClose(rod.m_plasticModulus[i], one.m_plasticModulus[i], ROUNDED);
	}
	expectClose(rod.m_torsionConstant, one.m_torsionConstant, ROUNDED);
	expectClose(rod.m_plasticTorsionModulus, one.m_plasticTorsionModulus, ROUNDED);
	const Section row = bolts({{-0.1, 0}, {0, 0}, {0.1, 0}}, M_PI * r * r);
	expectClose(3 * double(rod.m_plasticModulus[0]), row.m_plasticModulus[0], ROUNDED);
	expectClose(0.2 * M_PI * r * r, row.m_plasticModulus[1], byPrecision(1e-7, 2e-6));  // a search for the least
	expectClose(3 * double(rod.m_secondMoment[0]), row.m_secondMoment[0], ROUNDED);
}

TEST(SectionFasteners, TorsionIsAboutThePlaceWhereBoltsBearLeast)
{
	// Five bolts without any symmetry; of all centres the best, by a grid.
	const std::vector<std::pair<double, double>> places = {{0, 0}, {0.1, 0}, {0.2, 0.02}, {0, 0.15}, {-0.03, 0.05}};
	const Section s = bolts(places);
	double least = 1e9;
	for (int i = 0; i <= 600; ++i)
		for (int k = 0; k <= 600; ++k)
		{
			double sum = 0;
			for (const auto& p : places)
				sum += M20 * std::hypot(p.first - (i * 5e-4 - 0.05), p.second - (k * 5e-4 - 0.05));
			least = std::min(least, sum);
		}
	EXPECT_LE(s.m_plasticTorsionModulus, least * (1 + ROUNDED));
	EXPECT_NEAR(least, s.m_plasticTorsionModulus, 1e-4 * least);
}

TEST(SectionFasteners, WeldsOfTwoLinesAndOfARectangle)
{
	const double a = 0.005, l = 0.2, d = 0.1;
	for (const double turn : {0., -0.5})
	{
		const Section pair = welds({{-l / 2, d / 2, l / 2, d / 2}, {l / 2, -d / 2, -l / 2, -d / 2}}, a, turn);
		ASSERT_FALSE(pair.m_fault);
		EXPECT_NEAR(turn, pair.m_turn, 1e-5);
		expectClose(2 * a * l, pair.m_area, 10 * ROUNDED);
		expectClose(2 * a * l * l * l / 12, pair.m_secondMoment[1], 20 * ROUNDED);
		expectClose(2 * (a * l * d * d / 4 + l * a * a * a / 12), pair.m_secondMoment[0], 20 * ROUNDED);
		expectClose(a * l * l / 2, pair.m_plasticModulus[1], 20 * ROUNDED);
		expectClose(a * l * d, pair.m_plasticModulus[0], 20 * ROUNDED);
		// 2 integral of hypot over a line.
		const double h = l / 2, k = d / 2;
		expectClose(2 * a * (h * std::hypot(h, k) + k * k * std::asinh(h / k)), pair.m_plasticTorsionModulus, 2e-4);
	}
	// One line about itself, a^2 l / 4.
	expectClose(a * a * l / 4, welds({{0, 0, l, 0}}, a).m_plasticModulus[0], 20 * ROUNDED);
	// All round: a box whose middle line it is, but for the corners.
	const Section round = welds({{-l / 2, -d / 2, l / 2, -d / 2},
								 {l / 2, -d / 2, l / 2, d / 2},
								 {l / 2, d / 2, -l / 2, d / 2},
								 {-l / 2, d / 2, -l / 2, -d / 2}},
								a),
				  box = Section::hollowRectangle(btScalar(d + a), btScalar(l + a), btScalar(a));
	expectClose(box.m_area, round.m_area, 1e-4);
	for (int i = 0; i < 2; ++i)
	{
		expectClose(box.m_secondMoment[i], round.m_secondMoment[i], 0.01);
		expectClose(box.m_plasticModulus[i], round.m_plasticModulus[i], 0.01);
	}
}

TEST(SectionFasteners, FibresOfWeldsBearWhatTheyDoInAllDirections)
{
	const double a = 0.006;
	const std::vector<std::vector<std::array<double, 4>>> patterns = {
		{{-0.1, 0.05, 0.1, 0.05}, {-0.1, -0.05, 0.1, -0.05}},
		{{-0.1, -0.05, 0.1, -0.05}, {0.1, -0.05, 0.1, 0.05}, {-0.1, -0.05, -0.1, 0.05}},
		{{0, 0, 0.2, 0.05}, {0, 0.1, 0.15, 0.2}}};
	for (const auto& pattern : patterns)
	{
		const Section s = welds(pattern, a);
		std::vector<SectionCell> cells;
		for (int p = 0; p < s.m_parts.size(); ++p)
		{
			const btElasticPlasticSectionPart& part = s.m_parts[p];
			const double c = std::cos(double(part.m_turn)), n = std::sin(double(part.m_turn));
			for (int i = 0; i < 400; ++i)
				for (int k = 0; k < 4; ++k)
				{
					const double u = ((i + 0.5) / 400 - 0.5) * double(part.m_height), v = ((k + 0.5) / 4 - 0.5) * a,
								 area = double(part.m_height) * a / 1600;
					cells.push_back({part.m_y + c * u - n * v, part.m_z + n * u + c * v, area, area});
				}
		}
		for (const int count : {0, 120})
		{
			const Section cut = s.withFibres(count);
			ASSERT_FALSE(cut.m_fault);
			std::vector<SectionCell> fibres;
			for (int i = 0; i < cut.m_fibres.size(); ++i)
				fibres.push_back(
					{cut.m_fibres[i].m_y, cut.m_fibres[i].m_z, cut.m_fibres[i].m_area, cut.m_fibres[i].m_area});
			const double most = largestDeviation(
				fibres, cells, {double(s.m_area), double(s.m_plasticModulus[0]), double(s.m_plasticModulus[1])}, 2000);
			EXPECT_LE(most, count == 0 ? 0.03 : 0.01);
		}
	}
}

TEST(SectionFasteners, AnEndPlateOpensOverItsBolts)
{
	// Two rows of two M20 of 640 MPa, 0.2 m apart, in a plate of 0.1 x 0.3 m that presses with 235 MPa and opens without a force. All bolts are
	// stretched where it bends, and the plate presses along its edge.
	btElasticPlasticMaterial bolt = btElasticPlasticMaterial::steel(btScalar(640e6)),
							 contact = btElasticPlasticMaterial::steel(btScalar(235e6));
	contact.m_tensileShare = 0;
	Section s = bolts({{0.1, 0.03}, {0.1, -0.03}, {-0.1, 0.03}, {-0.1, -0.03}}).withFibres();
	s.addPart(Section::rectangle(btScalar(0.1), btScalar(0.3)).withFibres(36), 0, 0, contact);
	const btElasticPlasticCapacity c = btElasticPlasticCapacity::fromMember(bolt, s, btScalar(0.05), btScalar(0.05));
	ASSERT_FALSE(c.fault());
	const double force = M20 * 640e6, depth = 4 * force / (0.1 * 235e6);
	// 36 fibres of the plate: within 1 % of its own N_p h.
	EXPECT_NEAR(2 * force * (0.25 + 0.05) - 4 * force * depth / 2, c.m_yield[BT_EP_BENDING_Z],
				0.01 * 235e6 * 0.03 * 0.3);
	double tension = 0, compression = 0;
	for (int i = 0; i < c.m_fibres.size(); ++i)
	{
		tension += double(c.m_fibres[i].m_tension);
		compression += double(c.m_fibres[i].m_compression);
	}
	expectClose(4 * force, tension, 1e-5);
	expectClose(4 * force + 235e6 * 0.03, compression, 1e-5);
	// Shear and torsion are the bolts'.
	expectClose(4 * M20 * 320e6, c.m_yield[BT_EP_SHEAR_Y], 1e-5);
	expectClose(4 * M20 * std::hypot(0.1, 0.03) * 320e6, c.m_yield[BT_EP_TORSION], 1e-5);
}

TEST(SectionFasteners, TellWhatIsWrong)
{
	const btElasticPlasticSectionPoint point = {0, 0};
	EXPECT_STREQ("area of a bolt [m^2]", Section::bolts(&point, 1, 0).m_fault.m_quantity);
	EXPECT_STREQ("number of bolts", Section::bolts(&point, 0, 1).m_fault.m_quantity);
	EXPECT_STREQ("number of bolts", Section::bolts(&point, 401, 1).m_fault.m_quantity);
	const btElasticPlasticSectionPoint wrong = {btScalar(NAN), 0};
	EXPECT_STREQ("place of a bolt, y + z [m]", Section::bolts(&wrong, 1, 1).m_fault.m_quantity);
	const btElasticPlasticSectionLine line = {{0, 0}, {0, btScalar(0.01)}};
	EXPECT_STREQ("throat of a weld [m]", Section::welds(&line, 1, -1).m_fault.m_quantity);
	EXPECT_STREQ("length of a weld [m]", Section::welds(&line, 1, btScalar(0.02)).m_fault.m_quantity);
	EXPECT_STREQ("number of welds", Section::welds(&line, -1, btScalar(0.001)).m_fault.m_quantity);
}
}  // namespace testSectionFasteners
