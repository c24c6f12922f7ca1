// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_KINEMATIC_LEAD_H
#define BT_ELASTIC_PLASTIC_KINEMATIC_LEAD_H

#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
// A game moves a kinematic body once for all substeps of a frame. Bullet shows it where the last of them will leave it, in each of them, with the velocity
// that takes it there in all of them together: in all but the last one it is shown ahead of its way.

/// In how many substeps a kinematic body goes the way to where Bullet shows it.
/// \param from  where it was
/// \param step  length of a substep [s]
/// \return 0 if its velocity does not take it there
int countSubsteps(const btTransform& from, const btRigidBody& body, btScalar step);

/// Where it was some time before it is at a place.
btTransform placeBefore(const btTransform& place, const btRigidBody& body, btScalar time);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_KINEMATIC_LEAD_H
