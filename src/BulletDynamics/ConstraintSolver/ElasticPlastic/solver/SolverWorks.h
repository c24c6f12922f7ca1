// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SOLVER_WORKS_H
#define BT_ELASTIC_PLASTIC_SOLVER_WORKS_H

#include <memory>
#include <vector>

#include "EarlyContacts.h"
#include "IslandSolver.h"
#include "Islands.h"
#include "WorkerPool.h"

namespace btElasticPlastic
{
/// The implementation of btElasticPlasticConstraintSolver: splits what Bullet hands over into islands, and has each solved by
/// the calling thread or by the threads of a worker pool.
class SolverWorks
{
public:
	SolverWorks();

	void setSettings(const btElasticPlasticSolverSettings& settings);
	const btElasticPlasticSolverSettings& getSettings() const { return m_settings; }
	btElasticPlasticStatistics& getStatistics() { return m_solvers[0]->getStatistics(); }

	/// Makes the island solvers iterate with the same row functions as the user's solver.
	void takeRowSolvers(btSequentialImpulseConstraintSolver& from);

	/// The world begins and ends a step. A solver that it does not tell so is one of a pool, as in btConstraintSolverPoolMt: any of the
	/// pool's solvers gets an island in the next step, at the same time as others get others.
	void beginStep();
	void endStep() { m_isInPool = true; }

	/// Of the step of a control that has chosen the present substep's length, the share that it is; 1: there is none.
	btScalar getSubstepShare() const { return m_substepShare ? *m_substepShare : btScalar(1); }

	/// Solves all of a group that depends on elastic-plastic joints. \return what does not, which is left to Bullet
	SolverGroup solve(const SolverGroup& group, const btContactSolverInfo& info, btIDebugDraw* debugDrawer,
					  btDispatcher* dispatcher);

	// For a solver that has something to do between them, solve() in two parts, in either form.

	/// Takes the islands with elastic-plastic joints out of a group. \return whether there are any; they and the others are valid
	/// until the next call
	bool split(const SolverGroup& group, const btContactSolverInfo& info, btDispatcher* dispatcher);
	int getNumIslands() const { return m_islands.getNumIslands(); }
	SolverGroup getIsland(int i) { return m_islands.getIsland(i); }
	SolverGroup getOthers() { return m_islands.getOthers(); }

	void solveIslands(const btContactSolverInfo& info, btIDebugDraw* debugDrawer, btDispatcher* dispatcher);

private:
	struct SharedIslands;

	/// \return whether there is any elastic-plastic joint
	bool findJoints(const SolverGroup& group);
	void beginStepInPool();
	void splitIslands(SolverGroup& group, const btContactSolverInfo& info, btDispatcher* dispatcher);
	void solveShared(const btContactSolverInfo& info, btDispatcher* dispatcher);

	btElasticPlasticSolverSettings m_settings;
	bool m_isInPool = true;
	const JointRegistry* m_registry = nullptr;       ///< the action of the first of m_joints that has one
	std::shared_ptr<const btScalar> m_substepShare;  ///< of the action of the last joints; null: none yet
	double m_poolTime = -1;  ///< of the joints' action, by which a solver in a pool knows steps apart
	EarlyContacts m_earlyContacts;
	Islands m_islands;
	btAlignedObjectArray<JointWorks*> m_joints;            ///< per constraint, null if it is not elastic-plastic
	std::vector<std::unique_ptr<IslandSolver>> m_solvers;  ///< by worker, the calling thread's first
	std::unique_ptr<WorkerPool> m_pool;                    ///< null: one thread
	std::vector<int> m_sharedIslands;                      ///< that any worker may solve
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SOLVER_WORKS_H
