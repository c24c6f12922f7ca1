// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SHOWN_AREA_H
#define EP_SHOWN_AREA_H

#include "btBulletCollisionCommon.h"

namespace ep
{
/// The most that a box round a shape shows to a direction in the body's axes [m^2].
inline double shownArea(const btCollisionShape& shape, const btVector3& direction)
{
	btVector3 low, high;
	shape.getAabb(btTransform::getIdentity(), low, high);
	const btVector3 size = high - low;
	return double(btFabs(direction.x()) * size.y() * size.z() + btFabs(direction.y()) * size.x() * size.z() +
				  btFabs(direction.z()) * size.x() * size.y());
}
}  // namespace ep

#endif  // EP_SHOWN_AREA_H
