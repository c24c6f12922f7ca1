// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "KinematicLead.h"

#include <math.h>

#include "LinearMath/btTransformUtil.h"

namespace btElasticPlastic
{
namespace
{
/// A way is that of a number of substeps if it is so to this share.
const btScalar LIKE = btScalar(1e-2);
/// More substeps than any frame has. What is so much further away has been put there, and not moved.
const btScalar MOST_SUBSTEPS = 240;

bool isTimes(const btVector3& way, btScalar times, const btVector3& one)
{
	return (way - one * times).length2() <= LIKE * LIKE * way.length2();
}

/// In how many substeps a body goes a way at its velocity, 1 if it does not.
btScalar countSubsteps(const btTransform& from, const btRigidBody& body, btScalar step)
{
	const btVector3 &v = body.getLinearVelocity(), &w = body.getAngularVelocity();
	btVector3 linear, angular;
	btTransformUtil::calculateVelocity(from, body.getInterpolationWorldTransform(), step, linear, angular);
	const bool doesMove = !linear.isZero();
	const btScalar of = doesMove ? linear.length() : angular.length(), by = doesMove ? v.length() : w.length();
	if (!(of <= MOST_SUBSTEPS * by))
		return 1;
	const btScalar count = btScalar(floor(double(of / by) + 0.5));
	return count > 1 && isTimes(linear, count, v) && isTimes(angular, count, w) ? count : btScalar(1);
}
}  // namespace

btScalar kinematicLead(const btElasticPlasticState::Support& support, const btRigidBody& body, btScalar step)
{
	// Bullet takes over no motion of one that sleeps.
	if (support.m_kind != btElasticPlasticState::Support::SEEN || body.getActivationState() == ISLAND_SLEEPING)
		return 0;
	if (!(body.getInterpolationWorldTransform() == support.m_place))
		return (countSubsteps(support.m_place, body, step) - 1) * step;
	const btScalar left = support.m_lead - step;
	return left > step / 2 ? left : btScalar(0);
}

btTransform placeBeforeLead(const btRigidBody& body, btScalar lead)
{
	btTransform place = body.getCenterOfMassTransform();
	if (lead > 0)
		btTransformUtil::integrateTransform(body.getCenterOfMassTransform(), body.getLinearVelocity(),
											body.getAngularVelocity(), -lead, place);
	return place;
}
}  // namespace btElasticPlastic
