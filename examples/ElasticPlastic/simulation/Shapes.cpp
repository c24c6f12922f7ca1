// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "simulation/Shapes.h"

#include "simulation/Hull.h"

namespace ep
{
namespace
{
using Shape = SceneDescription::Shape;
using ShapeKind = SceneDescription::ShapeKind;

btMatrix3x3 diagonal(double x, double y, double z)
{
	return btMatrix3x3(btScalar(x), 0, 0, 0, btScalar(y), 0, 0, 0, btScalar(z));
}

btMatrix3x3 outer(const btVector3& a, const btVector3& b)
{
	return btMatrix3x3(a.x() * b.x(), a.x() * b.y(), a.x() * b.z(), a.y() * b.x(), a.y() * b.y(), a.y() * b.z(),
					   a.z() * b.x(), a.z() * b.y(), a.z() * b.z());
}

btMatrix3x3 scaled(const btMatrix3x3& m, double by)
{
	const btScalar s = btScalar(by);
	return btMatrix3x3(m[0].x() * s, m[0].y() * s, m[0].z() * s, m[1].x() * s, m[1].y() * s, m[1].z() * s, m[2].x() * s,
					   m[2].y() * s, m[2].z() * s);
}

/// What a mass at a point has about the origin, more than about itself (Steiner).
btMatrix3x3 steiner(const btVector3& r, double mass)
{
	return scaled(diagonal(1, 1, 1), double(r.length2()) * mass) - scaled(outer(r, r), mass);
}

/// Inertia of a shape of Bullet's own kinds, exactly: Bullet itself takes some for boxes.
Solid solidOf(const Shape& s)
{
	const double pi = double(SIMD_PI), r = double(s.size.x()), h = double(s.size.y());
	Solid solid;
	switch (s.kind)
	{
		case ShapeKind::Box:
		{
			const double x = r, y = h, z = double(s.size.z());
			solid.volume = x * y * z;
			solid.inertia = scaled(diagonal(y * y + z * z, x * x + z * z, x * x + y * y), solid.volume / 12);
			break;
		}
		case ShapeKind::Sphere:
			solid.volume = 4. / 3 * pi * r * r * r;
			solid.inertia = scaled(diagonal(1, 1, 1), .4 * r * r * solid.volume);
			break;
		case ShapeKind::Cylinder:
		case ShapeKind::Capsule:
		{
			const double tube = pi * r * r * h, ends = s.kind == ShapeKind::Capsule ? 4. / 3 * pi * r * r * r : 0;
			const double across = tube * (r * r / 4 + h * h / 12) + ends * (.4 * r * r + h * h / 4 + 3. / 8 * h * r);
			solid.volume = tube + ends;
			solid.inertia = diagonal(across, tube * r * r / 2 + ends * .4 * r * r, across);
			break;
		}
		case ShapeKind::Hull:
			return solidOfHull(s.points);
		case ShapeKind::Compound:
		case ShapeKind::Mesh:
			break;
	}
	return solid;
}

btCollisionShape* simpleShape(World& world, const Shape& s, const btTransform& toCentre)
{
	const btVector3& v = s.size;
	switch (s.kind)
	{
		case ShapeKind::Sphere:
			return world.keep(new btSphereShape(v.x()));
		case ShapeKind::Cylinder:
			return world.keep(new btCylinderShape(btVector3(v.x(), v.y() / 2, v.x())));
		case ShapeKind::Capsule:
			return world.keep(new btCapsuleShape(v.x(), v.y()));
		case ShapeKind::Hull:
		{
			auto* const hull = new btConvexHullShape();
			for (const btVector3& point : s.points)
				hull->addPoint(toCentre * point, false);
			hull->setMargin(0);
			hull->recalcLocalAabb();
			btVector3 low, high;
			hull->getAabb(btTransform::getIdentity(), low, high);
			// A hull reaches past its points by its margin, and Bullet's own of 4 cm is much on what is small.
			const btVector3 size = high - low;
			hull->setMargin(btMin(CONVEX_DISTANCE_MARGIN, size[size.minAxis()] / 100));
			hull->recalcLocalAabb();
			return world.keep(hull);
		}
		case ShapeKind::Box:
		case ShapeKind::Compound:
		case ShapeKind::Mesh:
			break;
	}
	return world.box(v);
}

/// Turns a solid to its principal axes.
CentredShape principal(const Solid& solid)
{
	CentredShape shape;
	shape.volume = solid.volume;
	btMatrix3x3 inertia = solid.inertia, turn = btMatrix3x3::getIdentity();
	inertia.diagonalize(turn, btScalar(1e-6), 50);
	shape.centre = btTransform(turn, solid.centre);
	shape.inertia.setValue(inertia[0].x(), inertia[1].y(), inertia[2].z());
	if (!(solid.volume > 1e-12) || !(shape.inertia[shape.inertia.minAxis()] > 0))
		shape.fault = "has no volume";
	return shape;
}

CentredShape makeCompound(World& world, const Shape& s)
{
	Solid all;
	std::vector<Solid> solids;
	btVector3 moment(0, 0, 0);
	for (const Shape::Part& part : s.parts)
	{
		solids.push_back(solidOf(part.shape));
		all.volume += solids.back().volume;
		moment += part.pose * solids.back().centre * btScalar(solids.back().volume);
	}
	if (all.volume > 0)
		all.centre = moment / btScalar(all.volume);
	for (size_t i = 0; i < solids.size(); ++i)
	{
		const btMatrix3x3& turn = s.parts[i].pose.getBasis();
		all.inertia += turn * solids[i].inertia * turn.transpose() +
					   steiner(s.parts[i].pose * solids[i].centre - all.centre, solids[i].volume);
	}
	CentredShape shape = principal(all);
	auto* const compound = new btCompoundShape();
	shape.shape = world.keep(compound);
	for (const Shape::Part& part : s.parts)
		compound->addChildShape(shape.centre.inverse() * part.pose,
								simpleShape(world, part.shape, btTransform::getIdentity()));
	return shape;
}

CentredShape makeMesh(World& world, const Shape& s, std::vector<std::unique_ptr<btTriangleMesh>>& meshes)
{
	meshes.push_back(std::make_unique<btTriangleMesh>());
	for (size_t i = 0; i + 2 < s.points.size(); i += 3)
		meshes.back()->addTriangle(s.points[i], s.points[i + 1], s.points[i + 2]);
	CentredShape shape;
	shape.shape = world.keep(new btBvhTriangleMeshShape(meshes.back().get(), true));
	return shape;
}
}  // namespace

Solid solidOfHull(const std::vector<btVector3>& points)
{
	// Tetrahedra from a corner to each triangle of the surface; second moments about that corner.
	Solid solid;
	btMatrix3x3 second = diagonal(0, 0, 0);
	btVector3 moment(0, 0, 0);
	const btVector3 origin = points[0];
	for (const auto& triangle : hullTriangles(points))
	{
		const btVector3 a = triangle[0] - origin, b = triangle[1] - origin, c = triangle[2] - origin, sum = a + b + c;
		const double volume = double(a.dot(b.cross(c))) / 6;
		solid.volume += volume;
		moment += sum * btScalar(volume / 4);
		second += scaled(outer(a, a) + outer(b, b) + outer(c, c) + outer(sum, sum), volume / 20);
	}
	if (!(solid.volume > 0))
		return solid;
	const btVector3 middle = moment / btScalar(solid.volume);
	solid.centre = origin + middle;
	second -= scaled(outer(middle, middle), solid.volume);
	const double trace = double(second[0].x() + second[1].y() + second[2].z());
	solid.inertia = diagonal(trace, trace, trace) - second;
	return solid;
}

CentredShape makeChassis(World& world, const btVector3& size)
{
	Shape box;
	box.size = size;
	const Solid solid = solidOf(box);
	CentredShape shape;
	shape.shape = world.box(size);
	shape.centre.setRotation(btQuaternion(btVector3(0, 1, 0), SIMD_HALF_PI));
	shape.volume = solid.volume;
	shape.inertia.setValue(solid.inertia[0].x(), solid.inertia[1].y(), solid.inertia[2].z());
	return shape;
}

CentredShape makeShape(World& world, const SceneDescription::Shape& s,
					   std::vector<std::unique_ptr<btTriangleMesh>>& meshes)
{
	if (s.kind == ShapeKind::Compound)
		return makeCompound(world, s);
	if (s.kind == ShapeKind::Mesh)
		return makeMesh(world, s, meshes);
	CentredShape shape = principal(solidOf(s));
	if (shape.fault.empty())
		shape.shape = simpleShape(world, s, shape.centre.inverse());
	return shape;
}
}  // namespace ep
