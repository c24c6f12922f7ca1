// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PICTURE_RASTER_H
#define EP_PICTURE_RASTER_H

#include "picture/Png.h"
#include "picture/Projection.h"

namespace ep
{
/// Draws without OpenGL, for machines without a display: depth buffer, shadow map, four samples a pixel.
Image drawPicture(const View& view, int width, int height);
}  // namespace ep

#endif  // EP_PICTURE_RASTER_H
