// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_RUN_H
#define EP_TEST_RUN_H

#include "world/World.h"

/// A picture of a game [s].
const btScalar FRAME = btScalar(1) / 60;

inline void run(ep::World& world, int steps, btScalar dt = FRAME)
{
	for (int i = 0; i < steps; ++i)
		world.step(dt);
}

/// Lets a static body be moved by whoever steps the world.
inline void makeKinematic(btRigidBody& body)
{
	body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
}

inline bool isFinite(const btVector3& v) { return btElasticPlasticIsFinite(v.x() + v.y() + v.z()); }

inline bool isFinite(const btRigidBody& body)
{
	return isFinite(body.getCenterOfMassPosition()) && isFinite(body.getLinearVelocity()) &&
		   isFinite(body.getAngularVelocity());
}

#endif  // EP_TEST_RUN_H
