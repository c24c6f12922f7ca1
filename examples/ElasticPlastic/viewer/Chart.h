// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_CHART_H
#define EP_VIEWER_CHART_H

#include "drawing/Drawing.h"
#include "viewer/Layout.h"

namespace ep
{
/// Draws a chart with its grid into a tile; coordinates are the overlay's, pixels from the top left corner.
void drawChart(const Chart& chart, const Tile& tile);
}  // namespace ep

#endif  // EP_VIEWER_CHART_H
