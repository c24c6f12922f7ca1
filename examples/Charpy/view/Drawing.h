// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_DRAWING_H
#define EP_CHARPY_DRAWING_H

#include "test/ImpactTest.h"
#include "drawing/Drawing.h"

namespace ep::charpy
{
/// The viewer is made for things of a building's size: it gets a metre for each centimetre.
constexpr double DRAWN_PER_METRE = 100;

/// Height of the blow above the drawing's ground, drawn length.
constexpr double DRAWN_LEVEL = 30;

/// The test as it stands, drawn larger than it is.
/// \param cut  hammer and anvils only up to just above the specimen, which they hide otherwise
std::vector<Part> partsOf(const ImpactTest& charpy, bool cut);

/// Around the specimen, straight from above, and the machine as a whole.
enum Viewpoint
{
	DETAIL,
	PLAN,
	OVERVIEW
};
/// \param cut  in the first two
std::vector<View> viewsOf(const ImpactTest& charpy, bool cut);
}  // namespace ep::charpy

#endif  // EP_CHARPY_DRAWING_H
