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

	/// \param share  of the world's step that is to be solved
	void clear(btScalar share);

	// Rows of the pools, by index.

	void addConstraint(int row) { m_constraints.push_back(row); }
	void addContact(int row) { m_contacts.push_back(row); }
	/// Of a contact that has been added.
	void addFriction(int row) { m_friction.push_back(row); }
	void addRollingFriction(int row) { m_rollingFriction.push_back(row); }

	bool isEmpty() const { return m_constraints.size() + m_contacts.size() == 0; }

	/// What the rows' impulses make of energy, by a sum that no sweep lets rise: 1/2 lambda^T (A + C) lambda - b^T lambda. Only these
	/// rows may have given anything to the bodies yet. Above 0 an impulse, such as Bullet's warm start from the step of a blow, is more
	/// than the contacts ask for by now.
	double findMade(const SolverPools& pools) const;

	/// Whether the rows' impulses, with the bodies' velocities as they are to be, give more work than a step takes by changing velocities
	/// at once: some push bodies that part faster than they are asked for.
	bool giveEnergy(const SolverPools& pools) const;

	/// Takes Bullet's warm start back, from rows and from bodies.
	void takeBack(const SolverPools& pools) const;

	/// Takes the impulses of rows back whose bodies do more than they are asked for along them, and friction where nothing presses any more.
	void takeBackWhatParts(const SolverPools& pools) const;

	/// One sweep over all rows: bodies' changes of velocity and rows' impulses.
	void sweep(const SolverPools& pools, const RowSolvers& solvers) const;

private:
	template <class Visit>
	void forAll(const SolverPools& pools, Visit visit) const;

	btScalar m_share = 1;
	btAlignedObjectArray<int> m_constraints, m_contacts, m_friction, m_rollingFriction;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SWEPT_ROWS_H
