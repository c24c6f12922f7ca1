// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The direct solver's linear algebra: analysis, factorisation, solution and product for chains, a building's frame and a wall.
// The argument is the number of doubles in a vector, at most; 2 is what every x86-64 processor has. Where Eigen is found,
// its SimplicialLDLT takes turns with us, so that the ratio (how many times as long it takes) holds on a noisy machine.

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "../tests/linear/BlockGraphs.h"
#include "BulletDynamics/ConstraintSolver/ElasticPlastic/linear/BlockFactor.h"

#if __has_include(<Eigen/SparseCholesky>)
#define EP_WITH_EIGEN
#include <Eigen/SparseCholesky>
#endif

namespace benchBlockFactor
{
using namespace ep;

/// A matrix, our factor and Eigen's, and a right-hand side.
struct Problem
{
	btElasticPlastic::BlockMatrix m_matrix;
	btElasticPlastic::BlockFactor m_factor;
	std::vector<double> m_right, m_x;
#ifdef EP_WITH_EIGEN
	Eigen::SparseMatrix<double> m_eigenMatrix;
	Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> m_eigenFactor;
	Eigen::VectorXd m_eigenRight, m_eigenX;
#endif

	Problem(const BlockGraph& graph, int width)
	{
		m_matrix.setPattern(graph.m_numBodies, graph.edges(), int(graph.m_edges.size()));
		assemble(graph, 10, 1, m_matrix);
		m_factor.setMaxVectorWidth(width);
		m_factor.analyse(m_matrix);
		m_factor.factorise(m_matrix);
		m_right.assign(6 * size_t(graph.m_numBodies), 1);
		m_x = m_right;
#ifdef EP_WITH_EIGEN
		std::vector<Eigen::Triplet<double>> elements;
		const auto put = [&elements](int rows, int columns, const double* block)
		{
			for (int r = 0; r < 6; ++r)
				for (int c = 0; c < 6; ++c)
					if (rows != columns || r >= c)
						elements.emplace_back(6 * rows + r, 6 * columns + c, block[6 * c + r]);
		};
		for (int i = 0; i < graph.m_numBodies; ++i)
			put(i, i, m_matrix.diagonal(i));
		for (int p = 0; p < m_matrix.getNumPairs(); ++p)
			put(m_matrix.getHigherBody(p), m_matrix.getLowerBody(p),
				m_matrix.getValues() + 36 * (size_t(graph.m_numBodies) + p));
		m_eigenMatrix.resize(6 * graph.m_numBodies, 6 * graph.m_numBodies);
		m_eigenMatrix.setFromTriplets(elements.begin(), elements.end());
		m_eigenFactor.compute(m_eigenMatrix);
		m_eigenRight = Eigen::VectorXd::Ones(6 * graph.m_numBodies);
#endif
	}

	void analyse() { m_factor.analyse(m_matrix); }
	void factorise() { m_factor.factorise(m_matrix); }
	void refactorise()
	{
		// One body in a hundred, next to each other in number.
		std::vector<int> changed;
		for (int i = 0, n = m_factor.getNumBodies(); i < std::max(1, n / 100); ++i)
			changed.push_back(n / 2 + i);
		m_factor.factorise(m_matrix, changed.data(), int(changed.size()));
	}
	void solve()
	{
		m_x = m_right;
		m_factor.solve(m_x.data());
	}
	void multiply() { m_matrix.multiply(m_right.data(), m_x.data()); }

#ifdef EP_WITH_EIGEN
	void eigenAnalyse() { m_eigenFactor.analyzePattern(m_eigenMatrix); }
	void eigenFactorise() { m_eigenFactor.factorize(m_eigenMatrix); }
	void eigenSolve() { m_eigenX = m_eigenFactor.solve(m_eigenRight); }
	void eigenMultiply() { m_eigenX.noalias() = m_eigenMatrix.selfadjointView<Eigen::Lower>() * m_eigenRight; }
#else
	void eigenAnalyse() {}
	void eigenFactorise() {}
	void eigenSolve() {}
	void eigenMultiply() {}
#endif
};

template <class Work>
double seconds(Work work)
{
	const auto start = std::chrono::steady_clock::now();
	work();
	return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double>& values)
{
	std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
	return values[values.size() / 2];
}

void run(benchmark::State& state, const BlockGraph& graph, void (Problem::*ours)(), void (Problem::*eigens)())
{
	Problem problem(graph, int(state.range(0)));
	if (problem.m_factor.getVectorWidth() != state.range(0))
		return state.SkipWithError("the processor has no such vectors");
	if (!problem.m_factor.hasFactor())
		return state.SkipWithError("not positive definite");

	// Eigen's turns take longer: one for eight of ours.
	std::vector<double> times, eigenTimes;
	for (auto _ : state)
	{
		const double time = seconds([&] { (problem.*ours)(); });
		state.SetIterationTime(time);
		times.push_back(time);
		if (eigens && (times.size() & 7) == 1)
			eigenTimes.push_back(seconds([&] { (problem.*eigens)(); }));
	}
	state.SetItemsProcessed(state.iterations() * graph.m_numBodies);
	state.counters["blocks"] = double(problem.m_factor.getNumBlocks());
	state.counters["MB"] = double(problem.m_factor.getMemory()) / 1e6;
	if (ours == &Problem::factorise)
		state.counters["Gflop/s"] = double(problem.m_factor.getNumOperations()) / median(times) / 1e9;
#ifdef EP_WITH_EIGEN
	if (eigens)
		state.counters["Eigen"] = median(eigenTimes) / median(times);
#endif
}

int registerAll()
{
	struct NamedGraph
	{
		const char* m_name;
		BlockGraph m_graph;
		bool m_isChain;
	};
	struct NamedWork
	{
		const char* m_name;
		void (Problem::*m_ours)();
		void (Problem::*m_eigens)();
	};
	const NamedGraph graphs[] = {{"chain10", chains(1, 10), true},
								 {"chain100", chains(1, 100), true},
								 {"chains500x20", chains(500, 20), true},
								 {"frame", frame(), false},
								 {"wall", wall(), false}};
	const NamedWork works[] = {{"analyse", &Problem::analyse, &Problem::eigenAnalyse},
							   {"factorise", &Problem::factorise, &Problem::eigenFactorise},
							   {"refactorise", &Problem::refactorise, nullptr},
							   {"solve", &Problem::solve, &Problem::eigenSolve},
							   {"multiply", &Problem::multiply, &Problem::eigenMultiply}};
	for (const NamedGraph& graph : graphs)
		for (const NamedWork& work : works)
		{
			auto* entry =
				benchmark::RegisterBenchmark((std::string("BlockFactor/") + graph.m_name + "/" + work.m_name).c_str(),
											 [graph = graph.m_graph, work](benchmark::State& state)
											 { run(state, graph, work.m_ours, work.m_eigens); });
			entry->UseManualTime()->Unit(benchmark::kMicrosecond);
			// Only the factor has kernels for several vectors, and no use for the widest in a chain.
			const bool isFactors = work.m_ours != &Problem::analyse && work.m_ours != &Problem::multiply;
			for (int width = 1; width <= (isFactors ? (graph.m_isChain ? 4 : 8) : 1); width *= 2)
				entry->Arg(width);
		}
	return 0;
}

const int Registered = registerAll();
}  // namespace benchBlockFactor
