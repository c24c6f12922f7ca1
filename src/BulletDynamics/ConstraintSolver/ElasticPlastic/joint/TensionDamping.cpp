// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "TensionDamping.h"

#include "JoinedVelocity.h"

namespace btElasticPlastic
{
namespace
{
/// Below this (w dt)^2 the explicit stiffness is far from its limit of 4.
const btScalar RESOLVED = 1;
/// Of z at which damping has to grow, a quarter of what a row of equal blocks bears.
const btScalar LIMIT = 20;
/// Of g in the inertia about the line, below which spin grows by less than a ten thousandth in a step: the force is within some
/// hundredths of a radian along the arm.
const btScalar SLIGHT = btScalar(0.01);
/// Rounding does not take a bound below this share of what it bounds.
const btScalar NEARLY = btScalar(0.99);

bool moves(const btRigidBody& body) { return body.getInvMass() > 0 && !body.isKinematicObject(); }

/// [1 / (kg m^2)], 0 of what does not move
btScalar mobilityAbout(const btRigidBody& body, const btVector3& axis)
{
	return moves(body) ? axis.dot(body.getInvInertiaTensorWorld() * axis) : btScalar(0);
}

/// How easily two equal bodies, both like the one that turns less easily, would turn against each other about an axis
/// [1 / (kg m^2)].
btScalar mobilityAbout(const btRigidBody& a, const btRigidBody& b, const btVector3& axis)
{
	return 2 * btMin(mobilityAbout(a, axis), mobilityAbout(b, axis));
}

/// What the joint's own rows bear of a turn about an axis: their stiffness, or what yields within a radian [N m].
btScalar stiffnessAbout(const JointModel& model, const Kinematics& k, const btVector3& axis)
{
	btScalar sum = 0;
	for (int dof = BT_EP_TORSION; dof < BT_EP_DOF_COUNT; ++dof)
	{
		const btScalar share = axis.dot(k.m_axis[dof - 3]);
		sum += share * share * model.momentWithinARadian(dof);
	}
	return sum;
}
/// Bounds of what decides on damping, from which most joints are far: no mobility is above the sum of the three about the body's own
/// axes, and no product of the two arms above a quarter of the chord's square.
class GreatestShares
{
public:
	GreatestShares(const JointModel& model, const Kinematics& k, const btVector3& force, btScalar dt)
		: m_a(sumOfMobilities(model.bodyA())), m_b(sumOfMobilities(model.bodyB()))
	{
		const btScalar spinA = spinOf(model.bodyA()).length2() * k.m_rA.length2(),
					   spinB = spinOf(model.bodyB()).length2() * k.m_rB.length2(), impulse2 = force.length2() * dt * dt;
		m_across2 = impulse2 * dt * dt * (k.m_rA - k.m_rB).length2();
		// (a + b)^2 <= 2 (a^2 + b^2)
		m_along2 = impulse2 * dt * dt * dt * dt * (spinA + spinB) / 8;
	}

	// Not below what is not a number.
	bool isAcross() const { return !(m_across2 * square(btMin(m_a, m_b)) < square(NEARLY * RESOLVED)); }
	bool isAlong() const { return !(m_along2 * square(btMax(m_a, m_b)) < square(NEARLY * SLIGHT)); }

private:
	static btScalar square(btScalar x) { return x * x; }
	static btScalar sumOfMobilities(const btRigidBody& body)
	{
		const btVector3& own = body.getInvInertiaDiagLocal();
		return moves(body) ? own.x() + own.y() + own.z() : btScalar(0);
	}

	btScalar m_a, m_b, m_across2, m_along2;
};
}  // namespace

void TensionDamping::add(const btVector3& axis, btScalar factor) { m_row[m_numRows++] = {axis, factor}; }

void TensionDamping::addAcross(const JointModel& model, const Kinematics& k, const btVector3& force, btScalar dt)
{
	const btRigidBody &A = model.bodyA(), &B = model.bodyB();
	if (!moves(A) || !moves(B))
		return;
	const btVector3 chord = k.m_rA - k.m_rB;
	const btScalar length = chord.length();
	const btVector3 along = chord / length;
	const btScalar armA = k.m_rA.dot(along), armB = -k.m_rB.dot(along), tension = force.dot(along);
	if (!(tension > 0))
		return;
	// Where shear and bending are coupled, bodies turn about the middle of what is elastic as long as bending does not flow.
	btScalar leverage = btMax(btScalar(0), armA) * btMax(btScalar(0), armB);
	for (int shear = BT_EP_SHEAR_Y; shear <= BT_EP_SHEAR_Z; ++shear)
	{
		const btScalar shift = model.m_capacity.elasticMiddle(shear) * k.m_axis[0].dot(along);
		btSetMax(leverage, btMax(btScalar(0), armA + shift) * btMax(btScalar(0), armB - shift));
	}
	if (!(leverage > 0))
		return;
	const btScalar stiffness = tension * leverage / length;
	btVector3 across[2];
	btPlaneSpace1(along, across[0], across[1]);
	const btScalar mobility = btMax(mobilityAbout(A, B, across[0]), mobilityAbout(A, B, across[1]));
	const btScalar z = 2 * stiffness * dt * dt * mobility;
	if (!(z > RESOLVED && btElasticPlasticIsFinite(z)))
		return;
	for (const btVector3& axis : across)
		add(axis, stiffness * dt * dt * btMax(btScalar(1), z / LIMIT));
}

void TensionDamping::addAlong(const JointModel& model, const Kinematics& k, const btVector3& force, btScalar dt)
{
	const btRigidBody &A = model.bodyA(), &B = model.bodyB();
	const btScalar swing = spinOf(A).cross(k.m_rA).length() + spinOf(B).cross(k.m_rB).length();
	const btScalar factor = dt * dt * dt * force.length() * swing / 4;
	if (!(factor > 0))
		return;
	const btVector3 along = (k.m_rA - k.m_rB).normalized();
	const btScalar share = factor * btMax(mobilityAbout(A, along), mobilityAbout(B, along));
	if (share > SLIGHT && btElasticPlasticIsFinite(share) && stiffnessAbout(model, k, along) * dt * dt < factor)
		add(along, factor);
}

TensionDamping TensionDamping::of(const JointModel& model, const Kinematics& k, const btScalar force[3], btScalar dt)
{
	TensionDamping damping;
	if (!((k.m_rA - k.m_rB).length2() > 0))
		return damping;
	const btVector3 sum = k.m_axis[0] * force[0] + k.m_axis[1] * force[1] + k.m_axis[2] * force[2];
	const GreatestShares greatest(model, k, sum, dt);
	if (greatest.isAcross())
		damping.addAcross(model, k, sum, dt);
	if (greatest.isAlong())
		damping.addAlong(model, k, sum, dt);
	return damping;
}
}  // namespace btElasticPlastic
