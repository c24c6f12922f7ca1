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
/// More substeps than any frame has.
const btScalar MOST_SUBSTEPS = 100000;

bool isTimes(const btVector3& way, btScalar times, const btVector3& one)
{
	return (way - one * times).length2() <= LIKE * LIKE * way.length2();
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
}  // namespace btElasticPlastic
