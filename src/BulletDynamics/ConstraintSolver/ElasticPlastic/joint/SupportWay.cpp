// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "SupportWay.h"

#include <math.h>

#include <initializer_list>

#include "BodyGate.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "LinearMath/btTransformUtil.h"

namespace btElasticPlastic
{
namespace
{
using Support = btElasticPlasticState::Support;

/// A way is that of a number of substeps if it is so to this share.
const btScalar LIKE = btScalar(1e-2);
/// More substeps than any frame has.
const btScalar MOST_SUBSTEPS = 100000;
/// How near to a number of substeps a way has to be that is only told by a deformation, over the way of one; beside it, over all of it.
const btScalar NEAR_COUNT = btScalar(0.25);
/// How much of the time by which a joint follows its support late is left after a step. The rest strains it.
const btScalar STILL_LATE = btScalar(0.995);
/// Below this share of a step it is in time.
const btScalar LEAST_LATE = btScalar(1e-3);
/// What has moved away from a sleeping joint for more steps than these has left it.
const btScalar MOST_LATE = 4;

bool isTimes(const btVector3& way, btScalar times, const btVector3& one)
{
	return (way - one * times).length2() <= LIKE * LIKE * way.length2();
}

bool isOnItsWay(const btRigidBody& body)
{
	return !(body.getLinearVelocity().isZero() && body.getAngularVelocity().isZero());
}
}  // namespace

int countSubsteps(const btTransform& from, const btRigidBody& body, btScalar step)
{
	const btVector3 &v = body.getLinearVelocity(), &w = body.getAngularVelocity();
	btVector3 linear, angular;
	btTransformUtil::calculateVelocity(from, body.getInterpolationWorldTransform(), step, linear, angular);
	const bool doesMove = !linear.isZero();
	const btScalar of = doesMove ? linear.length() : angular.length(), by = doesMove ? v.length() : w.length();
	if (!(of <= MOST_SUBSTEPS * by))
		return 0;
	const btScalar count = btScalar(floor(double(of / by) + 0.5));
	return isTimes(linear, count, v) && isTimes(angular, count, w) ? int(count) : 0;
}

btTransform placeBefore(const btTransform& place, const btRigidBody& body, btScalar time)
{
	btTransform before;
	btTransformUtil::integrateTransform(place, body.getLinearVelocity(), body.getAngularVelocity(), -time, before);
	return before;
}

void SupportWay::find()
{
	const btRigidBody* const body = m_model.support();
	Support& support = m_model.m_state.m_support;
	support = Support();
	support.m_kind = body ? Support::SEEN : Support::NONE;
	if (body)
		support.m_place = body->getCenterOfMassTransform();
}

bool SupportWay::mayBe(const btElasticPlasticState& state) { return state.m_support.m_kind != Support::NONE; }

// ---- the lead

/// 0: nobody knows.
int SupportWay::countSubsteps(const btRigidBody& body, btScalar step) const
{
	const Support& last = m_model.m_state.m_support;
	return last.m_kind == Support::SEEN ? btElasticPlastic::countSubsteps(last.m_place, body, step) : 0;
}

bool SupportWay::isShownAnew(const btRigidBody& body) const
{
	const Support& last = m_model.m_state.m_support;
	return last.m_kind != Support::SEEN || !(body.getInterpolationWorldTransform() == last.m_place);
}

/// Of the lead that it had as it was shown there.
btScalar SupportWay::leadLeft(btScalar step) const
{
	const btScalar left = m_model.m_state.m_support.m_lead - step;
	return left > step / 2 ? left : btScalar(0);
}

/// Without the joint's deformation.
btScalar SupportWay::leadBesideStep(const btRigidBody& body, btScalar step) const
{
	return isShownAnew(body) ? btScalar(btMax(countSubsteps(body, step) - 1, 0)) * step : leadLeft(step);
}

/// By how many substeps of its way the support is shown ahead of where the joint's last deformation has it.
/// \param left  gets what is left of that over the way of one
btScalar SupportWay::substepsTo(const btRigidBody& support, btScalar step, btScalar& left) const
{
	const btTransform& shown = support.getInterpolationWorldTransform();
	Kinematics atShown, atBefore;
	m_model.measureAt(atShown, shown);
	m_model.measureAt(atBefore, placeBefore(shown, support, step));
	const btScalar arm = atShown.m_rA.length() + atShown.m_rB.length();
	double along = 0, square = 0, sum = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		if (!m_model.isElasticPlastic(i))
			continue;
		const double scale = i < 3 ? 1 : double(arm), way = scale * double(atBefore.m_strain[i] - atShown.m_strain[i]),
					 gap = scale * double(m_model.elasticDeformation(i) - atShown.m_strain[i]);
		along += way * gap;
		square += way * way;
		sum += gap * gap;
	}
	if (!(square > 0))
		return 1;
	left = btScalar(sqrt(fmax(sum - along * along / square, 0) / square));
	return btScalar(along / square);
}

