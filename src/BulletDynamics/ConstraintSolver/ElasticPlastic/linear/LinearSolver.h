// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_LINEAR_SOLVER_H
#define BT_ELASTIC_PLASTIC_LINEAR_SOLVER_H

#include <memory>
#include <unordered_map>
#include <vector>

#include "BlockFactor.h"
#include "BlockMatrix.h"
#include "BufferPool.h"
#include "../../btElasticPlasticSolverSettings.h"
#include "../../btElasticPlasticStatistics.h"

namespace btElasticPlastic
{
/// Solves H x = b for one matrix after another, on graphs that return step after step.
///
/// The plan of a graph's factorisation is kept as long as the graph is used. Where a factor costs much more than a solution
/// with it, the island's last factor is kept too, from the second time on that its graph is used: as long as H has changed little, a few iterations of conjugate gradients
/// that the old factor preconditions are as exact as a new factor, and cheaper. Where H changes in a few bodies within a
/// problem, only what depends on them is factorised again.
class LinearSolver
{
public:
	/// \param buffers  shared with others, null: its own
	explicit LinearSolver(btElasticPlasticStatistics& statistics, BufferPool* buffers = nullptr)
		: m_statistics(statistics), m_buffers(buffers ? *buffers : m_ownBuffers)
	{
	}
	LinearSolver(const LinearSolver&) = delete;
	LinearSolver& operator=(const LinearSolver&) = delete;

	BufferPool& getBuffers() { return m_buffers; }

	/// Ages the plans: those that no step has used for a while make room for new ones.
	/// \param isOneOfMany  any of several linear solvers gets an island in the next step: none keeps factors, so that all give the
	///                     same bits
	void beginStep(bool isOneOfMany)
	{
		++m_step;
		m_isOneOfMany = isOneOfMany;
	}

	/// Begins a problem on a graph.
	/// \param edges   two bodies each; repetitions and directions make no difference to the matrix
	/// \param islandId  by which the island's kept factor is found, see getIslandId(); 0: it has none; less: it has, but is not to use it
	/// \param numSolutions  about how many there will be, > 0: with many a new factor is cheaper than iterations with an old one
	/// \param numLast       so many of the highest bodies are eliminated last
	void begin(int numBodies, const std::vector<int>& edges, int islandId, int numSolutions, int numLast = 0);

	/// The number to be given to begin() when the same island returns. By it the island gets its own factor again, and not
	/// that of another island with the same graph: its result must not depend on its neighbours. 0 if no factor is kept.
	int getIslandId() const { return m_plan->m_islandId; }

	/// See BlockFactor::getComplement. There must have been a solution.
	void getComplement(std::vector<double>& complement) const
	{
		m_plan->m_factor.getComplement(m_plan->m_numLast, complement);
	}

	/// Of a factorisation of the present problem: multiplications and additions.
	int64_t getNumOperations() const { return m_plan->m_factor.getNumOperations(); }

	/// To be called before the first assembly of a problem, and after lendBuffers().
	void setMatrixZero();
	BlockMatrix& getMatrix() { return m_plan->m_matrix; }

	/// To be called after each assembly.
	/// \param changedBodies  bodies whose blocks differ from the last assembly of this problem; one may be named twice
	void setAssembled(const std::vector<int>& changedBodies);

	/// To be called instead if H has nothing to do with the last one: no factor of it is used any more.
	void forgetFactor() { m_factorState = NONE; }

	/// Lets others use the memory of matrix and factor, which are lost, until the next assembly.
	void lendBuffers();

	/// x = H^-1 x, 6 doubles per body. \return false, and x means nothing, if H is not positive definite
	bool solve(std::vector<double>& x);

	/// Whether the last solution was by a factor of the present H, so that there are halves of solutions.
	bool hasHalves() const { return m_factorState == CURRENT; }

	/// See BlockFactor::solveHalf.
	void solveHalf(const int bodies[2], const double b[12], HalfSolution& half);

	/// Whether the factor of an island of so many bodies may be kept. If not, only its graph's plan stays here, and any
	/// LinearSolver gives the same bits.
	static bool mayKeepFactor(int numBodies) { return numBodies > 100; }

	void setSettings(const btElasticPlasticSolverSettings& settings);

private:
	struct Plan
	{
		int m_numBodies = 0, m_numLast = 0;
		std::vector<int> m_edges;
		BlockMatrix m_matrix;
		BlockFactor m_factor;
		int m_islandId = 0;
		int m_numUses = 0;   // without a step between
		int m_patience = 0;  // number of solutions for which iterating with an old factor is not tried again
		long long m_lastUse = 0;
	};

	/// How good the plan's factor is.
	enum FactorState
	{
		NONE,
		OLD,     // the factor of the step before
		NEARLY,  // the factor of this problem's last matrix, which has changed in the blocks of m_changed
		CURRENT
	};

	void leavePlan();
	void leaveGraphOf(int islandId);
	Plan& newPlan(size_t hash);
	void giveBuffersBack(Plan& plan);
	template <class Blocks>
	void takeBuffer(Blocks& blocks);
	bool factorise();
	void countSolution();
	bool iterate(std::vector<double>& x);

	btElasticPlasticSolverSettings m_settings;
	btElasticPlasticStatistics& m_statistics;
	std::unordered_multimap<size_t, std::unique_ptr<Plan>> m_plans;  // by their graphs' hash
	BufferPool m_ownBuffers;
	BufferPool& m_buffers;
	Plan* m_plan = nullptr;
	long long m_step = 0;
	bool m_isOneOfMany = false;
	int m_lastIslandId = 0;
	FactorState m_factorState = NONE;
	std::vector<int> m_changed;  // bodies
	std::vector<double> m_solution, m_search, m_product, m_preconditioned, m_rest;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_LINEAR_SOLVER_H
