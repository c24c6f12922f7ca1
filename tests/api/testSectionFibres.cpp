// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Sections cut into fibres, against integrals over their shape.

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticHeat.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticCapacity.h"
#include "support/Close.h"
#include "support/SectionCells.h"

namespace testSectionFibres
{
const btScalar YIELD = btScalar(250e6);

btElasticPlasticMaterial steel() { return btElasticPlasticMaterial::steel(YIELD); }

std::vector<SectionCell> cellsOf(const btElasticPlasticCapacity& capacity)
{
	std::vector<SectionCell> cells;
	for (int i = 0; i < capacity.m_fibres.size(); ++i)
	{
		const btElasticPlasticFibre& fibre = capacity.m_fibres[i];
		cells.push_back({fibre.m_y, fibre.m_z, fibre.m_tension, fibre.m_compression});
	}
	return cells;
}

/// The shape in so many cells that they err by less than 1 / 80^2, 0.02 %.
std::vector<SectionCell> finely(const btElasticPlasticSection& section)
{
	const int n = 80;
	std::vector<SectionCell> cells;
	for (int p = 0; p < section.m_parts.size(); ++p)
	{
		const btElasticPlasticSectionPart& part = section.m_parts[p];
		for (int i = 0; i < n; ++i)
			for (int j = 0; j < n; ++j)
			{
				const double u = (i + 0.5) / n, v = (j + 0.5) / n;
				if (part.m_radius > 0)
				{
					// Equal areas.
					const double inner = part.m_innerRadius, outer = part.m_radius;
					const double r = std::sqrt(inner * inner + u * (outer * outer - inner * inner)),
								 angle = 2 * M_PI * v;
					const double force = double(section.m_area) / n / n * double(YIELD);
					cells.push_back({r * std::sin(angle), r * std::cos(angle), force, force});
					continue;
				}
				const double force = double(part.m_height) * double(part.m_width) / n / n * double(YIELD);
				cells.push_back(
					{part.m_y + (u - 0.5) * part.m_height, part.m_z + (v - 0.5) * part.m_width, force, force});
			}
	}
	return cells;
}

btElasticPlasticCapacity capacityOf(const btElasticPlasticSection& section)
{
	return btElasticPlasticCapacity::fromMember(steel(), section, 1, 1);
}

double deviation(const btElasticPlasticSection& shape, int count)
{
	const std::vector<SectionCell> exact = finely(shape), fibres = cellsOf(capacityOf(shape.withFibres(count)));
	return largestDeviation(fibres, exact,
							{support(exact, {1, 0, 0}), support(exact, {0, 1, 0}), support(exact, {0, 0, 1})}, 2000);
}

/// The integral of |q_0 + q_1 z - q_2 y| over a rectangle around the origin.
double stretchOf(const SectionDirection& q, double width, double height)
{
	const auto cube = [](double x) { return std::fabs(x * x * x); };
	const double n = q[0], a = q[1] * width / 2, b = q[2] * height / 2, least = 1e-4 * (std::fabs(a) + std::fabs(b));
	// Beside an axis Simpson's rule in place of a difference of nearly equal numbers.
	if (std::fabs(a) < least || std::fabs(b) < least)
	{
		const double slope = std::fabs(a) < least ? b : a, other = std::fabs(a) < least ? a : b;
		const auto along = [&](double m)
		{ return ((m + slope) * std::fabs(m + slope) - (m - slope) * std::fabs(m - slope)) / (4 * slope); };
		return width * height * (along(n - other) + 4 * along(n) + along(n + other)) / 6;
	}
	return width * height * (cube(n + a + b) - cube(n + a - b) - cube(n - a + b) + cube(n - a - b)) / (24 * a * b);
}

struct Shape
{
	const char* m_name;
	btElasticPlasticSection m_section;
};

std::vector<Shape> shapes()
{
	return {
		{"square", btElasticPlasticSection::rectangle(btScalar(0.02), btScalar(0.02))},
		{"rectangle", btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.5))},
		{"circle", btElasticPlasticSection::circle(btScalar(0.05))},
		{"tube", btElasticPlasticSection::hollowCircle(btScalar(0.05), btScalar(0.005))},
		{"box", btElasticPlasticSection::hollowRectangle(btScalar(0.1), btScalar(0.2), btScalar(0.006))},
		{"IPE 200",
		 btElasticPlasticSection::iSection(btScalar(0.1), btScalar(0.2), btScalar(0.0056), btScalar(0.0085))},
		{"HEB 200", btElasticPlasticSection::iSection(btScalar(0.2), btScalar(0.2), btScalar(0.009), btScalar(0.015))}};
}

