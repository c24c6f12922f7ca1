// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "TensionDamping.h"

#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
/// Below this (w dt)^2 the explicit stiffness is far from its limit of 4.
const btScalar RESOLVED = 1;
/// Of z at which damping has to grow, a quarter of what a row of equal blocks bears.
const btScalar LIMIT = 20;

/// How easily two equal bodies, both like the one that turns less easily, would turn against each other about an axis
/// [1 / (kg m^2)].
btScalar mobilityAbout(const btRigidBody& a, const btRigidBody& b, const btVector3& axis)
{
	return 2 * btMin(axis.dot(a.getInvInertiaTensorWorld() * axis), axis.dot(b.getInvInertiaTensorWorld() * axis));
}
}  // namespace

TensionDamping TensionDamping::of(const JointModel& model, const Kinematics& k, btScalar dt)
{
	TensionDamping damping;
	const btRigidBody &A = model.bodyA(), &B = model.bodyB();
	if (A.getInvMass() == 0 || B.getInvMass() == 0 || A.isKinematicObject() || B.isKinematicObject())
		return damping;
	const btVector3 chord = k.m_rA - k.m_rB;
	const btScalar length = chord.length();
	if (!(length > 0))
		return damping;
	const btVector3 along = chord / length;
	const btScalar *const force = model.m_state.m_force, armA = k.m_rA.dot(along), armB = -k.m_rB.dot(along);
	const btScalar tension = (k.m_axis[0] * force[0] + k.m_axis[1] * force[1] + k.m_axis[2] * force[2]).dot(along);
	// Where shear and bending are coupled, bodies turn about the middle of what is elastic as long as bending does not flow.
	btScalar leverage = btMax(btScalar(0), armA) * btMax(btScalar(0), armB);
	for (int shear = BT_EP_SHEAR_Y; shear <= BT_EP_SHEAR_Z; ++shear)
	{
		const btScalar shift = model.m_capacity.elasticMiddle(shear) * k.m_axis[0].dot(along);
		btSetMax(leverage, btMax(btScalar(0), armA + shift) * btMax(btScalar(0), armB - shift));
	}
	if (!(tension > 0 && leverage > 0))
		return damping;
	const btScalar stiffness = tension * leverage / length;
	btPlaneSpace1(along, damping.m_across[0], damping.m_across[1]);
	const btScalar mobility = btMax(mobilityAbout(A, B, damping.m_across[0]), mobilityAbout(A, B, damping.m_across[1]));
	const btScalar z = 2 * stiffness * dt * dt * mobility;
	if (z > RESOLVED && btElasticPlasticIsFinite(z))
		damping.m_factor = stiffness * dt * dt * btMax(btScalar(1), z / LIMIT);
	return damping;
}
}  // namespace btElasticPlastic
