// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_DRAW_FIGURE_H
#define EP_VIEWER_DRAW_FIGURE_H

#include "drawing/Figure.h"
#include "viewer/Layout.h"

namespace ep
{
/// Draws a figure into a tile, as large as it fits.
void drawFigure(const Figure& figure, const Tile& tile);
}  // namespace ep

#endif  // EP_VIEWER_DRAW_FIGURE_H
