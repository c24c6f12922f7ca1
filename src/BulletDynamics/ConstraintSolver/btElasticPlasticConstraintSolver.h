// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CONSTRAINT_SOLVER_H
#define BT_ELASTIC_PLASTIC_CONSTRAINT_SOLVER_H

#include <memory>
#include <vector>

#include "BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h"
#include "ElasticPlastic/solver/WorkerPool.h"
#include "ElasticPlastic/solver/Islands.h"
#include "btElasticPlasticJoint.h"
#include "ElasticPlastic/solver/System.h"

/// How islands with elastic-plastic joints are solved.
enum btElasticPlasticForm
{
	BT_EP_DIRECT,    ///< the default: exactly, by a sparse factorisation, contacts and other constraints included
	BT_EP_ITERATIVE  ///< by Bullet's sequential impulses with exact soft rows: as good as its iterations
};

/// Bullet's solver with elastic-plastic joints solved right: hand it to the world instead of
/// btSequentialImpulseConstraintSolver. Islands without elastic-plastic joints are solved as ever, bit for bit.
///
/// Direct: all rows of an island in one semismooth Newton, see btElasticPlastic::System.h. A stiff structure holds at any step.
/// Where it does not converge the iterative form takes over, and the statistics count it.
///
/// Iterative: Bullet multiplies the impulse by a row's compliance but leaves it out of the diagonal; the iteration then
/// diverges for springs that the step resolves. Here an elastic-plastic row (J v + C lambda = r) is divided by A + C instead
/// of A, which is Gauss-Seidel on the true matrix and converges for every C, if slowly for long stiff chains.
ATTRIBUTE_ALIGNED16(class)
btElasticPlasticConstraintSolver : public btSequentialImpulseConstraintSolver
{
public:
	BT_DECLARE_ALIGNED_ALLOCATOR();

	/// To be chosen once: what iterations have left unsolved is strain that the direct form takes seriously.
	void setForm(btElasticPlasticForm form) { m_form = form; }
	btElasticPlasticForm getForm() const { return m_form; }

	/// How many threads solve islands at the same time, the calling one included; >= 1. Default: 1. For small islands with
	/// elastic-plastic joints, direct form only; it pays from some dozens of them, in worlds with
	/// setSplitIslands(false), or Bullet hands over few at a time. The number of threads changes no bit of the result.
	void setNumThreads(int threads);
	int getNumThreads() const { return m_crew ? m_crew->getNumWorkers() : 1; }

	/// The direct form's settings.
	btElasticPlastic::System& getSystem() { return m_system; }

	/// Of the direct form, summed since resetStatistics().
	const btElasticPlasticStatistics& getStatistics() const { return m_system.getStatistics(); }
	void resetStatistics() { m_system.getStatistics() = btElasticPlasticStatistics(); }

	void prepareSolve(int numBodies, int numManifolds) override;
	btScalar solveGroup(btCollisionObject * *bodies, int numBodies, btPersistentManifold** manifolds, int numManifolds,
						btTypedConstraint** constraints, int numConstraints, const btContactSolverInfo& info,
						btIDebugDraw* debugDrawer, btDispatcher* dispatcher) override;

protected:
	void convertJoints(btTypedConstraint * *constraints, int numConstraints, const btContactSolverInfo& info) override;
	btScalar solveGroupCacheFriendlyIterations(btCollisionObject * *bodies, int numBodies,
											   btPersistentManifold** manifolds, int numManifolds,
											   btTypedConstraint** constraints, int numConstraints,
											   const btContactSolverInfo& info, btIDebugDraw* debugDrawer) override;
	btScalar solveGroupCacheFriendlyFinish(btCollisionObject * *bodies, int numBodies, const btContactSolverInfo& info)
		override;

private:
	// ---- islands
	struct LightIslands;

	void solveIsland(const btElasticPlastic::SolverGroup& island, const btContactSolverInfo& info, btIDebugDraw* debugDrawer,
					 btDispatcher* dispatcher);

	// ---- the iterative form
	struct JointRows
	{
		btElasticPlasticJoint* m_joint;
		int m_firstRow;  ///< in Bullet's pool
	};

	void convertToRows(btTypedConstraint * *constraints, int numConstraints, const btContactSolverInfo& info);
	void makeSoft(btSolverConstraint & row, btElasticPlasticJoint & joint, int r, const btContactSolverInfo& info);

	// ---- the direct form
	struct DirectJoint
	{
		btElasticPlasticJoint* m_joint;
		int m_firstLaw;  ///< of the system
	};

	void convertToUnits(btTypedConstraint * *constraints, int numConstraints, const btContactSolverInfo& info);
	bool solveDirectly(const btContactSolverInfo& info);
	void fallBack(btTypedConstraint * *constraints, int numConstraints, const btContactSolverInfo& info);
	void addBodies();
	void addJoint(btElasticPlasticJoint & joint, const btContactSolverInfo& info);
	void addUnit(const btElasticPlasticJoint& joint, const int solverBodies[2]);
	void addSingleRows(const btElasticPlasticJoint& joint, const int solverBodies[2]);
	btElasticPlastic::System::Row& addRow(const btSolverConstraint& row);
	btElasticPlastic::System::Row& addContactRow(const btSolverConstraint& row);
	void addContacts(bool hasTwoDirections);
	void takeResult();
	void giveJointsTheirImpulses();

	btElasticPlasticForm m_form = BT_EP_DIRECT;
	btElasticPlastic::Islands m_islands;
	btAlignedObjectArray<btElasticPlasticJoint*> m_joints;  ///< per constraint, null if it is not elastic-plastic
	btElasticPlasticJoint** m_islandJoints = nullptr;       ///< the same of the island at work, null if it has none
	btAlignedObjectArray<JointRows> m_jointRows;
	btAlignedObjectArray<DirectJoint> m_directJoints;
	btAlignedObjectArray<btTypedConstraint*> m_others;  ///< the island's constraints that have rows in Bullet's pool
	btAlignedObjectArray<btElasticPlasticJoint*> m_otherJoints;  ///< of these, null where there is none of ours
	int m_firstRow = 0;                                          ///< in the system, of those in Bullet's pools
	btAlignedObjectArray<int> m_index;                           ///< of a solver body in the system, -1: does not move
	btAlignedObjectArray<btScalar> m_lastFriction;               ///< the last step's impulses, by Bullet's pool
	btElasticPlastic::System m_system;
	std::vector<int> m_lightIslands;
	std::unique_ptr<btElasticPlastic::WorkerPool> m_crew;                                 ///< null: one thread
	std::vector<std::unique_ptr<btElasticPlasticConstraintSolver>> m_assistants;  ///< of the crew's other workers
};

#endif  // BT_ELASTIC_PLASTIC_CONSTRAINT_SOLVER_H
