// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BODY_GATE_H
#define BT_ELASTIC_PLASTIC_BODY_GATE_H

#include "../../btElasticPlasticFault.h"

class btRigidBody;

namespace btElasticPlastic
{
/// Is all that a solver multiplies with a body's rows a finite number: place, orientation, velocities, loads, mass, inertia,
/// factors? A body that something else made NaN must not take its neighbours with it.
bool isFinite(const btRigidBody& body);

/// A body that moves is in no world.
btElasticPlasticFault findMissingWorld(const btRigidBody& body, bool isBodyA);

/// What keeps a body's joints out of the present step: it is not finite, or moves and is in no world, or has no inertia.
/// \param isBodyA   whether it is the joint's first one, for the fault's text
/// \param isTurned  whether the joint bears moments
btElasticPlasticFault findBodyFault(const btRigidBody& body, bool isBodyA, bool isTurned);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_BODY_GATE_H
