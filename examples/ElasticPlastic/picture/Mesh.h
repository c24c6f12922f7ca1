// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PICTURE_MESH_H
#define EP_PICTURE_MESH_H

#include <array>
#include <vector>

#include "drawing/Drawing.h"

namespace ep
{
using Vector = std::array<float, 3>;

inline Vector toVector(const btVector3& v) { return {float(v.x()), float(v.y()), float(v.z())}; }

/// A corner of a triangle, world coordinates.
struct Vertex
{
	Vector position;
	Vector normal;
	Vector colour;
	std::array<float, 4>
		edges;  ///< distances from the edges of its face: left, right, bottom, top [m]; edges look darker
	float gloss;
};

/// The triangles of parts and skins, three vertices each.
std::vector<Vertex> makeMesh(const std::vector<Part>& parts, const std::vector<Skin>& skins = {});

/// Squares that face the eye, the furthest first, of which the first two edges run from -1 to 1 and the third is the opacity.
std::vector<Vertex> makeMesh(std::vector<Puff> puffs, const Camera& camera);
}  // namespace ep

#endif  // EP_PICTURE_MESH_H