TEST(SectionFibres, BearWhatTheSectionBearsInAllDirections)
{
	// What withFibres() says of its numbers, with the two digits it says it in.
	for (const Shape& shape : shapes())
	{
		EXPECT_LE(deviation(shape.m_section, 0), 0.025) << shape.m_name;
		EXPECT_LE(deviation(shape.m_section, 60), 0.0115) << shape.m_name;
		EXPECT_LE(deviation(shape.m_section, 100), 0.0075) << shape.m_name;
	}
	EXPECT_LE(deviation(shapes()[0].m_section, 4), 0.25);
}

TEST(SectionFibres, BearWhatATubeBearsWhateverItsWall)
{
	for (const double hole : {0.05, 0.15, 0.25, 0.31, 0.4, 0.5, 0.6, 0.64, 0.66, 0.8, 0.95})
		for (const double share : {1., 0.5})
		{
			const auto scaled = [share](std::vector<SectionCell> cells)
			{
				for (SectionCell& cell : cells)
					cell.tension *= share;
				return cells;
			};
			const btElasticPlasticSection tube = btElasticPlasticSection::tube(1, btScalar(hole));
			const std::vector<SectionCell> exact = scaled(finely(tube));
			const SectionDirection alone = {support(exact, {-1, 0, 0}), support(exact, {0, 1, 0}),
											support(exact, {0, 0, 1})};
			const auto deviates = [&](int count)
			{ return largestDeviation(scaled(cellsOf(capacityOf(tube.withFibres(count)))), exact, alone, 2000); };
			EXPECT_LE(deviates(0), 0.03) << hole << ", " << share;
			EXPECT_LE(deviates(33), 0.0245) << hole << ", " << share;
			EXPECT_LE(deviates(60), 0.0105) << hole << ", " << share;
			EXPECT_LE(deviates(100), 0.0075) << hole << ", " << share;
			EXPECT_EQ(hole < 0.3 ? 33 : 20, tube.withFibres().m_fibres.size());
			EXPECT_EQ(47, tube.withFibres(47).m_fibres.size());
		}
}

TEST(SectionFibres, OfARectangleMissNothingInAnyDirection)
{
	// With the digits in which the tables of btElasticPlasticSectionFibres.cpp say it; as strong in tension as in compression, and half as strong.
	const struct
	{
		int m_count;
		double m_equal, m_half;
	} cases[] = {
		{8, 0.055, 0.0805}, {12, 0.0295, 0.0415}, {16, 0.024, 0.0255}, {36, 0.01, 0.014}, {112, 0.0085, 0.0085}};
	const double width = 0.1, height = 0.5;
	for (const auto& c : cases)
		for (const double share : {1., 0.5})
		{
			btElasticPlasticMaterial material = steel();
			material.m_tensileShare = btScalar(share);
			const std::vector<SectionCell> fibres = cellsOf(btElasticPlasticCapacity::fromMember(
				material, btElasticPlasticSection::rectangle(btScalar(width), btScalar(height)).withFibres(c.m_count),
				1, 1));
			std::vector<SectionDirection> directions = normalsOf(fibres);
			std::mt19937 random(1);
			std::normal_distribution<double> normal;
			for (int i = 0; i < 5000; ++i)
				directions.push_back({normal(random), normal(random) * 4 / width, normal(random) * 4 / height});
			double most = 0;
			for (const SectionDirection& q : directions)
			{
				const double exact = double(YIELD) * ((1 + share) / 2 * stretchOf(q, width, height) -
													  (1 - share) / 2 * width * height * q[0]);
				most = std::max(most, std::fabs(support(fibres, q) / exact - 1));
			}
			EXPECT_LE(most, share == 1 ? c.m_equal : c.m_half) << c.m_count;
		}
}

