// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "IterativeForm.h"

#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
/// A and J v of a row, external forces included.
struct RowMotion
{
	btScalar m_diagonal, m_velocity;

	RowMotion(const btSolverConstraint& row, const JointModel& model, const SolverPools& pools)
	{
		if (row.m_jacDiagABInv > 0)
		{
			m_diagonal = 1 / row.m_jacDiagABInv;
			m_velocity = -row.m_rhs * m_diagonal;
			return;
		}
		// Bullet sets 1 / A to 0 where A <= SIMD_EPSILON, in float for two bodies of 8000 t: A and J v are computed here.
		const btSolverBody &A = pools.m_bodies[row.m_solverBodyIdA], &B = pools.m_bodies[row.m_solverBodyIdB];
		m_diagonal = row.m_contactNormal1.length2() * model.bodyA().getInvMass() +
					 row.m_contactNormal2.length2() * model.bodyB().getInvMass() +
					 row.m_angularComponentA.dot(row.m_relpos1CrossNormal) +
					 row.m_angularComponentB.dot(row.m_relpos2CrossNormal);
		m_velocity = row.m_contactNormal1.dot(A.m_linearVelocity + A.m_externalForceImpulse) +
					 row.m_relpos1CrossNormal.dot(A.m_angularVelocity + A.m_externalTorqueImpulse) +
					 row.m_contactNormal2.dot(B.m_linearVelocity + B.m_externalForceImpulse) +
					 row.m_relpos2CrossNormal.dot(B.m_angularVelocity + B.m_externalTorqueImpulse);
	}
};
}  // namespace

/// With these terms Bullet's iteration is: impulse += (r - J v - C impulse - J dv) / (A + C).
void IterativeForm::addJoint(JointWorks& joint, int firstRow, const SolverPools& pools, btScalar erp)
{
	JointStep& step = joint.m_step;
	const bool hasFibres = step.usesFibres() && step.getNumRows() > 0;
	if (hasFibres)
		step.beginFibres(m_rows);
	const int numPlain = step.getNumPlainRows();
	for (int r = 0; r < numPlain; ++r)
	{
		btSolverConstraint& row = pools.m_constraints[firstRow + r];
		const RowMotion motion(row, joint.m_model, pools);
		const SoftRow soft = step.makeRow(r, motion.m_diagonal, erp, false);
		row.m_jacDiagABInv = 1 / (motion.m_diagonal + soft.m_compliance);
		row.m_rhs = (soft.m_velocity - motion.m_velocity) * row.m_jacDiagABInv;
		row.m_cfm = soft.m_compliance * row.m_jacDiagABInv;
		// Bullet has already set the bounds to the breaking threshold, if there is one.
		btSetMax(row.m_lowerLimit, soft.m_lower);
		btSetMin(row.m_upperLimit, soft.m_upper);
	}
	const Joint entry = {&joint, firstRow, hasFibres ? int(m_numBlocks) : -1};
	m_joints.push_back(entry);
	if (!hasFibres)
		return;
	if (m_numBlocks == m_blocks.size())
		m_blocks.emplace_back();
	m_blocks[m_numBlocks++].begin(m_rows, firstRow + numPlain, pools);
}

btScalar IterativeForm::solveFibres(int iteration, const SolverPools& pools)
{
	btScalar largest = 0;
	for (size_t i = 0; i < m_numBlocks; ++i)
		if (m_blocks[i].isIn(iteration, pools))
			btSetMax(largest, m_blocks[i].solve(pools));
	return largest;
}

void IterativeForm::cancel()
{
	for (int j = 0; j < m_joints.size(); ++j)
		m_joints[j].m_works->m_step.revert();
	clear();
}

void IterativeForm::finish(const SolverPools& pools)
{
	for (int j = 0; j < m_joints.size(); ++j)
	{
		const Joint& joint = m_joints[j];
		JointStep& step = joint.m_works->m_step;
		for (int r = 0; r < step.getNumRows(); ++r)
			step.setImpulse(r, pools.m_constraints[joint.m_firstRow + r].m_appliedImpulse);
		if (joint.m_block >= 0)
			step.setFibres(m_blocks[size_t(joint.m_block)].getImpulses(), m_blocks[size_t(joint.m_block)].getBounds());
	}
}
}  // namespace btElasticPlastic
