// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_KINEMATIC_LEAD_H
#define BT_ELASTIC_PLASTIC_KINEMATIC_LEAD_H

#include "../../btElasticPlasticState.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
// A game moves a kinematic body once for all substeps of a frame. Bullet shows it where the last of them will leave it, in each of them, with the velocity
// that takes it there in all of them together: in all but the last one it is shown ahead of its way.

/// \param support  as it was when the last substep had ended
/// \param body     that is kinematic, after Bullet has taken over its motion for the substep; inner steps may have put it elsewhere on its way
/// \param step     length of the substep [s]
/// \return by which time it is shown ahead of where the substep will leave it [s]
btScalar kinematicLead(const btElasticPlasticState::Support& support, const btRigidBody& body, btScalar step);

/// Where it was that time ago.
btTransform placeBeforeLead(const btRigidBody& body, btScalar lead);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_KINEMATIC_LEAD_H
