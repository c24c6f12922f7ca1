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
