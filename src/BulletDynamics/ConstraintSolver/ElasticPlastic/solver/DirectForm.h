// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_DIRECT_FORM_H
#define BT_ELASTIC_PLASTIC_DIRECT_FORM_H

#include "../joint/JointWorks.h"
#include "Recovery.h"
#include "SolverPools.h"
#include "System.h"

namespace btElasticPlastic
{
/// The direct form of the solver: puts an island's bodies, elastic-plastic joints and Bullet's rows into a System, and its
/// solution back. Bullet sees no rows of elastic-plastic joints here, which saves most of what it spends on setting them up.
class DirectForm
{
public:
	explicit DirectForm(btElasticPlasticStatistics& statistics) : m_system(statistics) {}

	System& getSystem() { return m_system; }

	/// Begins an island.
	void begin();

	/// \param solverBodies  of the joint's bodies, indices of the pool
	void addJoint(JointWorks& joint, const JointRows& rows, const int solverBodies[2], const SolverPools& pools);

	bool hasJoints() const { return m_joints.size() > 0; }

	/// Adds Bullet's rows and solves. \return false if it does not converge
	bool solve(const SolverPools& pools, const btContactSolverInfo& info);

	/// After solve(): gives bodies their changes of velocity and the motion of their places, and Bullet's rows their impulses.
	void writeResult(const SolverPools& pools, const btContactSolverInfo& info) const;

	/// Does the solution move places beside velocities? Bullet then has to be told to.
	bool movesPlaces() const { return m_joints.size() > 0 && m_recovery.hasMotion(); }

	/// Gives joints their impulses, after Bullet has finished the step's solution.
	void finish();

	/// Forgets the island: its joints have no part in the step any more.
	void cancel();

private:
	struct Joint
	{
		JointWorks* m_works;
		int m_firstRow;      ///< of the system
		int m_bodies[2];     ///< of the system, -1: does not move
		int m_firstDamping;  ///< single row of its tension damping, which has two; -1: none
		bool m_isCut;  ///< whether Bullet's breaking threshold has replaced a bound; a row at this bound does not flow
	};

	void addBodies(const SolverPools& pools);
	void addUnit(const JointRows& rows, const int solverBodies[2]);
	void addDamping(const TensionDamping& damping, const btVector3& spin, const int bodies[2]);
	btVector3 dampingImpulse(const Joint& joint) const;
	void giveRecovery(const Joint& joint) const;
	void addUnitAsSingleRows(const JointRows& rows, const int solverBodies[2], const SolverPools& pools);
	SystemInput::SingleRow& addRow(const btSolverConstraint& row, const SolverPools& pools);
	SystemInput::SingleRow& addContactRow(const btSolverConstraint& row, const SolverPools& pools);
	void addContacts(const SolverPools& pools, const btContactSolverInfo& info);
	void addFriction(const btConstraintArray& rows, int firstContact, bool isRolling, const SolverPools& pools);

	SystemInput m_input;
	System m_system;
	Recovery m_recovery;
	btAlignedObjectArray<Joint> m_joints;
	btAlignedObjectArray<int> m_index;  ///< index in the system of each solver body, -1: it does not move
	int m_firstRow = 0;                 ///< index of the single row that stands for the first row in Bullet's pools
	btAlignedObjectArray<btScalar> m_lastFriction;  ///< the last step's impulses, by Bullet's pool
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_DIRECT_FORM_H
