// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "LoadWatch.h"

#include <stdint.h>
#include <string.h>

#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
bool LoadWatch::hasDeformed(const btScalar strain[BT_EP_DOF_COUNT], btScalar share)
{
	btElasticPlasticState& state = m_model.m_state;
	const btElasticPlasticCapacity& capacity = m_model.m_capacity;
	bool hasChanged = false;
	for (int i = 0; i < BT_EP_DOF_COUNT && !hasChanged; ++i)
	{
		if (!m_model.isElasticPlastic(i))
			continue;
		const btScalar change = btFabs(strain[i] + state.m_plastic[i] - state.m_watched[i]);
		// What does not spring has no deformation below yield: there the ductility is the measure of what counts.
		const bool isBeyond = capacity.isRigidPlastic(i)
								  ? change > share * capacity.m_ductility[i]
								  : change * capacity.m_stiffness[i] > share * capacity.m_yield[i];
		// The two ends of the change are rounded.
		hasChanged = isBeyond && change > 2 * m_model.strainRounding(i);
	}
	for (int i = 0; i < BT_EP_DOF_COUNT && hasChanged; ++i)
		state.m_watched[i] = strain[i] + state.m_plastic[i];
	return hasChanged;
}

namespace
{
/// What the state keeps in place of a digest.
const unsigned long long NOT_SEEN = 0, NO_SUPPORT = 1;

/// A number that two different transforms hardly ever have in common, and which is none of the two above.
unsigned long long digestOf(const btTransform& transform)
{
	uint64_t digest = 1;
	for (int row = 0; row < 4; ++row)
	{
		const btVector3& vector = row < 3 ? transform.getBasis()[row] : transform.getOrigin();
		for (int i = 0; i < 3; ++i)
		{
			const double number = vector[i];
			uint64_t bits;
			memcpy(&bits, &number, sizeof bits);
			digest = (digest ^ bits) * 0x9E3779B97F4A7C15u;
			digest ^= digest >> 32;
		}
	}
	return digest | 2;
}
}  // namespace

bool LoadWatch::mayHaveSupport(const btElasticPlasticState& state) { return state.m_supportDigest != NO_SUPPORT; }

bool LoadWatch::hasSupportMoved()
{
	const btRigidBody &a = m_model.bodyA(), &b = m_model.bodyB();
	const bool isSupported = a.isStaticOrKinematicObject() || b.isStaticOrKinematicObject();
	const btRigidBody& support = a.isStaticOrKinematicObject() ? a : b;
	const unsigned long long digest = isSupported ? digestOf(support.getCenterOfMassTransform()) : NO_SUPPORT;
	const unsigned long long former = m_model.m_state.m_supportDigest;
	m_model.m_state.m_supportDigest = digest;
	return former != NOT_SEEN && former != digest;
}
}  // namespace btElasticPlastic
