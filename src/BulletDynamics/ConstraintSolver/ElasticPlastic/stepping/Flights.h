// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_FLIGHTS_H
#define BT_ELASTIC_PLASTIC_FLIGHTS_H

#include "LinearMath/btScalar.h"
#include "BodyMarks.h"

class btDynamicsWorld;

namespace btElasticPlastic
{

// What the choice of substeps has to know of bodies that move freely: whom they are about to hit, and what a change of the
// substep is to them.

struct Approach
{
	/// Speed at which bodies near others, one of the two joined, over a twentieth of the smaller one's least edge, the largest
	/// [1/s]: penetration that joints are pushed apart by is work from nowhere.
	double m_rate = 0;
	bool m_isBlow = false;  ///< do bodies that are still apart come together?
};

/// Looks along the ways of the next dt [s].
/// \param joined  those that elastic-plastic joints hold
Approach lookAhead(btDynamicsWorld& world, const BodyMarks& joined,
												   btScalar dt);

/// Bullet's velocities stand half a substep before its places. A substep of another length moves that time, and what falls
/// would lose or gain the speed of the difference: a body that falls by half a metre in steps of 1/60 s and lands in fine ones
/// a twentieth of its energy. Here it gets what gravity makes of it, if nothing holds or touches it.
/// \param later  by how much the time moves: half of the last substep less the next one [s]
void keepFreeFlight(btDynamicsWorld& world, btScalar later);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_FLIGHTS_H
