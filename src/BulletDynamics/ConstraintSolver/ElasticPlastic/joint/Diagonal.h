// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_DIAGONAL_H
#define BT_ELASTIC_PLASTIC_DIAGONAL_H

#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
/// A = J M^-1 J^T of a joint's rows.
class Diagonal
{
public:
	Diagonal(const btRigidBody& a, const btRigidBody& b)
		: m_a(a.getInvInertiaTensorWorld()),
		  m_b(b.getInvInertiaTensorWorld()),
		  m_both(m_a + m_b),
		  m_inverseMass(a.getInvMass() + b.getInvMass())
	{
	}

	/// A of a row along an axis that has these moments about the bodies' centres of mass.
	btScalar along(const btVector3& momentA, const btVector3& momentB) const
	{
		return m_inverseMass + momentA.dot(m_a * momentA) + momentB.dot(m_b * momentB);
	}
	btScalar about(const btVector3& axis) const { return axis.dot(m_both * axis); }

private:
	const btMatrix3x3 &m_a, &m_b;
	const btMatrix3x3 m_both;
	const btScalar m_inverseMass;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_DIAGONAL_H
