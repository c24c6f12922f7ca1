// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_APPROACH_H
#define BT_ELASTIC_PLASTIC_APPROACH_H

#include "BodyMarks.h"
#include "LinearMath/btScalar.h"

class btDynamicsWorld;

namespace btElasticPlastic
{
/// Bodies that come near each other, one of which elastic-plastic joints hold.
struct Approach
{
	/// Speed at which bodies near others over a twentieth of the smaller one's least edge, the largest [1/s]: penetration that
	/// joints are pushed apart by is work from nowhere.
	double m_rate = 0;
	bool m_isBlow = false;  ///< do bodies that are still apart come together?
};

/// Looks along the ways of the next dt [s].
/// \param joined  those that elastic-plastic joints hold
Approach lookAhead(btDynamicsWorld& world, const BodyMarks& joined, btScalar dt);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_APPROACH_H
