// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_CONTACT_POINTS_H
#define EP_TEST_CONTACT_POINTS_H

#include "world/World.h"

inline int countContactPoints(ep::World& world)
{
	int points = 0;
	btDispatcher& dispatcher = *world.bullet().getDispatcher();
	for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
		points += dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
	return points;
}

#endif  // EP_TEST_CONTACT_POINTS_H
