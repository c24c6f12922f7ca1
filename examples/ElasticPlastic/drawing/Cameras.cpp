// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "drawing/Cameras.h"

#include <algorithm>
#include <cmath>

namespace ep
{
namespace
{
struct Axes
{
	btVector3 right, up, forward;

	explicit Axes(const btVector3& direction)
		: right(direction.cross(btVector3(0, 1, 0)).normalized()),
		  up(right.cross(direction).normalized()),
		  forward(direction.normalized())
	{
	}
};

/// Slopes of the sight lines at the edges of what is free: over the distance, to the right or up.
struct Slopes
{
	btScalar low, high;

	Slopes(float half, float lowMargin, float highMargin)
		: low(btScalar(half * (2 * lowMargin - 1))), high(btScalar(half * (1 - 2 * highMargin)))
	{
	}
};

/// For one direction across the picture: which eyes have all points between the slopes. With the eye's place e across and d along
/// the sight, that is  across + high d >= of e,  below - low d <= of e.
struct Reach
{
	Slopes slopes;
	btScalar most = -BT_LARGE_FLOAT, least = BT_LARGE_FLOAT;

	explicit Reach(const Slopes& s) : slopes(s) {}

	void add(btScalar across, btScalar along)
	{
		most = btMax(most, across - slopes.high * along);
		least = btMin(least, across - slopes.low * along);
	}

	/// The furthest forward that an eye may be.
	btScalar furthest() const { return (least - most) / (slopes.high - slopes.low); }
	btScalar middle(btScalar along) const { return (most + slopes.high * along + least + slopes.low * along) / 2; }
};
}  // namespace

Camera framingCamera(const Bounds& bounds, const btVector3& direction, float aspect, const Margins& margins)
{
	Camera camera;
	camera.fieldOfView = 0.5f;
	const float half = std::tan(camera.fieldOfView / 2);
	const Axes axes(direction);
	Reach across(Slopes(half * aspect, margins.left, margins.right)),
		upright(Slopes(half, margins.bottom, margins.top));
	for (int i = 0; i < 8; ++i)
	{
		const btVector3 corner(i & 1 ? bounds.high.x() : bounds.low.x(), i & 2 ? bounds.high.y() : bounds.low.y(),
							   i & 4 ? bounds.high.z() : bounds.low.z());
		const btScalar along = corner.dot(axes.forward);
		across.add(corner.dot(axes.right), along);
		upright.add(corner.dot(axes.up), along);
	}
	const btScalar along = btMin(across.furthest(), upright.furthest());
	camera.eye = axes.right * across.middle(along) + axes.up * upright.middle(along) + axes.forward * along;
	camera.target = camera.eye + axes.forward * (bounds.centre() - camera.eye).dot(axes.forward);
	return camera;
}

Camera chaseCamera(const btTransform& subject, btScalar closeness)
{
	btVector3 heading = subject.getBasis().getColumn(0);
	heading.setY(0);
	heading = heading.length2() > 0 ? heading.normalized() : btVector3(1, 0, 0);
	const btVector3 side = heading.cross(btVector3(0, 1, 0));
	Camera camera;
	const btVector3 behind = side * btScalar(6.5) - heading * 12, beside = side * 18 + heading * 6;
	camera.eye = subject.getOrigin() + behind.lerp(beside, closeness) + btVector3(0, btScalar(5.8), 0);
	camera.target = subject.getOrigin() + heading * 5;
	return camera;
}

Camera movedAside(Camera camera, float aspect, const Margins& margins)
{
	// As far to the sides as in a picture of usual width, if panels leave less.
	const float usual = 1.3f, free = aspect * (1 - margins.left - margins.right);
	const btVector3 sight = (camera.target - camera.eye) * btScalar(std::max(1.f, usual / free));
	camera.eye = camera.target - sight;
	const Axes axes(sight);
	const float half = std::tan(camera.fieldOfView / 2);
	const btVector3 aside = axes.right * (btScalar((margins.right - margins.left) * half * aspect) * sight.length());
	camera.eye += aside;
	camera.target += aside;
	return camera;
}
}  // namespace ep
