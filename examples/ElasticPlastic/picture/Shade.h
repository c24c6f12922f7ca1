// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PICTURE_SHADE_H
#define EP_PICTURE_SHADE_H

#include <functional>

#include "picture/Projection.h"

namespace ep
{
/// How much of the sun reaches a point of the world, 0 to 1.
using SunLight = std::function<float(const Vector& point, const Vector& normal)>;

// The light of things, linear. The viewer's shaders (viewer/Shaders.cpp) say the same in their language.

/// A point of a part, seen from the eye.
Vector shadeSurface(const Vertex& surface, const Vector& eye, const SunLight& sun);

/// What is seen along a direction where no part is: sky or ground.
Vector shadeBackground(const Vector& eye, const Vector& direction, const SunLight& sun);

/// Linear light to a pixel's value, 0 to 255.
unsigned char displayValue(float light);
}  // namespace ep

#endif  // EP_PICTURE_SHADE_H
