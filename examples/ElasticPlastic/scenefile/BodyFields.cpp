// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/MeshFile.h"
#include "scenefile/SceneBuilder.h"

namespace ep
{
namespace
{
using Shape = SceneDescription::Shape;
using ShapeKind = SceneDescription::ShapeKind;
using Motion = SceneDescription::Motion;

const std::vector<Named<Motion>>& motions()
{
	static const std::vector<Named<Motion>> all = {
		{"dynamic", Motion::Dynamic}, {"static", Motion::Static}, {"kinematic", Motion::Kinematic}};
	return all;
}

void roundField(Fields& f, const char* key, ShapeKind kind, const char* help, Shape& shape)
{
	std::vector<double> v;
	if (f.numbers(key, v, 2, 2, {1e-4, 1e4}, "m", help) && v.size() == 2)
	{
		shape.kind = kind;
		shape.size.setValue(btScalar(v[0]), btScalar(v[1]), 0);
	}
}

void pointsField(Fields& f, const char* key, ShapeKind kind, size_t least, size_t most, const char* help, Shape& shape)
{
	std::vector<double> v;
	if (!f.numbers(key, v, 3 * least, 3 * most, Range::place(), "m", help) || v.empty())
		return;
	if (v.size() % 3 != 0 || (kind == ShapeKind::Mesh && v.size() % 9 != 0))
		return f.refuse(key, "has " + std::to_string(v.size()) + " numbers; a point has 3, and a triangle 3 points");
	shape.kind = kind;
	for (size_t i = 0; i < v.size(); i += 3)
		shape.points.emplace_back(btScalar(v[i]), btScalar(v[i + 1]), btScalar(v[i + 2]));
}

/// What a part of a compound can be, too.
void simpleShapeFields(Fields& f, Shape& shape)
{
	btVector3 size(1, 1, 1);
	double radius = 0;
	if (f.vector("box", size, "m", "sizes along x, y and z", Need::Optional, {1e-4, 1e4}))
	{
		shape.kind = ShapeKind::Box;
		shape.size = size;
	}
	if (f.number("sphere", radius, {1e-4, 1e4}, "m", "radius") && radius > 0)
	{
		shape.kind = ShapeKind::Sphere;
		shape.size.setValue(btScalar(radius), 0, 0);
	}
	roundField(f, "cylinder", ShapeKind::Cylinder, "radius and length, along y", shape);
	roundField(f, "capsule", ShapeKind::Capsule, "radius and length of the straight part, along y", shape);
	pointsField(f, "hull", ShapeKind::Hull, 4, 100, "points of a convex body: x, y, z, x, y, z ...", shape);
}

void shapeFields(Fields& f, Shape& shape)
{
	simpleShapeFields(f, shape);
	pointsField(f, "mesh", ShapeKind::Mesh, 3, 10000, "triangles of a static body: three points each", shape);
	std::string file;
	if (f.file("mesh_file", file, "glTF file with a static body, .glb or .gltf, in the body's axes"))
	{
		shape.kind = ShapeKind::Mesh;
		const std::string fault = file.empty() ? "" : readMeshFile(file, shape.points);
		if (!fault.empty())
			f.refuse("mesh_file", "is \"" + file + "\", which " + fault);
	}
	if (f.list("compound", 100, "a body of several parts",
			   [&](Fields& inner)
			   {
				   Shape::Part part;
				   simpleShapeFields(inner, part.shape);
				   inner.oneOf({"box", "sphere", "cylinder", "capsule", "hull"});
				   poseFields(inner, part.pose);
				   shape.parts.push_back(part);
			   }))
	{
		shape.kind = ShapeKind::Compound;
		if (shape.parts.empty())
			f.refuse("compound", "has no parts");
	}
	f.oneOf({"box", "sphere", "cylinder", "capsule", "hull", "compound", "mesh", "mesh_file"});
}

void pathField(Fields& f, SceneDescription::Body& body)
{
	const bool isThere = f.list("path", 1000, "where a kinematic body is at times, straight between them",
								[&](Fields& inner)
								{
									double time = 0;
									btVector3 place(0, 0, 0);
									inner.number("time", time, {0, 1e5}, "s", "since the beginning", Need::Required);
									inner.vector("at", place, "m", "place", Need::Required);
									if (!body.path.empty() && time <= body.path.back().first)
										inner.refuse("time", "is not after the one before it");
									body.path.emplace_back(time, place);
								});
	if (isThere && body.motion != Motion::Kinematic)
		f.refuse("path", "is only for a body whose motion is kinematic");
}
}  // namespace

void poseFields(Fields& f, btTransform& pose)
{
	btVector3 place(0, 0, 0);
	std::vector<double> turn;
	if (f.vector("at", place, "m", "place"))
		pose.setOrigin(place);
	if (!f.numbers("turn", turn, 4, 4, {-1e4, 1e4}, "", "axis and angle in degrees: x, y, z, angle") ||
		turn.size() != 4)
		return;
	const btVector3 axis{btScalar(turn[0]), btScalar(turn[1]), btScalar(turn[2])};
	if (axis.length() < btScalar(1e-6))
		return f.refuse("turn", "has an axis without length");
	pose.setRotation(btQuaternion(axis.normalized(), btRadians(btScalar(turn[3]))));
}

void bodyFields(Fields& f, SceneBuilder& builder)
{
	SceneDescription::Body b;
	f.text("name", b.name, "by which it is found", Need::Required);
	shapeFields(f, b.shape);
	poseFields(f, b.pose);
	f.named("motion", b.motion, motions(), "moved by forces, not at all, or along its path");
	SceneDescription::Material material;
	if (materialField(f, "material", builder, material))
	{
		b.density = double(material.law.m_density);
		b.colour = material.colour;
	}
	f.number("density", b.density, {0, 1e6, true}, "kg/m^3", "of the shape, else by the material");
	f.number("mass", b.mass, {0, 1e12, true}, "kg", "else by the density");
	f.vector("velocity", b.velocity, "m/s", "at the beginning", Need::Optional, {-1e5, 1e5});
	f.vector("spin", b.spin, "rad/s", "at the beginning", Need::Optional, {-1e4, 1e4});
	f.number("friction", b.friction, {0, 100}, "", "is multiplied with that of what it touches");
	f.number("restitution", b.restitution, {0, 1}, "", "is multiplied with that of what it touches");
	f.number("rolling_friction", b.rollingFriction, {0, 100}, "", "as Bullet has it");
	f.flag("collides", b.collides, "with other bodies");
	f.number("appears", b.appears, {0, 1e5}, "s", "time at which it comes into the world");
	f.vector("colour", b.colour, "", "red, green and blue, linear", Need::Optional, {0, 1});
	pathField(f, b);
	if (b.shape.kind == ShapeKind::Mesh && b.motion != Motion::Static)
		f.refuse("", "has a mesh, which is for a body whose motion is static; others are convex or compound");
	if (b.appears > 0 && b.motion != Motion::Dynamic)
		f.refuse("appears", "is for a body that is moved by forces");
	builder.add(f, b);
}
}  // namespace ep