TEST(SectionFibres, AreAsManyAsAnErrorAsksFor)
{
	for (const Shape& shape : shapes())
	{
		int before = 0;
		for (const double error : {0.3, 0.1, 0.05, 0.03, 0.0115, 0.0085})
		{
			const btElasticPlasticSection section = shape.m_section.withFibresFor(btScalar(error));
			EXPECT_FALSE(section.m_fault);
			const int count = section.m_fibres.size();
			EXPECT_LE(deviation(shape.m_section, count), error) << shape.m_name;
			EXPECT_GE(count, before) << shape.m_name;
			before = count;
		}
		EXPECT_GT(before, shape.m_section.withFibresFor(btScalar(0.3)).m_fibres.size()) << shape.m_name;
	}
	for (const btScalar wrong : {btScalar(0), btScalar(-1), btScalar(NAN)})
		EXPECT_STREQ("error of a section that is cut into fibres",
					 shapes()[0].m_section.withFibresFor(wrong).m_fault.m_quantity);
}

TEST(SectionFibres, AreExactWhereOneForceActsAlone)
{
	for (const Shape& shape : shapes())
		for (const int count : {0, 12, 16, 36, 60, 100})
		{
			const btElasticPlasticCapacity independent = capacityOf(shape.m_section),
										   whole = capacityOf(shape.m_section.withFibres(count));
			EXPECT_FALSE(whole.fault()) << shape.m_name;
			const bool isRound = shape.m_section.m_parts[0].m_radius > 0;
			const int dofs[] = {BT_EP_AXIAL, BT_EP_BENDING_Y, BT_EP_BENDING_Z};
			for (const int dof : dofs)
			{
				// Polygons of fibres bear moments that are right in the mean over all directions, with the deviation of the table.
				expectClose(independent.m_yield[dof], whole.m_yield[dof],
							isRound && dof != BT_EP_AXIAL ? 0.03 : byPrecision(1e-9, 1e-5));
				expectClose(independent.m_stiffness[dof], whole.m_stiffness[dof], byPrecision(1e-9, 1e-5));
			}
			double first[2] = {}, mixed = 0;
			for (int i = 0; i < whole.m_fibres.size(); ++i)
			{
				const btElasticPlasticFibre& fibre = whole.m_fibres[i];
				EXPECT_GT(fibre.m_stiffness, 0) << shape.m_name;
				first[0] += double(fibre.m_stiffness) * fibre.m_y;
				first[1] += double(fibre.m_stiffness) * fibre.m_z;
				mixed += double(fibre.m_stiffness) * fibre.m_y * fibre.m_z;
			}
			const double size = shape.m_section.m_outerFibre[0], scale = double(whole.m_stiffness[BT_EP_AXIAL]) * size;
			EXPECT_NEAR(0, first[0] / scale, byPrecision(1e-12, 1e-6));
			EXPECT_NEAR(0, first[1] / scale, byPrecision(1e-12, 1e-6));
			EXPECT_NEAR(0, mixed / scale / size, byPrecision(1e-12, 1e-6));
		}
}

/// The largest moment about z beside an axial force: fibres are stretched from one side on until they add up to it.
double momentBeside(double axial, std::vector<SectionCell> cells)
{
	std::sort(cells.begin(), cells.end(), [](const SectionCell& a, const SectionCell& b) { return a.y < b.y; });
	double force = 0, moment = 0;
	for (const SectionCell& cell : cells)
	{
		force -= cell.compression;
		moment += cell.compression * cell.y;
	}
	for (const SectionCell& cell : cells)
	{
		const double range = cell.tension + cell.compression, share = std::min(1., (axial - force) / range);
		force += share * range;
		moment -= share * range * cell.y;
		if (share < 1)
			break;
	}
	return moment;
}

