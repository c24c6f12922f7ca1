// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlastic6DofSpringConstraint.h"

btElasticPlastic6DofSpringConstraint::btElasticPlastic6DofSpringConstraint(btRigidBody& rbA, btRigidBody& rbB,
																		   const btTransform& frameInA,
																		   const btTransform& frameInB,
																		   bool useLinearReferenceFrameA)
	: btElasticPlasticConstraint(rbA, rbB, frameInA, frameInB, useLinearReferenceFrameA)
{
}

btElasticPlastic6DofSpringConstraint::btElasticPlastic6DofSpringConstraint(btRigidBody& rbB,
																		   const btTransform& frameInB,
																		   bool useLinearReferenceFrameB)
	: btElasticPlasticConstraint(rbB, frameInB, useLinearReferenceFrameB)
{
}

void btElasticPlastic6DofSpringConstraint::releaseBase(int dof)
{
	setLimit(dof, 1, -1);
	enableSpring(dof, false);
}

bool btElasticPlastic6DofSpringConstraint::isBaseActive()
{
	for (int i = 0; i < 3; ++i)
		if (m_linearLimits.isLimited(i) || m_linearLimits.m_enableMotor[i] || m_angularLimits[i].isLimited() ||
			m_angularLimits[i].m_enableMotor)
			return true;
	return false;
}

void btElasticPlastic6DofSpringConstraint::lock(void* data) const
{
	lockInFile(static_cast<btGeneric6DofSpringConstraintData2*>(data)->m_6dofData);
}
