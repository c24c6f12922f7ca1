// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SWEPT_ROWS_H
#define BT_ELASTIC_PLASTIC_SWEPT_ROWS_H

#include "BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h"
#include "SolverPools.h"

struct btContactSolverInfo;

namespace btElasticPlastic
{
/// Those of an island's rows in Bullet's pools that are swept as Bullet sweeps them, one after another, and not solved with the
/// joints: contacts with friction, and constraints of loose bodies. Impulses of Bullet's warm start are already on the bodies.
class SweptRows
{
public:
	/// Bullet's functions for a row with two bounds, and for one with a lower bound only.
	struct RowSolvers
	{
		btSingleConstraintRowSolver m_generic, m_lowerLimit;
	};

	void clear();

	// Rows of the pools, by index.

	void addConstraint(int row) { m_constraints.push_back(row); }
	/// \param speed  at which recovery is to part the bodies' places without giving them a velocity [m/s]; 0: not at all
	void addContact(int row, btScalar speed);
	/// Of a contact that has been added.
	void addFriction(int row) { m_friction.push_back(row); }
	void addRollingFriction(int row) { m_rollingFriction.push_back(row); }

	bool isEmpty() const { return m_constraints.size() + m_contacts.size() == 0; }
	bool hasRecovery() const { return m_recovering.size() > 0; }

	/// One sweep over all rows: bodies' changes of velocity and rows' impulses.
	void sweep(const SolverPools& pools, const RowSolvers& solvers) const;

	/// Finds the velocities with which recovery moves places, as if only contacts held the bodies.
	void recover(const SolverPools& pools, int numIterations);

	/// Of a solver body after recover(), linear and angular.
	const btVector3* getPush(int solverBody) const { return &m_push[2 * solverBody]; }

private:
	struct Recovering
	{
		int m_contact;
		btScalar m_speed, m_impulse;
	};

	btAlignedObjectArray<int> m_constraints, m_contacts, m_friction, m_rollingFriction;
	btAlignedObjectArray<Recovering> m_recovering;
	btAlignedObjectArray<btVector3> m_push;  ///< two per solver body
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SWEPT_ROWS_H
