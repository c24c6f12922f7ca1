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
		for (int r = 0; r < rows.m_rows; ++r)
			makeSoft(m_tmpSolverNonContactConstraintPool[rows.m_firstRow + r], *rows.m_joint, r, info);
		++j;
	}
}

/// Bullet has made J, A and -J v / A of the row; the rest comes from the joint:
/// impulse += (r - J v - C impulse - J dv) / (A + C).
void btElasticPlasticConstraintSolver::makeSoft(btSolverConstraint& row, btElasticPlasticJoint& joint, int r,
												const btContactSolverInfo& info)
{
	const btScalar a = 1 / row.m_jacDiagABInv;
	const btElasticPlasticRow& soft = joint.implicitRow(r, a, info.m_erp);
	row.m_jacDiagABInv = 1 / (a + soft.m_compliance);
	row.m_rhs = (row.m_rhs * a + soft.m_velocity) * row.m_jacDiagABInv;
	row.m_cfm = soft.m_compliance * row.m_jacDiagABInv;
	// Bullet has put the breaking threshold there, if the user wants that too.
	btSetMax(row.m_lowerLimit, soft.m_lower);
	btSetMin(row.m_upperLimit, soft.m_upper);
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
