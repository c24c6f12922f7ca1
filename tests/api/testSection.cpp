// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Sections against formulas of structural mechanics and the paper's Figure 5.

#include <math.h>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticSection.h"
#include "support/Close.h"

namespace testSection
{
typedef btElasticPlasticSection Section;

const double PI = 3.14159265358979323846;

TEST(Section, Rectangle)
{
	const Section s = Section::rectangle(btScalar(0.1), btScalar(0.3));
	expectClose(0.03, s.m_area);
	expectClose(0.025, s.m_shearArea[0]);
	expectClose(0.03, s.m_plasticShearArea[1]);
	expectClose(0.3 * 1e-3 / 12, s.m_secondMoment[0]);
	expectClose(0.1 * 27e-3 / 12, s.m_secondMoment[1]);
	expectClose(0.3 * 1e-2 / 4, s.m_plasticModulus[0]);
	expectClose(0.1 * 9e-2 / 4, s.m_plasticModulus[1]);
	expectClose(0.15, s.m_outerFibre[0]);
	expectClose(0.05, s.m_outerFibre[1]);
	// Timoshenko and Goodier, section 109: 0.263 for h/b = 3, 0.1406 for a square, printed digits.
	EXPECT_NEAR(0.263, s.m_torsionConstant / (0.3 * 1e-3), 0.0005);
	EXPECT_NEAR(0.1406, Section::rectangle(1, 1).m_torsionConstant, 0.00005);
	// Turned by a right angle it is the same section.
	expectClose(s.m_torsionConstant, Section::rectangle(btScalar(0.3), btScalar(0.1)).m_torsionConstant);
	expectClose(s.m_secondMoment[0], Section::rectangle(btScalar(0.3), btScalar(0.1)).m_secondMoment[1]);
}

TEST(Section, TorsionOfTheRectangleThreeWays)
{
	const double tau = 1e8, b = 0.01;
	const double exact = tau * Section::rectangle(btScalar(b), btScalar(b)).m_plasticTorsionModulus;
	const double paper =
		tau * Section::rectangle(btScalar(b), btScalar(b), BT_EP_TORSION_PAPER).m_plasticTorsionModulus;
	const double polar =
		tau * Section::rectangle(btScalar(b), btScalar(b), BT_EP_TORSION_POLAR).m_plasticTorsionModulus;
	expectClose(tau * b * b * b / 3, exact);
	expectClose(0.19 * b * b * b * 200e6, paper);
	// Figure 5 prints 38.2; the integral is 38.26.
	EXPECT_NEAR(38.2, polar, 0.1);
	EXPECT_NEAR(1.14, paper / exact, 0.005);
	EXPECT_NEAR(1.15, polar / exact, 0.005);
	// Flat: "4.3 to 5.2 times too high at h/b = 10".
	const double flat = Section::rectangle(btScalar(0.01), btScalar(0.1)).m_plasticTorsionModulus;
	expectClose(1e-4 * (0.3 - 0.01) / 6, flat);
	EXPECT_NEAR(4.3,
				Section::rectangle(btScalar(0.01), btScalar(0.1), BT_EP_TORSION_PAPER).m_plasticTorsionModulus / flat,
				0.05);
	EXPECT_NEAR(5.2,
				Section::rectangle(btScalar(0.01), btScalar(0.1), BT_EP_TORSION_POLAR).m_plasticTorsionModulus / flat,
				0.05);
}

/// Integrates over a section that is given as inside(y, z), by midpoints.
template <class Inside>
struct Integrated
{
	double area = 0, second[2] = {0, 0}, plastic[2] = {0, 0};

