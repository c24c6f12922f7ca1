// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "ContactFactors.h"

#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"

namespace btElasticPlastic
{
bool hasOwnFactor(const btManifoldPoint& point)
{
	return (point.m_contactPointFlags & BT_CONTACT_FLAG_HAS_CONTACT_ERP) != 0;
}

bool isSpring(const btManifoldPoint& point)
{
	return (point.m_contactPointFlags &
			(BT_CONTACT_FLAG_HAS_CONTACT_CFM | BT_CONTACT_FLAG_CONTACT_STIFFNESS_DAMPING)) != 0;
}

ContactFactors::ContactFactors(const SolverGroup& group, btScalar share)
{
	for (int i = 0; i < group.m_numManifolds && share < 1; ++i)
		for (int k = 0; k < group.m_manifolds[i]->getNumContacts(); ++k)
		{
			btManifoldPoint& point = group.m_manifolds[i]->getContactPoint(k);
			if (!hasOwnFactor(point))
				continue;
			m_held.push_back({&point, point.m_contactERP});
			point.m_contactERP *= share;
		}
}

ContactFactors::~ContactFactors()
{
	for (const Held& held : m_held)
		held.m_point->m_contactERP = held.m_own;
}
}  // namespace btElasticPlastic