TEST(SectionFibres, BearTheMomentsOfTheory)
{
	// Beside n = N / Np, as shares of the moment alone: of a circle and a tube of 50 and 5 mm by integration; of an IPE 200 with sharp corners in kN m.
	struct Point
	{
		double n, moment;
	};
	const struct
	{
		const char* name;
		btElasticPlasticSection section;
		bool isAboutY;
		double unit;  ///< of the moments [N m]
		std::vector<Point> points;
	} cases[] = {{"circle",
				  btElasticPlasticSection::circle(btScalar(0.05)),
				  false,
				  4. / 3 * 1.25e-4 * double(YIELD),
				  {{0.1, .990742}, {0.25, .941981}, {0.5, .765486}, {0.75, .461451}, {0.9, .208268}}},
				 {"tube",
				  btElasticPlasticSection::hollowCircle(btScalar(0.05), btScalar(0.005)),
				  false,
				  4. / 3 * (1.25e-4 - 0.91125e-4) * double(YIELD),
				  {{0.1, .987700}, {0.25, .923953}, {0.5, .707433}, {0.75, .383724}, {0.9, .158918}}},
				 {"IPE 200",
				  shapes()[5].m_section,
				  false,
				  1e3,
				  {{0, 52.4149}, {0.2, 49.1004}, {0.4, 39.2015}, {0.6, 26.5055}, {0.8, 13.4384}}},
				 {"IPE 200 about y",
				  shapes()[5].m_section,
				  true,
				  1e3,
				  {{0, 10.9837}, {0.2, 10.8909}, {0.4, 10.6125}, {0.6, 9.2566}, {0.8, 5.7202}}},
				 {"square", shapes()[0].m_section, false, 500, {{0, 1}, {0.25, 0.9375}, {0.5, 0.75}, {0.75, 0.4375}}}};
	for (const auto& c : cases)
		for (const int count : {0, 100})
		{
			const btElasticPlasticCapacity capacity = capacityOf(c.section.withFibres(count));
			std::vector<SectionCell> cells = cellsOf(capacity);
			for (SectionCell& cell : cells)
				if (c.isAboutY)
					std::swap(cell.y, cell.z);
			const double most = c.points[0].n == 0 ? c.points[0].moment * c.unit : c.unit;
			for (const Point& point : c.points)
				EXPECT_NEAR(point.moment * c.unit, momentBeside(point.n * double(capacity.m_yield[BT_EP_AXIAL]), cells),
							(count == 0 ? 0.03 : 0.01) * most)
					<< c.name << ", n " << point.n << ", " << count;
		}
}

TEST(SectionFibres, KnowReinforcedConcrete)
{
	// 300 x 500 mm, f_c = 30 MPa, no tension, four bars of 20 mm and 500 MPa: by integration over the section.
	btElasticPlasticMaterial concrete;
	concrete.m_youngsModulus = btScalar(33e9);
	concrete.m_yieldStress = btScalar(30e6);
	concrete.m_tensileShare = 0;
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(0.3), btScalar(0.5)).withFibres(36);
	for (const double y : {0.21, -0.21})
		for (const double z : {0.11, -0.11})
			section.addBar(btScalar(y), btScalar(z), btScalar(314.16e-6),
						   btElasticPlasticMaterial::steel(btScalar(500e6)));
	const btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(concrete, section, 1, 1);
	EXPECT_FALSE(capacity.fault());
	EXPECT_EQ(40, capacity.m_fibres.size());
	const double exact[][2] = {{500e3, 31.165e3},    {0, 139.147e3},       {-500e3, 243.058e3},
							   {-1000e3, 326.392e3}, {-2250e3, 413.197e3}, {-3500e3, 326.392e3}};
	for (const auto& point : exact)
	{
		const double m = momentBeside(point[0], cellsOf(capacity));
		// 36 fibres are right within 1 % of what the section bears at most in each direction.
		EXPECT_NEAR(point[1], m, 0.012 * 413e3) << point[0];
	}
}