btScalar SupportWay::findLead(btScalar step) const
{
	const btRigidBody* const body = m_model.support();
	if (!body || !isKinematicAndAwake(*body))
		return 0;
	if (!isShownAnew(*body))
		return leadLeft(step);
	const int count = countSubsteps(*body, step);
	if (count == 1)
		return 0;
	btScalar left = 0;
	const btScalar measured = substepsTo(*body, step, left);
	if (count > 1)
		// Put elsewhere with all that stands on it, it has the velocity of a way that it does not go.
		return measured > btScalar(count) / 2 ? btScalar(count - 1) * step : btScalar(0);
	const btScalar nearest = btScalar(floor(double(measured) + 0.5));
	const bool isNear = nearest > 1 && btFabs(measured - nearest) < NEAR_COUNT && left < NEAR_COUNT * nearest;
	return isNear ? (nearest - 1) * step : btScalar(0);
}

btScalar SupportWay::getLate() const
{
	// It may have become another kind of body since.
	const btRigidBody* const body = m_model.support();
	return body && isKinematicAndAwake(*body) ? m_model.m_state.m_support.m_late : btScalar(0);
}

// ---- the end of a substep

bool SupportWay::follow(btScalar step, btScalar lead)
{
	Support& last = m_model.m_state.m_support;
	const bool isInStep = lead >= 0;
	const btRigidBody* const body = m_model.support();
	Support now;
	now.m_kind = body ? Support::SEEN : Support::NONE;
	if (body)
	{
		now.m_place = body->getCenterOfMassTransform();
		now.m_lead = isInStep ? lead : isKinematicAndAwake(*body) ? leadBesideStep(*body, step) : btScalar(0);
		now.m_late = isInStep ? last.m_late * STILL_LATE : last.m_late;
		if (now.m_late < LEAST_LATE * step)
			now.m_late = 0;
	}
	const bool hasMoved =
		last.m_kind != Support::NOT_SEEN && (last.m_kind != now.m_kind || !(last.m_place == now.m_place));
	// It goes on along its way, and is not to be found there at once by what wakes.
	const btRigidBody& other = body == &m_model.bodyA() ? m_model.bodyB() : m_model.bodyA();
	if (body && hasMoved && !isInStep && isKinematicAndAwake(*body) && isOnItsWay(*body) &&
		other.getActivationState() == ISLAND_SLEEPING)
		now.m_late = btMin(now.m_late + step, MOST_LATE * step);
	last = now;
	return hasMoved;
}

void SupportWay::keepAwake(bool hasMoved)
{
	for (btRigidBody* body : {&m_model.bodyA(), &m_model.bodyB()})
	{
		if (!body->isKinematicObject())
			continue;
		if (hasMoved && body->getActivationState() == ISLAND_SLEEPING)
			body->activate(true);
		else if (isOnItsWay(*body))
			body->setDeactivationTime(0);
	}
}
}  // namespace btElasticPlastic
