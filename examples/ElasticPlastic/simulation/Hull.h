// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_HULL_H
#define EP_HULL_H

#include <array>
#include <vector>

#include "LinearMath/btVector3.h"

namespace ep
{
/// The surface of the convex hull of some points, counter-clockwise seen from outside.
std::vector<std::array<btVector3, 3>> hullTriangles(const std::vector<btVector3>& points);
}  // namespace ep

#endif  // EP_HULL_H
