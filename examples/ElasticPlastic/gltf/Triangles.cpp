// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "gltf/Triangles.h"

#include "simulation/Hull.h"

namespace ep
{
namespace
{
using Shape = SceneDescription::Shape;
using ShapeKind = SceneDescription::ShapeKind;

const int SIDES = 24;  // of a circle

void add(Triangles& all, const btVector3 (&corners)[3], const btVector3 (&normals)[3])
{
	for (int i = 0; i < 3; ++i)
	{
		all.corners.push_back(corners[i]);
		all.normals.push_back(normals[i]);
	}
}

/// Flat; what has no area is left out.
void addFlat(Triangles& all, const btVector3& a, const btVector3& b, const btVector3& c)
{
	const btVector3 normal = (b - a).cross(c - a);
	if (normal.length() > SIMD_EPSILON)
		add(all, {a, b, c}, {normal.normalized(), normal.normalized(), normal.normalized()});
}

/// A corner of the outline of a body that is round about y.
struct OutlinePoint
{
	btScalar radius, y;
	btScalar normalRadius, normalY;
};

btVector3 turned(btScalar radius, btScalar y, int side)
{
	const btScalar angle = SIMD_2_PI * btScalar(side % SIDES) / SIDES;
	return btVector3(radius * btCos(angle), y, -radius * btSin(angle));
}

/// Between two points of the outline, the lower one first.
void addRing(Triangles& all, const OutlinePoint& low, const OutlinePoint& high)
{
	for (int side = 0; side < SIDES; ++side)
	{
		const btVector3 corner[] = {turned(low.radius, low.y, side), turned(low.radius, low.y, side + 1),
									turned(high.radius, high.y, side + 1), turned(high.radius, high.y, side)};
		const btVector3 normal[] = {
			turned(low.normalRadius, low.normalY, side), turned(low.normalRadius, low.normalY, side + 1),
			turned(high.normalRadius, high.normalY, side + 1), turned(high.normalRadius, high.normalY, side)};
		if (low.radius > 0)
			add(all, {corner[0], corner[1], corner[2]}, {normal[0], normal[1], normal[2]});
		if (high.radius > 0)
			add(all, {corner[0], corner[2], corner[3]}, {normal[0], normal[2], normal[3]});
	}
}

/// A ball that is cut in two halves with a tube between them; length 0: a ball.
void addCapsule(Triangles& all, btScalar radius, btScalar length)
{
	const int rings = SIDES / 4;
	std::vector<OutlinePoint> outline;
	for (int half : {-1, 1})
		for (int i = 0; i <= rings; ++i)
		{
			const btScalar angle = SIMD_HALF_PI * btScalar(half < 0 ? i - rings : i) / rings;
			const bool isPole = half < 0 ? i == 0 : i == rings;
			outline.push_back({isPole ? 0 : radius * btCos(angle), radius * btSin(angle) + length / 2 * btScalar(half),
							   btCos(angle), btSin(angle)});
		}
	for (size_t i = 0; i + 1 < outline.size(); ++i)
		if (outline[i + 1].y > outline[i].y)
			addRing(all, outline[i], outline[i + 1]);
}

void addCylinder(Triangles& all, btScalar radius, btScalar length)
{
	const btScalar end = length / 2;
	addRing(all, {0, -end, 0, -1}, {radius, -end, 0, -1});
	addRing(all, {radius, -end, 1, 0}, {radius, end, 1, 0});
	addRing(all, {radius, end, 0, 1}, {0, end, 0, 1});
}

void addHull(Triangles& all, const std::vector<btVector3>& points)
{
	for (const auto& triangle : hullTriangles(points))
		addFlat(all, triangle[0], triangle[1], triangle[2]);
}

std::vector<btVector3> cornersOf(const btVector3& size)
{
	std::vector<btVector3> corners;
	for (int i = 0; i < 8; ++i)
		corners.push_back(size / 2 * btVector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
	return corners;
}
}  // namespace

Triangles trianglesOf(const Shape& s)
{
	Triangles all;
	switch (s.kind)
	{
		case ShapeKind::Box:
			addHull(all, cornersOf(s.size));
			break;
		case ShapeKind::Sphere:
			addCapsule(all, s.size.x(), 0);
			break;
		case ShapeKind::Capsule:
			addCapsule(all, s.size.x(), s.size.y());
			break;
		case ShapeKind::Cylinder:
			addCylinder(all, s.size.x(), s.size.y());
			break;
		case ShapeKind::Hull:
			addHull(all, s.points);
			break;
		case ShapeKind::Compound:
			for (const Shape::Part& part : s.parts)
			{
				const Triangles inner = trianglesOf(part.shape);
				for (size_t i = 0; i < inner.corners.size(); ++i)
				{
					all.corners.push_back(part.pose * inner.corners[i]);
					all.normals.push_back(part.pose.getBasis() * inner.normals[i]);
				}
			}
			break;
		case ShapeKind::Mesh:
			for (size_t i = 0; i + 2 < s.points.size(); i += 3)
				addFlat(all, s.points[i], s.points[i + 1], s.points[i + 2]);
			break;
	}
	return all;
}
}  // namespace ep
