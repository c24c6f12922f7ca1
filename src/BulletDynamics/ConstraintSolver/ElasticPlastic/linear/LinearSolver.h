// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_LINEAR_SOLVER_H
#define BT_ELASTIC_PLASTIC_LINEAR_SOLVER_H

#include <memory>
#include <unordered_map>
#include <vector>

#include "BlockFactor.h"
#include "BlockMatrix.h"
#include "../../btElasticPlasticSolverSettings.h"
#include "../../btElasticPlasticStatistics.h"

namespace btElasticPlastic
{
/// H x = b for one matrix after another, on graphs that come back step after step.
///
/// A graph's plan of factorisation is kept while the graph does. Where a factor costs much more than a solution with it, the
/// island's last factor is kept too: as long as H has changed little, a few steps of conjugate gradients that it
/// preconditions are as exact and cheaper than a new one. Where H changes in a few bodies within a problem, only what depends
/// on them is factorised again.
class LinearSolver
{
public:
	explicit LinearSolver(btElasticPlasticStatistics& statistics) : m_statistics(statistics) {}

	/// Ages what is kept: plans that no step has used for a while make room for new ones.
	void beginStep() { ++m_step; }

	/// Begins a problem, with a matrix of zeros on its graph.
	/// \param edges   two bodies each; repetitions and directions make no difference to the matrix
	/// \param islandId  of the island, see getIslandId(); 0: has none
	void begin(int numBodies, const std::vector<int>& edges, int islandId);

	/// To be given to begin() when the same island comes back, so that it gets its own factor again, not that of an island
	/// with the same graph: what it is solved with must not depend on its neighbours. 0 if no factor is kept.
	int getIslandId() const { return m_plan->m_islandId; }

	BlockMatrix& getMatrix() { return m_plan->m_matrix; }

	/// To be called after each assembly.
	/// \param changedBodies  whose blocks are not as they were at the last assembly of this problem; may name one twice
	void setAssembled(const std::vector<int>& changedBodies);

	/// x = H^-1 x, 6 doubles per body. \return false, and x means nothing, if H is not positive definite
	bool solve(std::vector<double>& x);

	/// May an island of so many bodies have a factor that is kept? If not, nothing of it stays here but its graph's plan: any
	/// linear solver gives the same bits.
	static bool mayKeepFactor(int numBodies) { return numBodies > 100; }

	void setSettings(const btElasticPlasticSolverSettings& settings);

private:
	struct Plan
	{
		int m_numBodies = 0;
		std::vector<int> m_edges;
		BlockMatrix m_matrix;
		BlockFactor m_factor;
		int m_islandId = 0;
		int m_patience = 0;  // solutions for which iterating with an old factor is not tried again
		long long m_lastUse = 0;
	};

	/// How good the plan's factor is.
	enum FactorState
	{
		NONE,
		OLD,     // of the step before
		NEARLY,  // of this problem, but for m_changed
		CURRENT
	};

	Plan& newPlan(size_t hash);
	bool factorise();
	bool iterate(std::vector<double>& x);

	btElasticPlasticSolverSettings m_settings;
	btElasticPlasticStatistics& m_statistics;
	std::unordered_multimap<size_t, std::unique_ptr<Plan>> m_plans;  // by their graphs' hash
	Plan* m_plan = nullptr;
	long long m_step = 0;
	int m_lastIslandId = 0;
	FactorState m_factorState = NONE;
	std::vector<int> m_changed;  // bodies
	std::vector<double> m_solution, m_search, m_product, m_preconditioned, m_rest;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_LINEAR_SOLVER_H
