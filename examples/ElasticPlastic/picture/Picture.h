// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PICTURE_PICTURE_H
#define EP_PICTURE_PICTURE_H

#include "drawing/Drawing.h"
#include "picture/Png.h"

namespace ep
{
/// Without a window, as the window draws. Throws std::runtime_error if there is no OpenGL.
Image drawPicture(const View& view, int width, int height);
}  // namespace ep

#endif  // EP_PICTURE_PICTURE_H
