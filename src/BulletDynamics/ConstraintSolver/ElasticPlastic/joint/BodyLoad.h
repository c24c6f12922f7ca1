// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BODY_LOAD_H
#define BT_ELASTIC_PLASTIC_BODY_LOAD_H

#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
/// What the world's gravity pulls a body by [N], rounded as Bullet rounds it.
inline btVector3 weightOf(const btRigidBody& body)
{
	return body.getInvMass() > 0 ? body.getGravity() * (1 / body.getInvMass()) * body.getLinearFactor()
								 : btVector3(0, 0, 0);
}

/// The force that acts on a body in a step beside its weight [N]: exactly 0 if nobody has applied one.
inline btVector3 forceBesideWeight(const btRigidBody& body) { return body.getTotalForce() - weightOf(body); }
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_BODY_LOAD_H
