// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_RECORDING_SOLVER_H
#define EP_RECORDING_SOLVER_H

#include <vector>

#include "btBulletDynamicsCommon.h"

/// What the paper's Figure 7 names, of one row of the solver; vertical rows as if they looked up.
struct SolverRow
{
	btScalar m_velError;
	btScalar m_penetration;  ///< of a contact: the distance, negative when penetrating
	btScalar m_posError;
	btScalar m_rhs;
};

/// Bullet's own solver that writes down its rows, and can warm start friction as Bullet did when the paper was written.
class RecordingSolver : public btSequentialImpulseConstraintSolver
{
public:
	explicit RecordingSolver(bool warmStartsFriction = false) : m_warmStartsFriction(warmStartsFriction) {}

	std::vector<SolverRow> m_contacts;
	std::vector<SolverRow> m_verticalJointRows;

protected:
	void convertContacts(btPersistentManifold** manifolds, int numManifolds, const btContactSolverInfo& info) override
	{
		btSequentialImpulseConstraintSolver::convertContacts(manifolds, numManifolds, info);
		m_contacts.clear();
		for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i)
		{
			const btSolverConstraint& row = m_tmpSolverContactConstraintPool[i];
			const btManifoldPoint& point = *static_cast<const btManifoldPoint*>(row.m_originalContactPoint);
			m_contacts.push_back(describe(row, point.getDistance(), info.m_timeStep));
			if (m_warmStartsFriction)
				warmStartFriction(row, point, info.m_warmstartingFactor);
		}
	}

	void convertJoints(btTypedConstraint** joints, int numJoints, const btContactSolverInfo& info) override
	{
		btSequentialImpulseConstraintSolver::convertJoints(joints, numJoints, info);
		m_verticalJointRows.clear();
		for (int i = 0; i < m_tmpSolverNonContactConstraintPool.size(); ++i)
		{
			const btSolverConstraint& row = m_tmpSolverNonContactConstraintPool[i];
			if (btFabs(row.m_contactNormal1.y()) < btScalar(0.5))
				continue;
			const btScalar up = row.m_contactNormal1.y() > 0 ? 1 : -1;
			SolverRow described = describe(row, 0, info.m_timeStep);
			described.m_velError *= up;
			described.m_posError *= up;
			described.m_rhs *= up;
			m_verticalJointRows.push_back(described);
		}
	}

private:
	/// J v with the velocities that external forces will give.
	btScalar velocityAlong(const btSolverConstraint& row) const
	{
		const btSolverBody &a = m_tmpSolverBodyPool[row.m_solverBodyIdA], &b = m_tmpSolverBodyPool[row.m_solverBodyIdB];
		return row.m_contactNormal1.dot(a.m_linearVelocity + a.m_externalForceImpulse) +
			   row.m_relpos1CrossNormal.dot(a.m_angularVelocity + a.m_externalTorqueImpulse) +
			   row.m_contactNormal2.dot(b.m_linearVelocity + b.m_externalForceImpulse) +
			   row.m_relpos2CrossNormal.dot(b.m_angularVelocity + b.m_externalTorqueImpulse);
	}

	/// Bullet closes an open gap by velocity, a penetration by position.
	SolverRow describe(const btSolverConstraint& row, btScalar distance, btScalar timeStep) const
	{
		SolverRow described;
		described.m_velError = -velocityAlong(row) - btMax(distance, btScalar(0)) / timeStep;
		described.m_penetration = distance;
		described.m_posError = (row.m_rhs + row.m_rhsPenetration) / row.m_jacDiagABInv - described.m_velError;
		described.m_rhs = row.m_rhs;
		return described;
	}

	/// What Bullet did before 2.89: start from the last step's friction impulse.
	void warmStartFriction(const btSolverConstraint& contact, const btManifoldPoint& point, btScalar factor)
	{
		btSolverConstraint& friction = m_tmpSolverContactFrictionConstraintPool[contact.m_frictionIndex];
		btSolverBody& a = m_tmpSolverBodyPool[friction.m_solverBodyIdA];
		btSolverBody& b = m_tmpSolverBodyPool[friction.m_solverBodyIdB];
		const btScalar impulse = point.m_appliedImpulseLateral1 * factor;
		friction.m_appliedImpulse = impulse;
		a.internalApplyImpulse(friction.m_contactNormal1 * a.internalGetInvMass(), friction.m_angularComponentA,
							   impulse);
		b.internalApplyImpulse(friction.m_contactNormal2 * b.internalGetInvMass(), friction.m_angularComponentB,
							   impulse);
	}

	const bool m_warmStartsFriction;
};

#endif  // EP_RECORDING_SOLVER_H
