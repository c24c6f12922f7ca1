// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "SweptRows.h"

#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
void SweptRows::clear(btScalar share)
{
	m_share = share;
	m_constraints.resize(0);
	m_contacts.resize(0);
	m_friction.resize(0);
	m_rollingFriction.resize(0);
}

template <class Visit>
void SweptRows::forAll(const SolverPools& pools, Visit visit) const
{
	const struct
	{
		btConstraintArray& m_pool;
		const btAlignedObjectArray<int>& m_rows;
	} kinds[] = {{pools.m_constraints, m_constraints},
				 {pools.m_contacts, m_contacts},
				 {pools.m_friction, m_friction},
				 {pools.m_rollingFriction, m_rollingFriction}};
	for (const auto& kind : kinds)
		for (int i = 0; i < kind.m_rows.size(); ++i)
		{
			btSolverConstraint& row = kind.m_pool[kind.m_rows[i]];
			if (row.m_appliedImpulse != 0)
				visit(row, pools.m_bodies[row.m_solverBodyIdA], pools.m_bodies[row.m_solverBodyIdB]);
		}
}

double SweptRows::findMade(const SolverPools& pools) const
{
	double made = 0;
	forAll(pools,
		   [&](const btSolverConstraint& row, const btSolverBody& A, const btSolverBody& B)
		   {
			   const btScalar along = row.m_contactNormal1.dot(A.m_deltaLinearVelocity) +
									  row.m_relpos1CrossNormal.dot(A.m_deltaAngularVelocity) +
									  row.m_contactNormal2.dot(B.m_deltaLinearVelocity) +
									  row.m_relpos2CrossNormal.dot(B.m_deltaAngularVelocity);
			   // The row in Bullet's terms, see DirectForm::addRow().
			   const double impulse = row.m_appliedImpulse,
							asked = double(row.m_rhs) - 0.5 * double(row.m_cfm) * impulse;
			   made += impulse * (0.5 * double(along) - asked / double(row.m_jacDiagABInv));
		   });
	return made;
}

void SweptRows::takeBack(const SolverPools& pools) const
{
	forAll(pools,
		   [](btSolverConstraint& row, btSolverBody& A, btSolverBody& B)
		   {
			   A.internalApplyImpulse(row.m_contactNormal1 * A.internalGetInvMass(), row.m_angularComponentA,
									  -row.m_appliedImpulse);
			   B.internalApplyImpulse(row.m_contactNormal2 * B.internalGetInvMass(), row.m_angularComponentB,
									  -row.m_appliedImpulse);
			   row.m_appliedImpulse = 0;
		   });
}

void SweptRows::sweep(const SolverPools& pools, const RowSolvers& solvers) const
{
	btAlignedObjectArray<btSolverBody>& bodies = pools.m_bodies;
	for (int i = 0; i < m_constraints.size(); ++i)
	{
		const btSolverConstraint& row = pools.m_constraints[m_constraints[i]];
		solvers.m_generic(bodies[row.m_solverBodyIdA], bodies[row.m_solverBodyIdB], row);
	}
	for (int i = 0; i < m_contacts.size(); ++i)
	{
		const btSolverConstraint& row = pools.m_contacts[m_contacts[i]];
		solvers.m_lowerLimit(bodies[row.m_solverBodyIdA], bodies[row.m_solverBodyIdB], row);
	}
	// Bullet holds friction to what the normal impulse is in the same sweep, and rolling friction to its coefficient, too. It leaves
	// friction as it was where the normal impulse has come to 0; here it is taken back.
	const auto sweepFriction = [&](btConstraintArray& pool, const btAlignedObjectArray<int>& rows, bool isRolling)
	{
		for (int i = 0; i < rows.size(); ++i)
		{
			btSolverConstraint& row = pool[rows[i]];
			const btScalar normal =
				btMax(btScalar(0), btScalar(pools.m_contacts[row.m_frictionIndex].m_appliedImpulse));
			if (normal == 0 && btScalar(row.m_appliedImpulse) == 0)
				continue;
			row.m_upperLimit = row.m_friction * normal;
			if (isRolling)
				btSetMin(row.m_upperLimit, row.m_friction * m_share);
			row.m_lowerLimit = -row.m_upperLimit;
			solvers.m_generic(bodies[row.m_solverBodyIdA], bodies[row.m_solverBodyIdB], row);
		}
	};
	sweepFriction(pools.m_friction, m_friction, false);
	sweepFriction(pools.m_rollingFriction, m_rollingFriction, true);
}
}  // namespace btElasticPlastic
