// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_ROW_H
#define EP_TEST_ROW_H

#include <vector>

#include "support/Run.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

/// Blocks hanging side by side, each on its own joint that breaks after the given plastic elongation.
struct Row
{
	ep::World m_world;
	btRigidBody* m_ceiling;
	std::vector<btElasticPlasticJoint*> m_joints;

	explicit Row(int count, ep::Solver solver = ep::Solver::Iterative, double ductility = 0.05) : m_world(solver)
	{
		m_ceiling = m_world.body(0, m_world.box(btVector3(100, 1, 1)), btTransform::getIdentity(), false);
		for (int i = 0; i < count; ++i)
		{
			const btVector3 place(btScalar(2 * i), -1, 0);
			btRigidBody* block =
				m_world.body(100, m_world.box(btVector3(1, 1, 1)), btTransform(btQuaternion(0, 0, 0, 1), place), false);
			btElasticPlasticCapacity capacity;
			for (int d = 0; d < BT_EP_DOF_COUNT; ++d)
				capacity.set(d, btScalar(1e7), 800, btScalar(ductility));
			m_joints.push_back(m_world.joint(
				*m_ceiling, *block,
				btTransform(btQuaternion(btVector3(0, 0, 1), -SIMD_HALF_PI), place + btVector3(0, btScalar(0.5), 0)),
				capacity));
		}
	}

	void run(int steps)
	{
		for (int i = 0; i < steps; ++i)
			m_world.step(btScalar(1) / 240);
	}
};

#endif  // EP_TEST_ROW_H
