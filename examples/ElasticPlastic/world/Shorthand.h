// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SHORTHAND_H
#define EP_SHORTHAND_H

#include "BulletDynamics/ConstraintSolver/btElasticPlasticCapacity.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

/// A place without a turn.
inline btTransform at(double x, double y = 0, double z = 0)
{
	return btTransform(btQuaternion(0, 0, 0, 1), btVector3(btScalar(x), btScalar(y), btScalar(z)));
}

/// The same stiffness and yield value in all degrees of freedom.
inline btElasticPlasticCapacity evenCapacity(double stiffness,
											 double yield = double(btElasticPlasticCapacity::unlimited()))
{
	btElasticPlasticCapacity capacity;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		capacity.set(i, btScalar(stiffness), btScalar(yield));
	return capacity;
}

inline bool isFinite(const btRigidBody& body)
{
	return btElasticPlasticIsFinite(body.getCenterOfMassPosition().length()) &&
		   btElasticPlasticIsFinite(body.getLinearVelocity().length()) &&
		   btElasticPlasticIsFinite(body.getAngularVelocity().length());
}

#endif  // EP_SHORTHAND_H
