// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "LoadWatch.h"

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

bool LoadWatch::mayHaveSupport(const btElasticPlasticState& state)
{
	return state.m_support.m_kind != btElasticPlasticState::Support::NONE;
}

namespace
{
/// How much of the time by which a joint follows its support late is left after a step. The rest strains it.
const btScalar STILL_LATE = btScalar(0.995);
/// Below this share of a step it is in time.
const btScalar LEAST_LATE = btScalar(1e-3);

/// What has moved away from a sleeping joint for more steps than these has left it.
const btScalar MOST_LATE = 4;

bool isOnItsWay(const btRigidBody& body)
{
	return body.isKinematicObject() && body.getActivationState() != ISLAND_SLEEPING &&
		   !(body.getLinearVelocity().isZero() && body.getAngularVelocity().isZero());
}
}  // namespace

bool LoadWatch::hasSupportMoved(btScalar step, btScalar lead)
{
	using Support = btElasticPlasticState::Support;
	Support& last = m_model.m_state.m_support;
	const bool isInStep = lead >= 0;
	const btRigidBody* const body = m_model.support();
	Support now;
	now.m_kind = body ? Support::SEEN : Support::NONE;
	if (body)
	{
		now.m_place = body->getCenterOfMassTransform();
		now.m_lead = isInStep ? lead : m_model.kinematicLead(step, false);
		now.m_late = isInStep ? last.m_late * STILL_LATE : last.m_late;
		if (now.m_late < LEAST_LATE * step)
			now.m_late = 0;
	}
	const bool hasMoved =
		last.m_kind != Support::NOT_SEEN && (last.m_kind != now.m_kind || !(last.m_place == now.m_place));
	// It goes on along its way, and is not to be found there at once by what wakes.
	const btRigidBody& other = body == &m_model.bodyA() ? m_model.bodyB() : m_model.bodyA();
	if (body && hasMoved && !isInStep && isOnItsWay(*body) && other.getActivationState() == ISLAND_SLEEPING)
		now.m_late = btMin(now.m_late + step, MOST_LATE * step);
	last = now;
	return hasMoved;
}
}  // namespace btElasticPlastic