	Integrated(double width, double height, Inside inside)
	{
		const int n = 2000;
		const double da = width * height / n / n;
		for (int i = 0; i < n; ++i)
			for (int j = 0; j < n; ++j)
			{
				const double y = height * ((i + 0.5) / n - 0.5), z = width * ((j + 0.5) / n - 0.5);
				if (!inside(y, z))
					continue;
				area += da;
				second[0] += z * z * da;
				second[1] += y * y * da;
				plastic[0] += fabs(z) * da;
				plastic[1] += fabs(y) * da;
			}
	}
};

template <class Inside>
void expectIntegrals(const Section& s, double width, double height, Inside inside)
{
	const Integrated<Inside> i(width, height, inside);
	// The grid of 2000 cuts curved edges to 1e-4.
	expectClose(i.area, s.m_area, 1e-3);
	for (int a = 0; a < 2; ++a)
	{
		expectClose(i.second[a], s.m_secondMoment[a], 1e-3);
		expectClose(i.plastic[a], s.m_plasticModulus[a], 1e-3);
	}
}

TEST(Section, IntegralsOverTheShape)
{
	expectIntegrals(Section::rectangle(1, 2), 1, 2, [](double, double) { return true; });
	expectIntegrals(Section::circle(1), 2, 2, [](double y, double z) { return y * y + z * z < 1; });
	expectIntegrals(Section::hollowCircle(1, btScalar(0.25)), 2, 2,
					[](double y, double z) { return y * y + z * z < 1 && y * y + z * z > 0.5625; });
	expectIntegrals(Section::hollowRectangle(1, 2, btScalar(0.1)), 1, 2,
					[](double y, double z) { return fabs(y) > 0.9 || fabs(z) > 0.4; });
	expectIntegrals(Section::iSection(1, 2, btScalar(0.1), btScalar(0.2)), 1, 2,
					[](double y, double z) { return fabs(y) > 0.8 || fabs(z) < 0.05; });
}

TEST(Section, ShearAreasOfAnISection)
{
	// The web takes what runs along y. Each flange is a rectangle for what runs along z: 5/6 of it for stiffness, all of it yields.
	const double b = 0.3, h = 0.5, web = 0.01, flange = 0.02;
	const Section s = Section::iSection(btScalar(b), btScalar(h), btScalar(web), btScalar(flange));
	expectClose((h - 2 * flange) * web, s.m_shearArea[0]);
	expectClose((h - 2 * flange) * web, s.m_plasticShearArea[0]);
	expectClose(2 * Section::rectangle(btScalar(flange), btScalar(b)).m_shearArea[0], s.m_shearArea[1]);
	expectClose(5. / 6 * 2 * b * flange, s.m_shearArea[1]);
	expectClose(2 * b * flange, s.m_plasticShearArea[1]);
}

TEST(Section, RoundAndHollow)
{
	const Section c = Section::circle(btScalar(0.2));
	expectClose(PI * 0.04, c.m_area);
	expectClose(4. / 3 * 0.008, c.m_plasticModulus[0]);
	expectClose(2 * PI / 3 * 0.008, c.m_plasticTorsionModulus);
	expectClose(PI / 2 * 0.0016, c.m_torsionConstant);
	expectClose(6. / 7 * PI * 0.04, c.m_shearArea[1]);
	// Thin tube: half of A for stiffness (Cowper), 2 A / pi yields; Bredt: torsion 2 A_m t tau.
	const Section tube = Section::hollowCircle(1, btScalar(0.001));
	expectClose(0.5 * tube.m_area, tube.m_shearArea[0], 1e-3);
	expectClose(2 / PI * tube.m_area, tube.m_plasticShearArea[0]);
	expectClose(2 * PI * 0.001, tube.m_plasticTorsionModulus, 2e-3);
	// By wall or by inner radius: the same but for the rounding of their difference, which thin walls make large.
	expectClose(tube.m_plasticTorsionModulus, Section::tube(1, btScalar(0.999)).m_plasticTorsionModulus,
				byPrecision(1e-12, 1e-3));
	const Section box = Section::hollowRectangle(1, 2, btScalar(0.001));
	expectClose(2 * 0.999 * 1.999 * 0.001, box.m_plasticTorsionModulus, 2e-3);
	expectClose(2 * 0.001 * pow(0.999 * 1.999, 2) / 2.998, box.m_torsionConstant, 1e-4);
	// Walls that fill the section make it solid.
	expectClose(Section::circle(1).m_plasticTorsionModulus, Section::tube(1, btScalar(0.0001)).m_plasticTorsionModulus,
				1e-6);
	expectClose(Section::rectangle(1, 2).m_plasticTorsionModulus,
				Section::hollowRectangle(1, 2, btScalar(0.49999)).m_plasticTorsionModulus, 1e-4);
}
}  // namespace testSection
