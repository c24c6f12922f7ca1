// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <gtest/gtest.h>

#include "viewer/Quality.h"

namespace testQuality
{
using namespace ep;

void draw(Quality& quality, int pictures, double seconds)
{
	for (int i = 0; i < pictures; ++i)
		quality.drawn(seconds);
}

TEST(Quality, FallsStepByStepWhereDrawingIsSlow)
{
	Quality quality;
	draw(quality, 1000, .9 * Quality::SLOWEST);
	EXPECT_EQ(Quality::FINE, quality.level());
	draw(quality, Quality::PICTURES - 1, 2 * Quality::SLOWEST);
	EXPECT_EQ(Quality::FINE, quality.level());
	draw(quality, 1, 2 * Quality::SLOWEST);
	EXPECT_EQ(Quality::PLAIN, quality.level());
	// Quick enough now, and it stays so.
	draw(quality, 1000, .5 * Quality::SLOWEST);
	EXPECT_EQ(Quality::PLAIN, quality.level());
	draw(quality, 10 * Quality::PICTURES, 2 * Quality::SLOWEST);
	EXPECT_EQ(Quality::COARSE, quality.level());
}

TEST(Quality, OneSlowPictureIsNothing)
{
	Quality quality;
	for (int i = 0; i < 100; ++i)
	{
		quality.drawn(5 * Quality::SLOWEST);
		draw(quality, Quality::PICTURES - 1, .5 * Quality::SLOWEST);
	}
	EXPECT_EQ(Quality::FINE, quality.level());
}
}  // namespace testQuality
