/*
Bullet Elastic-Plastic: joints for Bullet Physics that bend before they break
Copyright (c) 2026 Bullet Elastic-Plastic contributors

This software is provided 'as-is', without any express or implied warranty.
In no event will the authors be held liable for any damages arising from the use of this software.
Permission is granted to anyone to use this software for any purpose,
including commercial applications, and to alter it and redistribute it freely,
subject to the following restrictions:

1. The origin of this software must not be misrepresented; you must not claim that you wrote the original software. If you use this software in a product, an acknowledgment in the product documentation would be appreciated but is not required.
2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the original software.
3. This notice may not be removed or altered from any source distribution.
*/

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
