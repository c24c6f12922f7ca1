// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SHAPES_H
#define EP_SHAPES_H

#include "scenefile/SceneDescription.h"
#include "world/World.h"

namespace ep
{
/// Volume, centre and moments of inertia of a body whose density is 1.
struct Solid
{
	double volume = 0;
	btVector3 centre = btVector3(0, 0, 0);
	btMatrix3x3 inertia = btMatrix3x3(0, 0, 0, 0, 0, 0, 0, 0, 0);  ///< about the centre
};

/// A shape whose origin is the centre of mass and whose axes are the principal ones, as Bullet wants it.
struct CentredShape
{
	btCollisionShape* shape = nullptr;
	btTransform centre = btTransform::getIdentity();  ///< in the frame of the description
	double volume = 0;                                ///< 0 for a mesh, which has none
	btVector3 inertia = btVector3(0, 0, 0);           ///< about the principal axes, with density 1

	/// What went wrong: a hull without volume. Empty: nothing.
	std::string fault;
};

/// Throws nothing; the world keeps the shape.
CentredShape makeShape(World& world, const SceneDescription::Shape& shape,
					   std::vector<std::unique_ptr<btTriangleMesh>>& meshes);

/// A box whose own axes are those of a vehicle: x left, y up, z forward, while in a description x is forward.
/// \param size  in its own axes
CentredShape makeChassis(World& world, const btVector3& size);

/// Of a polyhedron that is convex, by its points.
Solid solidOfHull(const std::vector<btVector3>& points);
}  // namespace ep

#endif  // EP_SHAPES_H
