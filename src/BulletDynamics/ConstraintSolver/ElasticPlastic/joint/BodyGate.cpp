// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "BodyGate.h"

#include <math.h>

namespace btElasticPlastic
{
namespace
{
/// The sum of numbers is finite only if all of them are.
bool isSumFinite(const btVector3& sum) { return btElasticPlasticIsFinite(sum.x() + sum.y() + sum.z()); }

bool isFinite(const btRigidBody& body)
{
	const btTransform& place = body.getCenterOfMassTransform();
	const btMatrix3x3 &basis = place.getBasis(), &inertia = body.getInvInertiaTensorWorld();
	return isSumFinite(body.getLinearVelocity() + body.getAngularVelocity() + body.getTotalForce() +
					   body.getTotalTorque() + body.getLinearFactor() + body.getAngularFactor() + place.getOrigin() +
					   basis[0] + basis[1] + basis[2] + inertia[0] + inertia[1] + inertia[2]) &&
		   btElasticPlasticIsFinite(body.getInvMass());
}

/// Whether a finite basis is that of a rotation, within a per cent: no axis is longer, and they span a cube.
bool isRotation(const btMatrix3x3& basis)
{
	const btScalar longest = btMax(basis[0].length2(), btMax(basis[1].length2(), basis[2].length2()));
	return longest < btScalar(1.02) && basis.determinant() > btScalar(0.97);
}
}  // namespace

bool isWellFormed(const btRigidBody& body)
{
	return isFinite(body) && isRotation(body.getCenterOfMassTransform().getBasis());
}

btElasticPlasticFault findMissingWorld(const btRigidBody& body, bool isBodyA)
{
	if (!(body.getInternalType() & btCollisionObject::CO_RIGID_BODY))
		return btElasticPlasticFault(isBodyA ? "btCollisionObject::getInternalType() of body A"
											 : "btCollisionObject::getInternalType() of body B",
									 btScalar(body.getInternalType()),
									 "2, that of a btRigidBody: tie a rigid body to a multibody's link by "
									 "btMultiBodyFixedConstraint, and join that");
	// A mass that is infinite or negative does not make a body static: Bullet looks for its island all the same.
	const bool isStill = body.getInvMass() == 0 && body.isStaticOrKinematicObject();
	if (isStill || body.getBroadphaseHandle())
		return btElasticPlasticFault();
	return btElasticPlasticFault(
		isBodyA ? "number of worlds that body A is in" : "number of worlds that body B is in", 0,
		"1: call btDynamicsWorld::addRigidBody before addJoint; the joint is left out of steps without it");
}

btElasticPlasticFault findBodyFault(const btRigidBody& body, bool isBodyA, bool isTurned)
{
	if (!isFinite(body))
		return btElasticPlasticFault(isBodyA ? "place, velocity, load, mass or inertia of body A"
											 : "place, velocity, load, mass or inertia of body B",
									 btScalar(NAN), "finite: the joint is left out of the steps in which it is not");
	const btMatrix3x3& basis = body.getCenterOfMassTransform().getBasis();
	if (!isRotation(basis))
		return btElasticPlasticFault(
			isBodyA ? "determinant of the basis of body A" : "determinant of the basis of body B", basis.determinant(),
			"1, the basis that of a rotation: the joint is left out of the steps in which it is not");
	if (body.getInvMass() == 0)
		return btElasticPlasticFault();
	// Bullet's solvers would move it, and threads of ours at the same time.
	if (body.isStaticObject())
		return btElasticPlasticFault(
			isBodyA ? "mass of body A, a static one [kg]" : "mass of body B, a static one [kg]", 1 / body.getInvMass(),
			"0: call btRigidBody::setMassProps; the joint is left out of steps until then");
	if (const btElasticPlasticFault fault = findMissingWorld(body, isBodyA))
		return fault;
	const btVector3& inverse = body.getInvInertiaDiagLocal();
	if (isTurned && !(inverse.x() > 0 && inverse.y() > 0 && inverse.z() > 0))
		return btElasticPlasticFault(
			isBodyA ? "smallest inertia of body A [kg m^2]" : "smallest inertia of body B [kg m^2]", 0,
			"greater than 0 for a body with mass: use btCollisionShape::calculateLocalInertia");
	return btElasticPlasticFault();
}
}  // namespace btElasticPlastic
