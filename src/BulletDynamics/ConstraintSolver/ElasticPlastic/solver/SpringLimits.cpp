// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "SpringLimits.h"

#include "BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
/// Of a body's mass or, as Bullet has it with all of the distance from the body's middle, of its inertia.
/// \param place  of the constraint on the body
btScalar inverseOf(const btRigidBody& body, const btVector3& place, const btVector3* axis)
{
	if (body.getInvMass() == 0 || !axis)
		return body.getInvMass();
	const btVector3 arm = place - body.getWorldTransform().getOrigin();
	return 1 / (arm.length2() / body.getInvMass() + 1 / (body.getInvInertiaTensorWorld() * *axis).length());
}

btScalar massOf(btGeneric6DofSpring2Constraint& constraint, int dof)
{
	const btVector3 axis = constraint.getAxis(btMax(dof - 3, 0));
	const btVector3* const about = dof < 3 ? nullptr : &axis;
	const btScalar inverse =
		inverseOf(constraint.getRigidBodyA(), constraint.getCalculatedTransformA().getOrigin(), about) +
		inverseOf(constraint.getRigidBodyB(), constraint.getCalculatedTransformB().getOrigin(), about);
	return inverse > 0 ? 1 / inverse : SIMD_INFINITY;
}
}  // namespace

SpringLimits::SpringLimits(btGeneric6DofSpring2Constraint& constraint, int dof, btScalar dt) : m_dt(dt)
{
	const btTranslationalLimitMotor2& linear = *constraint.getTranslationalLimitMotor();
	const btRotationalLimitMotor2* const angular = dof < 3 ? nullptr : constraint.getRotationalLimitMotor(dof - 3);
	m_limitsStiffness = angular ? angular->m_springStiffnessLimited : linear.m_springStiffnessLimited[dof];
	m_limitsDamping = angular ? angular->m_springDampingLimited : linear.m_springDampingLimited[dof];
	m_mass = m_limitsStiffness || m_limitsDamping ? massOf(constraint, dof) : SIMD_INFINITY;
}
}  // namespace btElasticPlastic
