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

/// What is to be applied to a body with factors that it takes up all of it; nothing along axes along which it does not move.
inline btVector3 beforeFactor(const btVector3& load, const btVector3& factor)
{
	btVector3 applied(0, 0, 0);
	for (int k = 0; k < 3; ++k)
		if (factor[k] != 0)
			applied[k] = load[k] / factor[k];
	return applied;
}

/// By component what two loads, or changes of loads, have in common.
inline btVector3 commonOf(const btVector3& a, const btVector3& b)
{
	btVector3 common(0, 0, 0);
	for (int k = 0; k < 3; ++k)
		if (a[k] * b[k] > 0)
			common[k] = btFabs(a[k]) < btFabs(b[k]) ? a[k] : b[k];
	return common;
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_BODY_LOAD_H
