// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "RigidMotion.h"

#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
btVector3 RigidMotion::Part::angularMomentum(const btVector3& spin) const
{
	const btMatrix3x3& basis = m_pose.getBasis();
	const btVector3& inverse = m_body->getInvInertiaDiagLocal();
	btVector3 local = spin * basis;
	for (int i = 0; i < 3; ++i)
		local[i] = inverse[i] > 0 ? local[i] / inverse[i] : btScalar(0);
	return basis * local;
}

RigidMotion RigidMotion::of(const btRigidBody& body)
{
	RigidMotion motion;
	motion.m_centre = body.getCenterOfMassPosition();
	motion.m_velocity = body.getLinearVelocity();
	motion.m_spin = body.getAngularVelocity();
	return motion;
}

RigidMotion RigidMotion::ofHeld(const btRigidBody& body) { return body.isKinematicObject() ? of(body) : RigidMotion(); }

RigidMotion RigidMotion::of(const Part* parts, int numParts)
{
	RigidMotion motion;
	btScalar mass = 0;
	for (int i = 0; i < numParts; ++i)
	{
		const btScalar own = 1 / parts[i].m_body->getInvMass();
		mass += own;
		motion.m_centre += parts[i].m_pose.getOrigin() * own;
		motion.m_velocity += parts[i].m_velocity * own;
	}
	motion.m_centre /= mass;
	motion.m_velocity /= mass;
	btMatrix3x3 inertia(0, 0, 0, 0, 0, 0, 0, 0, 0);
	btVector3 momentum(0, 0, 0);
	for (int i = 0; i < numParts; ++i)
	{
		const Part& part = parts[i];
		const btScalar own = 1 / part.m_body->getInvMass();
		const btVector3 arm = part.m_pose.getOrigin() - motion.m_centre;
		momentum += arm.cross((part.m_velocity - motion.m_velocity) * own) + part.angularMomentum(part.m_spin);
		for (int axis = 0; axis < 3; ++axis)
		{
			btVector3 unit(0, 0, 0);
			unit[axis] = 1;
			const btVector3 column = arm.cross(unit.cross(arm)) * own + part.angularMomentum(unit);
			for (int row = 0; row < 3; ++row)
				inertia[row][axis] += column[row];
		}
	}
	if (inertia.determinant() > 0)
		motion.m_spin = inertia.inverse() * momentum;
	return motion;
}
}  // namespace btElasticPlastic
