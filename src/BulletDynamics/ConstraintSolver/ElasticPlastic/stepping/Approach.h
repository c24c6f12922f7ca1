// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_APPROACH_H
#define BT_ELASTIC_PLASTIC_APPROACH_H

#include "BodyMarks.h"
#include "LinearMath/btScalar.h"

class btDynamicsWorld;

namespace btElasticPlastic
{
/// How bodies approach each other, of which at least one is held by elastic-plastic joints.
struct Approach
{
	/// The largest speed of two bodies relative to each other over a twentieth of the smaller one's least edge [1/s]. A
	/// substep in which they go further than that would leave a penetration that is pushed out against the joints, and so
	/// creates energy.
	double m_rate = 0;
	bool m_isBlow = false;  ///< whether bodies that are still apart come together
};

/// Looks ahead along the paths of bodies in the next dt [s].
/// \param joined  the bodies that elastic-plastic joints hold
Approach lookAhead(btDynamicsWorld& world, const BodyMarks& joined, btScalar dt);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_APPROACH_H
