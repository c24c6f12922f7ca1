// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BODY_GATE_H
#define BT_ELASTIC_PLASTIC_BODY_GATE_H

#include "../../btElasticPlasticFault.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
/// Whether all numbers of a body that enter a solver's rows are finite, position, orientation, velocities, loads, mass,
/// inertia, factors, and its basis is that of a rotation. A body that has become NaN or flat must not spread that to its neighbours.
bool isWellFormed(const btRigidBody& body);

/// Whether the user has taken a body out of the simulation: Bullet does not move it, whatever its velocity.
inline bool isFrozen(const btRigidBody& body) { return body.getActivationState() == DISABLE_SIMULATION; }

/// Whether a body stands, or goes its way, whatever acts on it.
inline bool isHeld(const btRigidBody& body) { return body.isStaticOrKinematicObject() || isFrozen(body); }

/// Bullet takes over no motion of a kinematic body that sleeps, and leaves it its last velocity.
inline bool isKinematicAndAwake(const btRigidBody& body)
{
	return body.isKinematicObject() && body.getActivationState() != ISLAND_SLEEPING;
}

/// The broadphase's uid of a body, which tells it from a later one at its address; -1: it is in no world.
inline int uidOf(const btRigidBody& body)
{
	return body.getBroadphaseHandle() ? body.getBroadphaseHandle()->getUid() : -1;
}

/// \return a fault if a body that can move is in no world, or is a collision object of another kind that was cast to a rigid body
btElasticPlasticFault findMissingWorld(const btRigidBody& body, bool isBodyA);

/// \return the fault of a body that keeps its joints out of the present step: it is not well formed, it can move and is in no
/// world or has no inertia, or it is static and has a mass
/// \param isBodyA   whether it is the joint's first body, for the fault's text
/// \param isTurned  whether the joint bears moments
btElasticPlasticFault findBodyFault(const btRigidBody& body, bool isBodyA, bool isTurned);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_BODY_GATE_H
