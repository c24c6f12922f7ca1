// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_CHART_H
#define EP_VIEWER_CHART_H

#include "drawing/Drawing.h"
#include "drawing/Panel.h"
#include "viewer/Layout.h"

namespace ep
{
/// Draws a chart into a tile; coordinates are the overlay's, pixels from the top left corner.
void drawChart(const Chart& chart, const Tile& tile);

/// The last seconds of a quantity, in a panel: with grid, times before now, and where it yields.
void drawHistory(const Panel::Curve& curve, const Tile& tile);
}  // namespace ep

#endif  // EP_VIEWER_CHART_H
