// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_CONTACT_POINTS_H
#define EP_TEST_CONTACT_POINTS_H

#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "world/World.h"

/// \param see  gets each btManifoldPoint of a world
template <class See>
void forEachContactPoint(ep::World& world, const See& see)
{
	btDispatcher& dispatcher = *world.bullet().getDispatcher();
	for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
	{
		const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
		for (int k = 0; k < manifold.getNumContacts(); ++k)
			see(manifold.getContactPoint(k));
	}
}

inline int countContactPoints(ep::World& world)
{
	int points = 0;
	forEachContactPoint(world, [&](const btManifoldPoint&) { ++points; });
	return points;
}

#endif  // EP_TEST_CONTACT_POINTS_H