TEST(SectionFibres, TellWhatIsWrong)
{
	const btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1));
	EXPECT_STREQ("number of fibres", section.withFibres(3).m_fault.m_quantity);
	EXPECT_STREQ("number of fibres", section.withFibres(401).m_fault.m_quantity);
	EXPECT_TRUE(btElasticPlasticSection().withFibres().m_fault);
	btElasticPlasticSection uncut = section, noArea = section.withFibres(), noPlace = section.withFibres();
	uncut.addBar(0, 0, 1, steel());
	EXPECT_STREQ("number of fibres of a section with bars", uncut.m_fault.m_quantity);
	noArea.addBar(0, 0, 0, steel());
	EXPECT_STREQ("area of a bar [m^2]", noArea.m_fault.m_quantity);
	noPlace.addBar(btScalar(NAN), 0, 1, steel());
	EXPECT_TRUE(noPlace.m_fault);
	EXPECT_TRUE(capacityOf(noPlace).fault());
	btElasticPlasticSection noMaterial = section.withFibres();
	noMaterial.m_fibres[0].m_material = 1;
	EXPECT_STREQ("material of a fibre of the section", capacityOf(noMaterial).fault().m_quantity);
	btElasticPlasticCapacity capacity = capacityOf(section.withFibres());
	capacity.m_fibres[2].m_tension = btScalar(-1);
	EXPECT_STREQ("strength of a fibre in tension [N]", capacity.fault().m_quantity);
	capacity = capacityOf(section.withFibres());
	capacity.m_yield[BT_EP_AXIAL] = 0;
	EXPECT_TRUE(capacity.fault());
	capacity.set(BT_EP_AXIAL, 1, 1);
	EXPECT_FALSE(capacity.hasFibres());
	EXPECT_FALSE(capacity.fault());
}

TEST(SectionFibres, NumbersThatNoFibreCanHave)
{
	const btElasticPlasticCapacity good = btElasticPlasticCapacity::fromRod(
		btElasticPlasticMaterial::steel(btScalar(200e6)),
		btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1)).withFibres(16), 1);
	ASSERT_TRUE(good.hasFibres());
	ASSERT_FALSE(good.fault());
	const btScalar tiny = btElasticPlasticCapacity::leastStiffness() / 2,
				   huge = 2 * btElasticPlasticCapacity::greatestYield();
	const std::function<void(btElasticPlasticCapacity&)> spoils[] = {
		[&](btElasticPlasticCapacity& c) { c.m_fibres[3].m_stiffness = tiny; },
		[&](btElasticPlasticCapacity& c) { c.m_fibres[3].m_stiffness = btScalar(1e25); },
		[&](btElasticPlasticCapacity& c) { c.m_fibres[3].m_tension = huge; },
		[&](btElasticPlasticCapacity& c) { c.m_fibres[3].m_compression = huge; },
		[&](btElasticPlasticCapacity& c) { c.m_fibres[3].m_y = btScalar(1e7); },
		[&](btElasticPlasticCapacity& c) { c.m_fibres[3].m_z = btScalar(-1e30); },
		[&](btElasticPlasticCapacity& c) { c.m_fibres[3].m_twist[1] = btScalar(1e30); },
		[&](btElasticPlasticCapacity& c) { c.m_length = btScalar(1e7); },
		[&](btElasticPlasticCapacity& c) { c.m_stiffness[BT_EP_SHEAR_Z] = btScalar(1e30); },
		[&](btElasticPlasticCapacity& c) { c.m_curvePoints[1].m_factor = huge; },
		// Softens on the way to where it tears: never.
		[&](btElasticPlasticCapacity& c)
		{
			c.m_fibres[3].m_softens = true;
			c.m_fibres[3].m_stretchLimit = btScalar(BT_LARGE_FLOAT);
		},
		// A jump.
		[&](btElasticPlasticCapacity& c) {
			c.m_curvePoints[0] = {std::numeric_limits<btScalar>::denorm_min(), btScalar(1.5)};
		}};
	for (size_t i = 0; i < std::size(spoils); ++i)
	{
		btElasticPlasticCapacity bad = good;
		bad.m_curvePoints.push_back({btScalar(0.01), btScalar(1.1)});
		bad.m_curvePoints.push_back({btScalar(0.02), btScalar(1.2)});
		bad.m_fibres[3].m_numPoints = 2;
		EXPECT_FALSE(bad.fault());
		spoils[i](bad);
		EXPECT_TRUE(bad.fault()) << i;
	}
}

