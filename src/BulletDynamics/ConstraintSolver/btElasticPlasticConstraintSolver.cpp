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

#include "btElasticPlasticConstraintSolver.h"

void btElasticPlasticConstraintSolver::convertJoints(btTypedConstraint** constraints, int numConstraints,
													 const btContactSolverInfo& info)
{
	m_jointRows.resize(0);
	for (int i = 0; i < numConstraints; ++i)
		if (btElasticPlasticJoint* joint = btElasticPlasticJoint::from(constraints[i]))
		{
			joint->requestImplicitRows();
			const JointRows rows = {joint, i, 0};
			m_jointRows.push_back(rows);
		}

	btSequentialImpulseConstraintSolver::convertJoints(constraints, numConstraints, info);

	int end = 0;
	for (int i = 0, j = 0; j < m_jointRows.size(); ++i)
	{
		end += m_tmpConstraintSizesPool[i].m_numConstraintRows;
		JointRows& rows = m_jointRows[j];
		if (rows.m_firstRow != i)
			continue;
		// The joint's own rows are the last of its constraint's.
		rows.m_rows = rows.m_joint->getNumRows();
		rows.m_firstRow = end - rows.m_rows;
		for (int r = rows.m_firstRow; r < end; ++r)
		{
			btSolverConstraint& row = m_tmpSolverNonContactConstraintPool[r];
			const btScalar scale = 1 / (1 + row.m_cfm);
			row.m_jacDiagABInv *= scale;
			row.m_rhs *= scale;
			row.m_cfm *= scale;
		}
		++j;
	}
}

btScalar btElasticPlasticConstraintSolver::solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int numBodies,
																		 const btContactSolverInfo& info)
{
	for (int j = 0; j < m_jointRows.size(); ++j)
		for (int r = 0; r < m_jointRows[j].m_rows; ++r)
			m_jointRows[j].m_joint->setRowImpulse(
				r, m_tmpSolverNonContactConstraintPool[m_jointRows[j].m_firstRow + r].m_appliedImpulse);
	return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyFinish(bodies, numBodies, info);
}
