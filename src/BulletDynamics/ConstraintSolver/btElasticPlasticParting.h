/*
Bullet Elastic-Plastic: joints for Bullet Physics that bend before they break
Copyright (c) 2026 Bullet Elastic-Plastic contributors

This software is provided 'as-is', without any express or implied warranty.
In no event will the authors be held liable for any damages arising from the use of this software.
Permission is granted to anyone to use this software for any purpose,
including commercial applications, and to alter it and redistribute it freely,
subject to the following restrictions:

1. The origin of this software must not be misrepresented; you must not claim that you wrote the original software. If you use this software in a product, an acknowledgment in the product documentation would be appreciated but is not required.
2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the original software.
3. This notice may not be removed or altered from any source distribution.
*/

#ifndef BT_ELASTIC_PLASTIC_PARTING_H
#define BT_ELASTIC_PLASTIC_PARTING_H

#include "LinearMath/btScalar.h"

class btCollisionWorld;
class btRigidBody;

// Two bodies whose joint has broken collide again, but they may overlap: a bent joint has pushed their corners into each other.
// Bullet would shoot them apart, with energy from nowhere. Until they have parted, their contacts therefore stop what would
// deepen the overlap, and do not push.

/// Overlaps up to this do not count [m].
const btScalar BT_EP_PARTING_SLOP = btScalar(1e-4);

/// How deep the bodies' shapes overlap now [m], 0 if they do not.
btScalar btElasticPlasticOverlap(btCollisionWorld& world, btRigidBody& a, btRigidBody& b);

/// Sets the penetration of the bodies' contact points to zero for the step that is being set up, after collision detection and
/// before contacts become rows. \return the deepest penetration it found [m]
btScalar btElasticPlasticHoldOverlap(btCollisionWorld& world, btRigidBody& a, btRigidBody& b);

#endif  // BT_ELASTIC_PLASTIC_PARTING_H
