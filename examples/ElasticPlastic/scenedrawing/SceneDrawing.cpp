// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenedrawing/SceneDrawing.h"

#include <algorithm>
#include <cmath>

#include "text/Format.h"
#include "world/JointReading.h"

namespace ep
{
namespace
{
using Shape = SceneDescription::Shape;
using ShapeKind = SceneDescription::ShapeKind;

const Colour TYRE = {.028f, .028f, .03f};
const int SLICES = 10;  // of what has any form

Colour toColour(const btVector3& c) { return {float(c.x()), float(c.y()), float(c.z())}; }

/// Parts are drawn out along z, Bullet's cylinders stand along y.
btTransform upright(const btTransform& pose)
{
	return pose * btTransform(btQuaternion(btVector3(1, 0, 0), -SIMD_HALF_PI), btVector3(0, 0, 0));
}

/// Counter-clockwise, by Andrew's monotone chain.
std::vector<btVector3> convexHull(std::vector<btVector3> points)
{
	std::sort(points.begin(), points.end(),
			  [](const btVector3& a, const btVector3& b)
			  { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
	const auto turnsLeft = [](const btVector3& a, const btVector3& b, const btVector3& c)
	{ return (b - a).cross(c - a).z() > 0; };
	std::vector<btVector3> hull;
	for (int side = 0; side < 2; ++side)
	{
		const size_t begin = hull.size();
		for (const btVector3& point : points)
		{
			while (hull.size() >= begin + 2 && !turnsLeft(hull[hull.size() - 2], hull.back(), point))
				hull.pop_back();
			hull.push_back(point);
		}
		hull.pop_back();
		std::reverse(points.begin(), points.end());
	}
	return hull;
}

/// A convex body in slices: where the lines between its points go through the middle plane of each.
void addHull(std::vector<Part>& parts, const std::vector<btVector3>& points, const btTransform& pose,
			 const Colour& colour)
{
	btScalar low = points[0].z(), high = low;
	for (const btVector3& p : points)
	{
		low = btMin(low, p.z());
		high = btMax(high, p.z());
	}
	const btScalar width = (high - low) / SLICES;
	for (int i = 0; i < SLICES; ++i)
	{
		const btScalar z = low + width * (btScalar(i) + btScalar(.5));
		std::vector<btVector3> crossing;
		for (const btVector3& a : points)
			for (const btVector3& b : points)
				if (a.z() < z && b.z() >= z)
				{
					const btVector3 p = a.lerp(b, (z - a.z()) / (b.z() - a.z()));
					crossing.emplace_back(p.x(), p.y(), btScalar(0));
				}
		const std::vector<btVector3> profile = crossing.size() < 3 ? crossing : convexHull(crossing);
		if (profile.size() >= 3)
			parts.push_back(
				prismPart(pose * btTransform(btQuaternion(0, 0, 0, 1), btVector3(0, 0, z)), profile, width, colour));
	}
}

void addTriangle(std::vector<Part>& parts, const btVector3* corners, const btTransform& pose, const Colour& colour)
{
	const btScalar thickness = btScalar(.002);
	const btVector3 along = corners[1] - corners[0], normal = along.cross(corners[2] - corners[0]);
	if (normal.length() < SIMD_EPSILON)
		return;
	const btVector3 x = along.normalized(), z = normal.normalized(), y = z.cross(x);
	const btTransform frame(btMatrix3x3(x.x(), y.x(), z.x(), x.y(), y.y(), z.y(), x.z(), y.z(), z.z()), corners[0]);
	std::vector<btVector3> profile;
	for (int i = 0; i < 3; ++i)
		profile.push_back(frame.inverse() * corners[i]);
	parts.push_back(prismPart(pose * frame, profile, thickness, colour));
}

/// A band round the member, a little more than it is thick.
void addJoint(std::vector<Part>& parts, const Simulation& s, int index)
{
	const SceneDescription::Joint& joint = s.scene().joints[size_t(index)];
	const btElasticPlasticJoint* const built = s.joint(index);
	if (!built || s.isBroken(index) || s.isCut(index) || joint.height <= 0)
		return;
	const JointReading reading = readJoint(s.world(), *built);
	const double thin = std::min(.05, .08 * std::min(joint.height, joint.width)), more = 1.02;
	// On the second body, or on the first if that is the world.
	const btTransform frame = joint.bodies[1] == SceneDescription::WORLD ? built->getFrameA() : built->getFrameB();
	parts.push_back(boxPart(frame,
							btVector3(btScalar(thin), btScalar(joint.height * more), btScalar(joint.width * more)),
							jointColour(reading.utilisation, reading.damage)));
}
}  // namespace

void addShape(std::vector<Part>& parts, const Shape& shape, const btTransform& pose, const Colour& colour)
{
	const btVector3& size = shape.size;
	switch (shape.kind)
	{
		case ShapeKind::Box:
			parts.push_back(boxPart(pose, size, colour, .2f));
			break;
		case ShapeKind::Sphere:
			addSphere(parts, pose, size.x(), colour);
			break;
		case ShapeKind::Cylinder:
			parts.push_back(cylinderPart(upright(pose), size.x(), size.y(), colour, .3f));
			break;
		case ShapeKind::Capsule:
			parts.push_back(cylinderPart(upright(pose), size.x(), size.y(), colour, .3f));
			for (int side : {-1, 1})
				addSphere(parts,
						  pose * btTransform(btQuaternion(0, 0, 0, 1), btVector3(0, size.y() / 2 * btScalar(side), 0)),
						  size.x(), colour);
			break;
		case ShapeKind::Hull:
			addHull(parts, shape.points, pose, colour);
			break;
		case ShapeKind::Compound:
			for (const Shape::Part& part : shape.parts)
				addShape(parts, part.shape, pose * part.pose, colour);
			break;
		case ShapeKind::Mesh:
			for (size_t i = 0; i + 2 < shape.points.size(); i += 3)
				addTriangle(parts, &shape.points[i], pose, colour);
			break;
	}
}

Drawing drawSimulation(const Simulation& s)
{
	Drawing drawing;
	for (size_t i = 0; i < s.scene().bodies.size(); ++i)
		if (s.isThere(int(i)))
			addShape(drawing.parts, s.scene().bodies[i].shape, s.poseOf(int(i)), toColour(s.scene().bodies[i].colour));
	for (const Simulation::Wheel& wheel : s.wheels())
		if (s.isThere(wheel.body))
			addShape(drawing.parts, wheel.shape, wheel.pose, TYRE);
	for (size_t i = 0; i < s.scene().joints.size(); ++i)
		addJoint(drawing.parts, s, int(i));
	drawing.text = {s.scene().title,
					format("%.2f s, %d of %zu joints broken", s.time(), s.numBroken(), s.scene().joints.size())};
	drawing.legend = {
		{jointColour(0, 0), "unloaded"}, {jointColour(.5, 0), "half of yield"}, {jointColour(1, 0), "yields"}};
	drawing.subject.setOrigin(cameraOf(s).target);
	return drawing;
}

Camera cameraOf(const Simulation& s)
{
	Camera camera;
	camera.eye = s.scene().camera.from;
	camera.target = s.scene().camera.to;
	if (s.scene().camera.isGiven)
		return camera;
	btVector3 low(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT), high = -low;
	for (size_t i = 0; i < s.scene().bodies.size(); ++i)
		if (s.scene().bodies[i].motion == SceneDescription::Motion::Dynamic)
		{
			low.setMin(s.startOf(int(i)).getOrigin());
			high.setMax(s.startOf(int(i)).getOrigin());
		}
	if (low.x() > high.x())
		return camera;
	const btScalar size = (high - low).length() + 1;
	camera.target = (low + high) / 2;
	camera.eye = camera.target + btVector3(btScalar(.4), btScalar(.35), btScalar(1.1)) * size;
	return camera;
}
}  // namespace ep
