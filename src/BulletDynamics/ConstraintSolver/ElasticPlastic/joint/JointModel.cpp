// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "JointModel.h"

#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
btTransform JointModel::frameA() const { return bodyA().getCenterOfMassTransform() * m_frameInA; }
btTransform JointModel::frameB() const { return bodyB().getCenterOfMassTransform() * m_frameInB; }

void JointModel::measure(Kinematics& kinematics) const
{
	kinematics.evaluate(bodyA().getCenterOfMassTransform(), bodyB().getCenterOfMassTransform(), m_frameInA, m_frameInB,
						m_state.offset(), m_state.m_plasticRotation, m_state.m_plasticMiddle);
}

RelativeRotation JointModel::relativeRotation() const
{
	return RelativeRotation(frameA().getBasis(), frameB().getBasis(), m_state.m_plasticRotation,
							m_state.m_plasticMiddle);
}

btElasticPlasticFault JointModel::findFault() const
{
	if (const btElasticPlasticFault fault = m_capacity.fault())
		return fault;
	const btRigidBody* const bodies[2] = {&bodyA(), &bodyB()};
	if (bodies[0]->getInvMass() == 0 && bodies[1]->getInvMass() == 0)
		return btElasticPlasticFault("number of bodies with mass", 0, "1 or 2: two static bodies cannot be joined");
	for (int i = 3; i < BT_EP_DOF_COUNT; ++i)
		for (int b = 0; b < 2 && m_capacity.isElasticPlastic(i); ++b)
		{
			const btVector3& inverse = bodies[b]->getInvInertiaDiagLocal();
			if (bodies[b]->getInvMass() == 0 || (inverse.x() > 0 && inverse.y() > 0 && inverse.z() > 0))
				continue;
			return btElasticPlasticFault(
				b == 0 ? "smallest inertia of body A [kg m^2]" : "smallest inertia of body B [kg m^2]", 0,
				"greater than 0 for a body with mass: use btCollisionShape::calculateLocalInertia", i);
		}
	return btElasticPlasticFault();
}

void JointModel::takeCapacity()
{
	const unsigned before = m_dofs;
	m_dofs = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (m_capacity.isElasticPlastic(i))
			m_dofs |= 1u << i;
		else
			m_state.m_force[i] = m_state.m_applied[i] = m_state.m_forceRate[i] = 0;
	if (!m_hasReference)
		takeRoundingAsReference();
	else if (m_dofs & ~before)
		takePoseAsReference(m_dofs & ~before);
	m_hasReference = true;
}

/// Degrees of freedom that were free for a while and hold again do so where they stand.
void JointModel::takePoseAsReference(unsigned dofs)
{
	Kinematics now;
	measure(now);
	btScalar away[BT_EP_DOF_COUNT] = {};
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (dofs >> i & 1u)
			away[i] = now.m_strain[i];
	for (int i = 0; i < 3; ++i)
		m_state.m_initial[i] += away[i];
	if (dofs >> 3)
		turnReference(away);
}

/// Frames that meet up to the rounding of their coordinates are meant to meet: in float half a micrometre on a metre would
/// be a force in a stiff joint. A larger misfit is the user's, and loads the joint.
void JointModel::takeRoundingAsReference()
{
	const btScalar size = bodyA().getCenterOfMassPosition().length() + m_frameInA.getOrigin().length() +
						  bodyB().getCenterOfMassPosition().length() + m_frameInB.getOrigin().length();
	Kinematics now;
	measure(now);
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		// Eight roundings lie between the world's coordinates and a strain.
		if (btFabs(now.m_strain[i]) > 4 * SIMD_EPSILON * (i < 3 ? size : 1))
			return;
	setReferenceToCurrentPose();
}

void JointModel::setReferenceToCurrentPose()
{
	Kinematics now;
	measure(now);
	const RelativeRotation rotation = relativeRotation();
	for (int i = 0; i < 3; ++i)
		m_state.m_initial[i] += now.m_strain[i];
	m_state.m_plasticRotation = rotation.m_relative;
	m_state.m_plasticMiddle = rotation.m_middle;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		m_state.m_force[i] = m_state.m_applied[i] = m_state.m_forceRate[i] = 0;
}

void JointModel::turnReference(const btScalar increment[BT_EP_DOF_COUNT])
{
	Kinematics now;
	measure(now);
	const RelativeRotation rotation = relativeRotation();
	const btVector3 elastic(now.m_strain[3] - increment[3], now.m_strain[4] - increment[4],
							now.m_strain[5] - increment[5]);
	m_state.m_plasticRotation = (exponential(-quatRotate(rotation.m_middle, elastic)) * rotation.m_relative).normalized();
	m_state.m_plasticMiddle = (rotation.m_middle * exponential(elastic * btScalar(-0.5))).normalized();
}
}  // namespace btElasticPlastic
