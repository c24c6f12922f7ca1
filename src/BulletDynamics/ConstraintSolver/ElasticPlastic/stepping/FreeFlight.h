// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_FREE_FLIGHT_H
#define BT_ELASTIC_PLASTIC_FREE_FLIGHT_H

#include "LinearMath/btScalar.h"

class btDynamicsWorld;

namespace btElasticPlastic
{
/// Keeps the energy of bodies in free fall when the length of the substep changes.
///
/// Bullet's velocities belong to a time half a substep before that of its positions. A substep of another length shifts that
/// time, and a falling body would lose or gain the speed that gravity gives it in between: a body that falls by half a metre
/// in steps of 1/60 s, and lands in fine ones, a twentieth of its energy. Here every body that nothing holds or touches gets
/// that speed.
/// \param later  by how much the time shifts: half of the last substep less half of the next one [s]
void keepFreeFlight(btDynamicsWorld& world, btScalar later);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_FREE_FLIGHT_H
