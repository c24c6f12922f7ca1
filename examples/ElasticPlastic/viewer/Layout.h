// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_LAYOUT_H
#define EP_VIEWER_LAYOUT_H

#include <cstddef>
#include <vector>

#include "picture/Tile.h"

namespace ep
{
/// Where in a window things go: the first view large, the others beside it one above the other, below them the chart.
struct Layout
{
	Layout(size_t numViews, bool hasChart, int width, int height);

	std::vector<Tile> views;
	Tile chart;  ///< over the view if there is but one
};
}  // namespace ep

#endif  // EP_VIEWER_LAYOUT_H
