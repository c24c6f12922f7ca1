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

#ifndef BT_ELASTIC_PLASTIC_FLIGHTS_H
#define BT_ELASTIC_PLASTIC_FLIGHTS_H

#include "LinearMath/btScalar.h"
#include "btElasticPlasticBodyMarks.h"

class btDynamicsWorld;

// What the choice of substeps has to know of bodies that move freely: whom they are about to hit, and what a change of the
// substep is to them.

struct btElasticPlasticApproach
{
	/// Speed at which bodies near others, one of the two joined, over a twentieth of the smaller one's least edge, the largest
	/// [1/s]: penetration that joints are pushed apart by is work from nowhere.
	double m_rate = 0;
	bool m_isBlow = false;  ///< do bodies that are still apart come together?
};

/// Looks along the ways of the next dt [s].
/// \param joined  those that elastic-plastic joints hold
btElasticPlasticApproach btElasticPlasticLookAhead(btDynamicsWorld& world, const btElasticPlasticBodyMarks& joined,
												   btScalar dt);

/// Bullet's velocities stand half a substep before its places. A substep of another length moves that time, and what falls
/// would lose or gain the speed of the difference: a body that falls by half a metre in steps of 1/60 s and lands in fine ones
/// a twentieth of its energy. Here it gets what gravity makes of it, if nothing holds or touches it.
/// \param later  by how much the time moves: half of the last substep less the next one [s]
void btElasticPlasticKeepFlights(btDynamicsWorld& world, btScalar later);

#endif  // BT_ELASTIC_PLASTIC_FLIGHTS_H
