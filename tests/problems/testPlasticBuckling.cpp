// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Stocky struts, which buckle as their material flows, against the tangent modulus load.

#include <algorithm>

#include <gtest/gtest.h>

#include "scenes/Strut.h"
#include "support/Run.h"

namespace testPlasticBuckling
{
using namespace ep;

/// The greatest stress at its foot until it is shortened by twice and a half as much as at the exact load.
double press(double slenderness, int parts, double kinematicShare)
{
	const int rate = 240;
	Strut strut(Solver::Direct, slenderness, parts, Strut::Alloy::material(kinematicShare));
	const double strain = 2.5 * Strut::Alloy::strain(Strut::Alloy::bucklingStress(slenderness));
	double most = 0;
	for (int i = 0; i < int(strain / Strut::SHORTENING * rate); ++i)
	{
		strut.push(std::min(1., 10. * i / rate));
		strut.m_world.step(btScalar(1) / rate);
		most = std::max(most, strut.pressureAtFoot());
	}
	return most;
}

TEST(PlasticBuckling, IsAtTheTangentModulusLoad)
{
	// Of Euler's load that is 0.30, 0.58 and 0.87. What is found is 1 to 3 % less: it is crooked by 0.3 to 0.9 mm.
	for (const double slenderness : {30., 45., 60.})
		for (const int parts : {8, 16})
			// Hardening in layers takes its time.
			for (const double kinematicShare : {0., parts == 8 ? 1. : 0.5})
			{
				if (kinematicShare == 0.5 && slenderness != 45)
					continue;
				const double exact = Strut::Alloy::bucklingStress(slenderness);
				EXPECT_NEAR(exact, press(slenderness, parts, kinematicShare), 0.05 * exact)
					<< "slenderness " << slenderness << ", parts " << parts << ", kinematic " << kinematicShare;
			}
}

TEST(PlasticBuckling, AStrutOfOnePartCannot) { EXPECT_GT(press(60, 1, 0), 1.5 * Strut::Alloy::bucklingStress(60)); }
}  // namespace testPlasticBuckling
