// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_DIRECT_FORM_H
#define BT_ELASTIC_PLASTIC_DIRECT_FORM_H

#include "../joint/JointWorks.h"
#include "Jacobian.h"
#include "Recovery.h"
#include "SolverPools.h"
#include "Structures.h"
#include "SweptRows.h"
#include "System.h"

namespace btElasticPlastic
{
/// The direct form of the solver: puts an island's bodies, elastic-plastic joints and Bullet's rows into a System, and its
/// solution back. Bullet sees no rows of elastic-plastic joints here, which saves most of what it spends on setting them up.
///
/// Contacts are solved with the joints, exactly, or swept around them. Swept, the System has what constraints join to
/// elastic-plastic joints. Contacts and loose bodies are swept as Bullet sweeps them, and after every few sweeps the System is
/// solved for what they have given to its bodies. Both find the impulses that are best as long as the others stay, so energy
/// falls from one to the next; the System is last, so joints' impulses are exact for the contacts'. A contact of a heavy loose body
/// with a light one of the System would take long to sweep, and stays in the System.
class DirectForm
{
public:
	explicit DirectForm(btElasticPlasticStatistics& statistics) : m_system(statistics) {}

	System& getSystem() { return m_system; }

	/// Begins an island.
	/// \param sweepsContacts  whether contacts are swept around the joints
	/// \param share           of the world's step that is to be solved; Bullet bounds some impulses by the step
	void begin(bool sweepsContacts, double share);

	/// Makes room for so many joints.
	void reserve(int numJoints) { m_input.reserve(size_t(numJoints)); }

	/// \param solverBodies  of the joint's bodies, indices of the pool
	void addJoint(JointWorks& joint, const JointRows& rows, const int solverBodies[2], const SolverPools& pools);

	bool hasJoints() const { return m_joints.size() > 0; }

	/// Adds Bullet's rows and solves.
	void solve(const SolverPools& pools, const btContactSolverInfo& info, const SweptRows::RowSolvers& rowSolvers);

	/// After solve(): gives bodies their changes of velocity and the motion of their places, and Bullet's rows their impulses.
	void writeResult(const SolverPools& pools, const btContactSolverInfo& info) const;

	/// Does the solution move places beside velocities? Bullet then has to be told to.
	bool movesPlaces() const { return m_joints.size() > 0 && m_recovery.hasMotion(); }

	/// Gives joints their impulses, after Bullet has finished the step's solution.
	/// \param isFree  nothing acts from outside on the island
	void finish(bool isFree);

	/// Forgets the island: its joints have no part in the step any more.
	void cancel();

private:
	struct Joint
	{
		JointWorks* m_works;
		int m_firstRow;                    ///< of the system
		int m_bodies[2];                   ///< of the system, -1: does not move
		int m_firstDamping, m_numDamping;  ///< single rows of its tension damping
		bool m_isCut;  ///< whether Bullet's breaking threshold has replaced a bound; a row at this bound does not flow
	};

	/// One of Bullet's rows that is in the system.
	struct PoolRow
	{
		btSolverConstraint* m_from;
		int m_row;
	};

	void addBodies(const SolverPools& pools);
	int addBody(int solverBody, const SolverPools& pools);
	void addUnit(const JointRows& rows, const int bodies[2]);
	void addFibres(const JointRows& rows, const btScalar along[BT_EP_DOF_COUNT], double most, Joint& entry);
	void coupleFibres(const JointRows& rows, const Joint& entry);
	void addDamping(const TensionDamping& damping, const btVector3& spin, const int bodies[2]);
	btVector3 dampingImpulse(const Joint& joint) const;
	void giveRecovery(const Joint& joint) const;
	void addUnitAsSingleRows(const JointRows& rows, const int solverBodies[2], const SolverPools& pools);
	/// \param hardest  its least compliance, as a share of its A
	SystemInput::SingleRow& addRow(btSolverConstraint& row, double hardest, const SolverPools& pools);
	SystemInput::SingleRow& addContactRow(btSolverConstraint& row, const SolverPools& pools);
	void addConstraints(const SolverPools& pools);
	void chooseExactContacts(const SolverPools& pools);
	void addContacts(const SolverPools& pools, const btContactSolverInfo& info);
	int addContact(btSolverConstraint& contact, const SolverPools& pools, btScalar dt);
	double takeRecovery(int contact, const SolverPools& pools, const btContactSolverInfo& info) const;
	void addRecovery(int contact, double speed, const SolverPools& pools);
	bool isLoose(int solverBody) const;
	void addFriction(btConstraintArray& rows, bool isRolling, const SolverPools& pools,
					 const btContactSolverInfo& info);
	void recover(bool isSolved, const SolverPools& pools, const btContactSolverInfo& info);
	void solveAround(const SolverPools& pools, const btContactSolverInfo& info,
					 const SweptRows::RowSolvers& rowSolvers);
	void takeOthers(const SolverPools& pools);
	void writeVelocities(const SolverPools& pools);
	void holdStill(const SolverPools& pools) const;

	SystemInput m_input;
	System m_system;
	Recovery m_recovery;
	btAlignedObjectArray<Joint> m_joints;
	btAlignedObjectArray<int> m_index;  ///< index in the system of each solver body, or one of the two that follow
	enum
	{
		STILL = -1,   ///< does not move
		OUTSIDE = -2  ///< moves, and is not in the system
	};
	btAlignedObjectArray<PoolRow> m_poolRows;
	btAlignedObjectArray<int> m_singleRowOf;  ///< single row of each of Bullet's contacts, -1: it is swept
	double m_share = 1;                       ///< of the world's step
	// Where contacts are swept.
	bool m_sweepsContacts = false;
	SweptRows m_swept;
	Structures m_structures;
	btAlignedObjectArray<int> m_numSupports;   ///< contacts that hold a structure, by its body
	btAlignedObjectArray<bool> m_isLoose;      ///< by body in the system: nothing holds it but contacts
	btAlignedObjectArray<bool> m_isLoaded;     ///< by body in the system: something loose and heavy lies on it
	btAlignedObjectArray<int> m_solverBodies;  ///< of each body in the system
	AskedRows m_asked;                         ///< before swept rows have given anything
	std::vector<double> m_byOthers;            ///< by body, 6 doubles: change of velocity that swept rows have given
	std::vector<char> m_isChanged;             ///< by body: they have given since the last solution
	std::vector<double> m_written;             ///< change of velocity as the bodies had it after the last solution
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_DIRECT_FORM_H
