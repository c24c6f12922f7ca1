// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What one force can be by itself, by sums that are known.

#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/section/CellStrength.h"

namespace testCellStrength
{
using namespace btElasticPlastic;

TEST(CellStrength, OfWhatIsSymmetricIsASumWhereCellsAreOnAnAxis)
{
	// Four cells at (+-1, +-2) of 3, and two on either axis of 5. A search for the other two stretches, which are 0, has the sums to some digits only, and takes a thousand times
	// as long.
	std::vector<Cell> cells;
	for (const double sign : {-1., 1.})
	{
		cells.push_back({sign, 2, 3, 3});
		cells.push_back({sign, -2, 3, 3});
		cells.push_back({sign * 0.7, 0, 5, 5});
		cells.push_back({0, sign * 0.9, 5, 5});
	}
	EXPECT_DOUBLE_EQ(4 * 3 + 4 * 5, strengthAlone(cells, AXIAL_FORCE));
	EXPECT_DOUBLE_EQ(4 * 3 * 2 + 2 * 5 * 0.9, strengthAlone(cells, MOMENT_Y));
	EXPECT_DOUBLE_EQ(4 * 3 * 1 + 2 * 5 * 0.7, strengthAlone(cells, MOMENT_Z));
}

TEST(CellStrength, OfWhatIsWeakerInTensionIsByItself)
{
	// Two cells, of which one is on the axis: it makes up for what the pressed one bears more than the pulled one would.
	const std::vector<Cell> cells = {{-1, 0, 1, 4}, {0, 0, 1, 4}, {1, 0, 1, 4}};
	// In one direction 1 is pulled and 1 pressed by 2, of which the one on the axis takes 1.
	EXPECT_NEAR(3, strengthAlone(cells, MOMENT_Z), 1e-6);
	EXPECT_NEAR(12, strengthAlone(cells, AXIAL_FORCE), 1e-6);
}
}  // namespace testCellStrength
