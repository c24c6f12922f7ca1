// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_FREE_FLIGHT_H
#define BT_ELASTIC_PLASTIC_FREE_FLIGHT_H

#include "LinearMath/btScalar.h"

class btDynamicsWorld;

namespace btElasticPlastic
{
/// Bullet's velocities stand half a substep before its places. A substep of another length moves that time, and what falls
/// would lose or gain the speed of the difference: a body that falls by half a metre in steps of 1/60 s and lands in fine ones
/// a twentieth of its energy. Here it gets what gravity makes of it, if nothing holds or touches it.
/// \param later  by how much the time moves: half of the last substep less the next one [s]
void keepFreeFlight(btDynamicsWorld& world, btScalar later);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_FREE_FLIGHT_H
