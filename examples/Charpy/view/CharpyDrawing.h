// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_DRAWING_H
#define EP_CHARPY_DRAWING_H

#include "test/Charpy.h"
#include "drawing/Drawing.h"

namespace ep
{
/// The viewer is made for things of a building's size: it gets a metre for each centimetre.
constexpr double CHARPY_DRAWN_PER_METRE = 100;

/// Height of the blow above the drawing's ground, drawn length.
constexpr double CHARPY_DRAWN_LEVEL = 30;

/// The test as it stands, drawn larger than it is.
/// \param cut  hammer and anvils only up to just above the specimen, which they hide otherwise
std::vector<Part> charpyParts(const Charpy& charpy, bool cut);

/// Around the specimen, straight from above, and the machine as a whole.
enum CharpyView
{
	CHARPY_DETAIL,
	CHARPY_PLAN,
	CHARPY_OVERVIEW
};
/// \param cut  in the first two
std::vector<View> charpyViews(const Charpy& charpy, bool cut);
}  // namespace ep

#endif  // EP_CHARPY_DRAWING_H
