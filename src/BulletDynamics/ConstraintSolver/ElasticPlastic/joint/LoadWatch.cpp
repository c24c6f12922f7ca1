// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "LoadWatch.h"

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
}  // namespace btElasticPlastic
