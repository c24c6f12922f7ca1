// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_FROZEN_BODIES_H
#define BT_ELASTIC_PLASTIC_FROZEN_BODIES_H

#include "../joint/BodyGate.h"
#include "LinearMath/btAlignedObjectArray.h"

namespace btElasticPlastic
{
/// Holds bodies that the user has taken out of the simulation (DISABLE_SIMULATION) for as long as it lives. Bullet solves them as if they could move, and
/// leaves them where they are: the momentum that others give them would be lost, in each step anew. Loads on them do nothing.
class FrozenBodies
{
public:
	FrozenBodies(btCollisionObject** bodies, int numBodies)
	{
		for (int i = 0; i < numBodies; ++i)
		{
			btRigidBody* const body = btRigidBody::upcast(bodies[i]);
			if (!body || !isFrozen(*body) || body->isStaticOrKinematicObject())
				continue;
			m_bodies.push_back({body, body->getLinearFactor(), body->getAngularFactor()});
			const btVector3 none(0, 0, 0);
			body->setLinearFactor(none);
			body->setAngularFactor(none);
			body->setLinearVelocity(none);
			body->setAngularVelocity(none);
			body->clearForces();
		}
	}
	FrozenBodies(const FrozenBodies&) = delete;
	FrozenBodies& operator=(const FrozenBodies&) = delete;
	~FrozenBodies()
	{
		for (int i = 0; i < m_bodies.size(); ++i)
		{
			m_bodies[i].m_body->setLinearFactor(m_bodies[i].m_linearFactor);
			m_bodies[i].m_body->setAngularFactor(m_bodies[i].m_angularFactor);
		}
	}

private:
	struct Body
	{
		btRigidBody* m_body;
		btVector3 m_linearFactor, m_angularFactor;
	};
	btAlignedObjectArray<Body> m_bodies;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_FROZEN_BODIES_H