TEST(SectionFibres, WhatWasAddedIsNotLostByCuttingAgain)
{
	const btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(250e6));
	btElasticPlasticSection section =
		btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.2)).withFibres(16).withFibres(36);
	EXPECT_FALSE(section.m_fault);
	section.addBar(0, 0, btScalar(1e-3), steel);
	EXPECT_FALSE(section.m_fault);
	EXPECT_TRUE(section.withFibres(36).m_fault);
	EXPECT_TRUE(section.withFibresFor(btScalar(0.01)).m_fault);
	EXPECT_FALSE(section.m_fault);
}

TEST(SectionFibres, ASectionMayBeAddedToItself)
{
	const btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(250e6));
	btElasticPlasticSection twin = btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.2)).withFibres(16),
							other = twin;
	for (int i = 0; i < 3; ++i)
	{
		const btElasticPlasticSection copy = other;
		other.addPart(copy, btScalar(0.2), 0, steel);
		twin.addPart(twin, btScalar(0.2), 0, steel);
		ASSERT_FALSE(twin.m_fault);
		ASSERT_EQ(other.m_fibres.size(), twin.m_fibres.size());
	}
	for (int i = 0; i < twin.m_fibres.size(); ++i)
	{
		EXPECT_EQ(other.m_fibres[i].m_y, twin.m_fibres[i].m_y);
		EXPECT_EQ(other.m_fibres[i].m_material, twin.m_fibres[i].m_material);
	}
}

TEST(SectionFibres, WhatIsNoArrayIsRefused)
{
	const int three = 3;
	const btElasticPlasticSectionPoint corners[3] = {{0, 0}, {0, 1}, {1, 0}};
	EXPECT_TRUE(btElasticPlasticSection::polygon(nullptr, &three, 1).m_fault);
	EXPECT_TRUE(btElasticPlasticSection::polygon(corners, nullptr, 1).m_fault);
	EXPECT_TRUE(btElasticPlasticSection::bolts(nullptr, 4, btScalar(1e-4)).m_fault);
	EXPECT_TRUE(btElasticPlasticSection::welds(nullptr, 4, btScalar(1e-3)).m_fault);
	const btElasticPlasticCapacity capacity =
		capacityOf(btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.2)).withFibres());
	EXPECT_TRUE(capacity.heated(nullptr, 3).fault());
}

TEST(SectionFibres, WhatIsNoTemperatureIsRefused)
{
	const btElasticPlasticCapacity capacity =
		capacityOf(btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.2)).withFibres());
	for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
							   -std::numeric_limits<double>::infinity()})
	{
		const btScalar t = btScalar(wrong);
		for (const btElasticPlasticHeat& heat :
			 {btElasticPlasticHeat::steel(t), btElasticPlasticHeat::reinforcement(t, true),
			  btElasticPlasticHeat::concrete(t), btElasticPlasticHeat::timber(t),
			  btElasticPlasticHeat::aluminium6061(t), btElasticPlasticHeat::aluminium6082(t)})
			EXPECT_TRUE(capacity.heated(heat).fault()) << wrong;
	}
}

TEST(SectionFibres, AFibreHasADirectionAndAPart)
{
	const btElasticPlasticCapacity capacity = capacityOf(
		btElasticPlasticSection::iSection(btScalar(0.1), btScalar(0.2), btScalar(0.006), btScalar(0.009)).withFibres());
	ASSERT_FALSE(capacity.fault());
	btElasticPlasticCapacity wrong = capacity;
	wrong.m_fibres[3].m_wall[0] = 5;
	EXPECT_TRUE(wrong.fault());
	wrong = capacity;
	wrong.m_fibres[3].m_part = -1;
	EXPECT_TRUE(wrong.fault());
}
}  // namespace testSectionFibres
