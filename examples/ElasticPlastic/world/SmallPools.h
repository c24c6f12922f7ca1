// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SMALL_POOLS_H
#define EP_SMALL_POOLS_H

#include "BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h"

namespace ep
{
/// For worlds that come and go: Bullet's own pools have room for 4096 pairs, and all of it is written to with each world, 4 MB. What finds no
/// room here is allocated by itself.
inline btDefaultCollisionConstructionInfo smallPools()
{
	btDefaultCollisionConstructionInfo info;
	info.m_defaultMaxPersistentManifoldPoolSize = info.m_defaultMaxCollisionAlgorithmPoolSize = 256;
	return info;
}
}  // namespace ep

#endif  // EP_SMALL_POOLS_H
