// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PLACE_H
#define EP_PLACE_H

#include "LinearMath/btTransform.h"

namespace ep
{
/// The pose of what stands at a place as it was made, without a turn.
inline btTransform at(btScalar x, btScalar y = 0, btScalar z = 0)
{
	return btTransform(btQuaternion(0, 0, 0, 1), btVector3(x, y, z));
}
}  // namespace ep

#endif  // EP_PLACE_H
