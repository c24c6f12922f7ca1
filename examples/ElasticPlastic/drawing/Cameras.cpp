// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "drawing/Cameras.h"

#include <cmath>

namespace ep
{
Camera chaseCamera(const btTransform& subject)
{
	btVector3 heading = subject.getBasis().getColumn(0);
	heading.setY(0);
	heading = heading.length2() > 0 ? heading.normalized() : btVector3(1, 0, 0);
	const btVector3 side = heading.cross(btVector3(0, 1, 0));
	Camera camera;
	camera.eye = subject.getOrigin() - heading * 14 + side * 6 + btVector3(0, btScalar(4.6), 0);
	camera.target = subject.getOrigin() + heading * 6 + btVector3(0, btScalar(.2), 0);
	return camera;
}

Camera sideCamera(const btVector3& centre, btScalar extent, float aspect)
{
	Camera camera;
	camera.fieldOfView = 0.5f;
	const btScalar distance = extent / (2 * btScalar(std::tan(camera.fieldOfView / 2) * aspect));
	camera.target = centre;
	camera.eye = centre + btVector3(btScalar(-.24), btScalar(.10), 1) * distance;
	return camera;
}
}  // namespace ep
