// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_ISLAND_SOLVER_H
#define BT_ELASTIC_PLASTIC_ISLAND_SOLVER_H

#include "../../btElasticPlasticSolverSettings.h"
#include "../../btElasticPlasticStatistics.h"
#include "BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h"
#include "DirectForm.h"
#include "InnerSteps.h"
#include "Islands.h"
#include "IterativeForm.h"

namespace btElasticPlastic
{
/// Solves one island after another: Bullet's solver sets up bodies, contacts and other constraints and ends the step, one of the
/// two forms solves in between. Different objects may be used by different threads at the same time.
class IslandSolver : public btSequentialImpulseConstraintSolver, private InnerSteps::Solution
{
public:
	BT_DECLARE_ALIGNED_ALLOCATOR();

	IslandSolver() : m_direct(m_statistics) {}

	void setSettings(const btElasticPlasticSolverSettings& settings);

	/// Ages the plans and factors that are kept from step to step. \param isOneOfMany  see LinearSolver::beginStep
	void beginStep(bool isOneOfMany) { m_direct.getSystem().beginStep(isOneOfMany); }

	/// Solves an island with elastic-plastic joints, in the direct form in as many inner steps as it needs; with the iterative form it
	/// may be several islands.
	/// \param isInPool  there are no inner steps: they move bodies on which islands of other threads may stand
	void solve(const SolverGroup& island, const btContactSolverInfo& info, btIDebugDraw* debugDrawer,
			   btDispatcher* dispatcher, bool isInPool);

	/// Summed over all solutions; the caller may reset them.
	btElasticPlasticStatistics& getStatistics() { return m_statistics; }

protected:
	void convertJoints(btTypedConstraint** constraints, int numConstraints, const btContactSolverInfo& info) override;
	btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int numBodies,
											   btPersistentManifold** manifolds, int numManifolds,
											   btTypedConstraint** constraints, int numConstraints,
											   const btContactSolverInfo& info, btIDebugDraw* debugDrawer) override;
	btScalar solveSingleIteration(int iteration, btCollisionObject** bodies, int numBodies,
								  btPersistentManifold** manifolds, int numManifolds, btTypedConstraint** constraints,
								  int numConstraints, const btContactSolverInfo& info,
								  btIDebugDraw* debugDrawer) override;
	btScalar solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int numBodies,
										   const btContactSolverInfo& info) override;

private:
	SolverPools pools();
	bool sweepsContacts(const SolverGroup& island) const;
	void solveStep(const btContactSolverInfo& info, StepKind kind, long long maxWork) override;
	void convertForDirect(btTypedConstraint** constraints, int numConstraints, const btContactSolverInfo& info);
	void convertForIterative(btTypedConstraint** constraints, int numConstraints, const btContactSolverInfo& info);
	void addToDirect(JointWorks& joint, const btContactSolverInfo& info);
	void withholdResult();

	btElasticPlasticSolverSettings m_settings;
	btElasticPlasticStatistics m_statistics;
	DirectForm m_direct;
	JointRows m_rows;  ///< of one joint after another
	IterativeForm m_iterative;
	InnerSteps m_inner;
	SolverGroup m_island;                   ///< at work
	btIDebugDraw* m_debugDrawer = nullptr;  ///< of the caller
	btDispatcher* m_dispatcher = nullptr;
	StepKind m_kind = {1, false};                       ///< of the step that is being solved
	bool m_sweepsContacts = false;                      ///< of the island at work
	btAlignedObjectArray<btTypedConstraint*> m_others;  ///< the island's constraints that have rows in Bullet's pool
	btAlignedObjectArray<JointWorks*> m_otherJoints;  ///< the works of m_others, null where one is not elastic-plastic
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_ISLAND_SOLVER_H
