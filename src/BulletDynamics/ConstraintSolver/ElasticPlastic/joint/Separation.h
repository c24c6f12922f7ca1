// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SEPARATION_H
#define BT_ELASTIC_PLASTIC_SEPARATION_H

#include "LinearMath/btScalar.h"

class btCollisionWorld;
class btRigidBody;

namespace btElasticPlastic
{

// Two bodies whose joint has broken collide again, but they may overlap: a bent joint has pushed their corners into each other.
// Bullet would shoot them apart, with energy from nowhere. Until they have parted, their contacts therefore stop what would
// deepen the overlap, and do not push.

/// Overlaps up to this do not count [m].
const btScalar SEPARATION_SLOP = btScalar(1e-4);

/// How deep the bodies' shapes overlap now [m], 0 if they do not.
btScalar overlapOf(btCollisionWorld& world, btRigidBody& a, btRigidBody& b);

/// Sets the penetration of the bodies' contact points to zero for the step that is being set up, after collision detection and
/// before contacts become rows. \return the deepest penetration it found [m]
btScalar suspendRecovery(btCollisionWorld& world, btRigidBody& a, btRigidBody& b);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SEPARATION_H
