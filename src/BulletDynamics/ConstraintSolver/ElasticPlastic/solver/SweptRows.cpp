// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "SweptRows.h"

#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
/// What gives less than this share of the bodies' kinetic energy is as good as ten sweeps are.
const double LITTLE = 1e-4;

btVector3 velocityOf(const btSolverBody& body)
{
	return body.m_linearVelocity + body.m_externalForceImpulse + body.m_deltaLinearVelocity;
}

btVector3 spinOf(const btSolverBody& body)
{
	return body.m_angularVelocity + body.m_externalTorqueImpulse + body.m_deltaAngularVelocity;
}

/// \param velocities  of A, spin of A, of B, spin of B
double along(const btSolverConstraint& row, const btVector3 velocities[4])
{
	return double(row.m_contactNormal1.dot(velocities[0]) + row.m_relpos1CrossNormal.dot(velocities[1]) +
				  row.m_contactNormal2.dot(velocities[2]) + row.m_relpos2CrossNormal.dot(velocities[3]));
}

double changeAlong(const btSolverConstraint& row, const btSolverBody& A, const btSolverBody& B)
{
	const btVector3 changes[4] = {A.m_deltaLinearVelocity, A.m_deltaAngularVelocity, B.m_deltaLinearVelocity,
								  B.m_deltaAngularVelocity};
	return along(row, changes);
}

void takeBackRow(btSolverConstraint& row, btSolverBody& A, btSolverBody& B)
{
	A.internalApplyImpulse(row.m_contactNormal1 * A.internalGetInvMass(), row.m_angularComponentA,
						   -row.m_appliedImpulse);
	B.internalApplyImpulse(row.m_contactNormal2 * B.internalGetInvMass(), row.m_angularComponentB,
						   -row.m_appliedImpulse);
	row.m_appliedImpulse = 0;
}
}  // namespace

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
			   // The row in Bullet's terms, see DirectForm::addRow().
			   const double impulse = row.m_appliedImpulse,
							asked = double(row.m_rhs) - 0.5 * double(row.m_cfm) * impulse;
			   made += impulse * (0.5 * changeAlong(row, A, B) - asked / double(row.m_jacDiagABInv));
		   });
	return made;
}

bool SweptRows::giveEnergy(const SolverPools& pools) const
{
	double given = 0;
	forAll(pools,
		   [&](const btSolverConstraint& row, const btSolverBody& A, const btSolverBody& B)
		   {
			   const btVector3 velocities[4] = {velocityOf(A), spinOf(A), velocityOf(B), spinOf(B)};
			   // Restitution, and recovery that is Bullet's, ask for some speed.
			   const double impulse = row.m_appliedImpulse, speed = along(row, velocities),
							more = changeAlong(row, A, B) - double(row.m_rhs) / double(row.m_jacDiagABInv);
			   given += btMin(impulse * speed, impulse * more);
		   });
	double kinetic = 0;
	for (int i = 0; i < pools.m_bodies.size(); ++i)
	{
		const btSolverBody& body = pools.m_bodies[i];
		if (!body.m_originalBody || !(body.m_originalBody->getInvMass() > 0))
			continue;
		const double mass = 1 / double(body.m_originalBody->getInvMass());
		given -= 0.5 * mass * double((velocityOf(body) - body.m_linearVelocity).length2());
		kinetic += 0.5 * mass * double((body.m_linearVelocity + body.m_externalForceImpulse).length2());
	}
	return given > LITTLE * kinetic;
}

void SweptRows::takeBackWhatParts(const SolverPools& pools) const
{
	forAll(pools,
		   [](btSolverConstraint& row, btSolverBody& A, btSolverBody& B)
		   {
			   const double asked = double(row.m_rhs) / double(row.m_jacDiagABInv);
			   if (double(row.m_appliedImpulse) * (changeAlong(row, A, B) - asked) > 0)
				   takeBackRow(row, A, B);
		   });
	// Friction that holds has no bound left where nothing presses.
	const auto release = [&](btConstraintArray& pool, const btAlignedObjectArray<int>& rows)
	{
		for (int i = 0; i < rows.size(); ++i)
		{
			btSolverConstraint& row = pool[rows[i]];
			if (btScalar(pools.m_contacts[row.m_frictionIndex].m_appliedImpulse) == 0)
				takeBackRow(row, pools.m_bodies[row.m_solverBodyIdA], pools.m_bodies[row.m_solverBodyIdB]);
		}
	};
	release(pools.m_friction, m_friction);
	release(pools.m_rollingFriction, m_rollingFriction);
}

void SweptRows::takeBack(const SolverPools& pools) const { forAll(pools, takeBackRow); }

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
