// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TRIANGLES_H
#define EP_TRIANGLES_H

#include <vector>

#include "scenefile/SceneDescription.h"

namespace ep
{
/// A surface of triangles, three corners each, counter-clockwise seen from outside.
struct Triangles
{
	std::vector<btVector3> corners, normals;
};

/// The surface of a shape in its own frame. What is round has sides of 15 degrees, and normals as if it were round.
Triangles trianglesOf(const SceneDescription::Shape& shape);
}  // namespace ep

#endif  // EP_TRIANGLES_H
