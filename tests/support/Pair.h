// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_PAIR_H
#define EP_TEST_PAIR_H

#include "support/Run.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

/// Two unit cubes side by side along x, and the joint that may come between them. Without gravity, unless it is given.
struct Pair
{
	ep::World m_world;
	btRigidBody* m_a;
	btRigidBody* m_b;
	btTransform m_frame = ep::at(0.5);

	/// \param massA  0: a fixed one
	explicit Pair(const ep::Method& method = ep::Solver::Iterative, btScalar massA = 0, btScalar massB = 12,
				  const btVector3& gravity = btVector3(0, 0, 0), bool collides = false)
		: m_world(method, gravity)
	{
		btCollisionShape* cube = m_world.box(btVector3(1, 1, 1));
		m_a = m_world.body(massA, cube, ep::at(0), collides);
		m_b = m_world.body(massB, cube, ep::at(1), collides);
	}

	btElasticPlasticJoint* join(const btElasticPlasticCapacity& capacity,
								ep::JointClass jointClass = ep::JointClass::Spring2)
	{
		return m_world.joint(*m_a, *m_b, m_frame, capacity, jointClass);
	}
};

#endif  // EP_TEST_PAIR_H
