// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_JOINED_VELOCITY_H
#define BT_ELASTIC_PLASTIC_JOINED_VELOCITY_H

#include "BodyGate.h"

namespace btElasticPlastic
{
// How joints and contacts see bodies move: a static body stands, whatever velocity it has been given. Bullet never moves it, and its rows of contacts take it as standing, too.
// And so does a kinematic one that sleeps.

inline bool isStanding(const btRigidBody& body)
{
	return body.isStaticOrKinematicObject() && !isKinematicAndAwake(body);
}

/// [rad/s]
inline btVector3 spinOf(const btRigidBody& body)
{
	return isStanding(body) ? btVector3(0, 0, 0) : body.getAngularVelocity();
}

/// \param arm  from the centre of mass, world coordinates [m]
/// \return [m/s]
inline btVector3 velocityAt(const btRigidBody& body, const btVector3& arm)
{
	return isStanding(body) ? btVector3(0, 0, 0) : body.getVelocityInLocalPoint(arm);
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_JOINED_VELOCITY_H
