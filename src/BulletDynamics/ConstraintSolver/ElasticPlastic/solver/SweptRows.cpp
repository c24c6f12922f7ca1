// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "SweptRows.h"

#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
void SweptRows::clear()
{
	m_constraints.resize(0);
	m_contacts.resize(0);
	m_friction.resize(0);
	m_rollingFriction.resize(0);
	m_recovering.resize(0);
	m_push.resize(0);
}

void SweptRows::addContact(int row, btScalar speed)
{
	m_contacts.push_back(row);
	if (speed > 0)
		m_recovering.push_back({row, speed, btScalar(0)});
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
				btSetMin(row.m_upperLimit, row.m_friction);
			row.m_lowerLimit = -row.m_upperLimit;
			solvers.m_generic(bodies[row.m_solverBodyIdA], bodies[row.m_solverBodyIdB], row);
		}
	};
	sweepFriction(pools.m_friction, m_friction, false);
	sweepFriction(pools.m_rollingFriction, m_rollingFriction, true);
}

void SweptRows::recover(const SolverPools& pools, int numIterations)
{
	m_push.resize(0);
	m_push.resize(2 * pools.m_bodies.size(), btVector3(0, 0, 0));
	for (int sweep = 0; sweep < numIterations; ++sweep)
		for (int i = 0; i < m_recovering.size(); ++i)
		{
			Recovering& recovering = m_recovering[i];
			const btSolverConstraint& row = pools.m_contacts[recovering.m_contact];
			btSolverBody &A = pools.m_bodies[row.m_solverBodyIdA], &B = pools.m_bodies[row.m_solverBodyIdB];
			btVector3 *const pushA = &m_push[2 * row.m_solverBodyIdA], *const pushB = &m_push[2 * row.m_solverBodyIdB];
			const btScalar speed = row.m_contactNormal1.dot(pushA[0]) + row.m_relpos1CrossNormal.dot(pushA[1]) +
								   row.m_contactNormal2.dot(pushB[0]) + row.m_relpos2CrossNormal.dot(pushB[1]);
			const btScalar before = recovering.m_impulse;
			recovering.m_impulse = btMax(btScalar(0), before + (recovering.m_speed - speed) * row.m_jacDiagABInv);
			const btScalar change = recovering.m_impulse - before;
			pushA[0] += row.m_contactNormal1 * A.internalGetInvMass() * A.m_linearFactor * change;
			pushA[1] += row.m_angularComponentA * A.m_angularFactor * change;
			pushB[0] += row.m_contactNormal2 * B.internalGetInvMass() * B.m_linearFactor * change;
			pushB[1] += row.m_angularComponentB * B.m_angularFactor * change;
		}
}
}  // namespace btElasticPlastic
