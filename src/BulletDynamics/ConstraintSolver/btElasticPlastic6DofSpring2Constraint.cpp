// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlastic6DofSpring2Constraint.h"

btElasticPlastic6DofSpring2Constraint::btElasticPlastic6DofSpring2Constraint(btRigidBody& rbA, btRigidBody& rbB,
																			 const btTransform& frameInA,
																			 const btTransform& frameInB,
																			 RotateOrder rotOrder)
	: btElasticPlasticConstraint(rbA, rbB, frameInA, frameInB, rotOrder)
{
}

btElasticPlastic6DofSpring2Constraint::btElasticPlastic6DofSpring2Constraint(btRigidBody& rbB,
																			 const btTransform& frameInB,
																			 RotateOrder rotOrder)
	: btElasticPlasticConstraint(rbB, frameInB, rotOrder)
{
}

void btElasticPlastic6DofSpring2Constraint::releaseBase(int dof)
{
	setLimit(dof, 1, -1);
	enableSpring(dof, false);
	enableMotor(dof, false);
}

bool btElasticPlastic6DofSpring2Constraint::isBaseActive()
{
	for (int i = 0; i < 3; ++i)
		if (m_linearLimits.isLimited(i) || m_linearLimits.m_enableMotor[i] || m_linearLimits.m_enableSpring[i] ||
			m_angularLimits[i].isLimited() || m_angularLimits[i].m_enableMotor || m_angularLimits[i].m_enableSpring)
			return true;
	return false;
}

void btElasticPlastic6DofSpring2Constraint::lock(void* data) const
{
	lockInFile(*static_cast<btGeneric6DofSpring2ConstraintData2*>(data));
}
