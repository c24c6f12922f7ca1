// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The factors and the memory that LinearSolver keeps.

#include <set>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/linear/LinearSolver.h"
#include "linear/BlockMatrices.h"

namespace testLinearSolver
{
using namespace ep;
using btElasticPlastic::LinearSolver;

/// An island of a wall, with so many contacts beside its joints.
struct Wall
{
	BlockGraph m_graph = grid(12, 12, 1);
	int m_id = 0;

	explicit Wall(int numContacts = 0)
	{
		for (int i = 0; i < numContacts; ++i)
			m_graph.join(2 * i, 30 + 3 * i);
	}

	/// \return H x for the solution x
	Values solve(LinearSolver& solver, const Values& b)
	{
		std::vector<int> edges;
		for (const std::array<int, 2>& edge : m_graph.m_edges)
			edges.insert(edges.end(), edge.begin(), edge.end());
		solver.begin(m_graph.m_numBodies, edges, m_id, 1);
		m_id = solver.getIslandId();
		solver.setMatrixZero();
		assemble(m_graph, 10, 1, solver.getMatrix());
		solver.setAssembled({});
		Values x = b;
		EXPECT_TRUE(solver.solve(x));
		return product(solver.getMatrix(), x);
	}
};

TEST(LinearSolver, KeepsTheFactorOfAGraphThatReturns)
{
	btElasticPlasticStatistics statistics;
	LinearSolver solver(statistics);
	Wall wall;
	const Values b = randomValues(wall.m_graph.m_numBodies);
	for (int step = 0; step < 10; ++step)
	{
		solver.beginStep(false);
		// What iterations with a kept factor leave is 1e-10 or less of b.
		EXPECT_LE(difference(b, wall.solve(solver, b)), 1e-9) << step;
	}
	EXPECT_EQ(1, statistics.m_analyses);
	EXPECT_EQ(2, statistics.m_factorisations);
}

TEST(LinearSolver, HasAFewBuffersWhereContactsComeAndGo)
{
	// A wall under a hail: each step has another graph. Each of them had memory of its own, which an operating system takes longer to
	// give than the solver needs to fill it.
	btElasticPlasticStatistics statistics;
	LinearSolver solver(statistics);
	Wall wall;
	const Values b = randomValues(wall.m_graph.m_numBodies);
	std::set<const double*> buffers;
	for (int step = 0; step < 40; ++step)
	{
		Wall next(1 + step % 20);
		next.m_id = wall.m_id;
		solver.beginStep(false);
		EXPECT_LE(difference(b, next.solve(solver, b)), 1e-9) << step;
		buffers.insert(solver.getMatrix().getValues());
		wall.m_id = next.m_id;
	}
	EXPECT_EQ(40, statistics.m_analyses);
	// One, and another one when that has become too small.
	EXPECT_LE(buffers.size(), 2u);
}

TEST(LinearSolver, AnIslandsFactorOutlivesOthersGraphs)
{
	btElasticPlasticStatistics statistics;
	LinearSolver solver(statistics);
	Wall standing;
	const Values b = randomValues(standing.m_graph.m_numBodies);
	for (int step = 0; step < 2; ++step)
	{
		solver.beginStep(false);
		standing.solve(solver, b);
	}
	const long long factorisations = statistics.m_factorisations;
	Wall hit(3);
	solver.beginStep(false);
	hit.solve(solver, b);
	EXPECT_LE(difference(b, standing.solve(solver, b)), 1e-9);
	EXPECT_EQ(factorisations + 1, statistics.m_factorisations) << "one for the hit wall";
}
}  // namespace testLinearSolver
