// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The direct solver against Bullet's own with 10 iterations, whole steps of 1/60 s on the same bodies, which Bullet's joins by
// btGeneric6DofSpring2Constraint. Both take turns, so that the ratio holds on a noisy machine. What either gives for it is
// another matter: 10 iterations do not hold any of these structures.

#include <benchmark/benchmark.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "StiffStructure.h"

namespace benchDirect
{
using namespace ep;

void Direct(benchmark::State& state, StiffStructure::Shape shape, bool collapsing, bool splitIslands = true,
			int threads = 1, int fibres = 0)
{
	StiffStructure::Settings settings;
	settings.shape = shape;
	settings.size = int(state.range(0));
	settings.collapsing = collapsing;
	settings.splitIslands = splitIslands;
	settings.fibres = fibres;
	StiffStructure ours(settings);
	settings.joints = Joints::Springs;
	settings.solver = Solver::Stock;
	StiffStructure stock(settings);
	auto& solver = static_cast<btElasticPlasticConstraintSolver&>(*ours.world().bullet().getConstraintSolver());
	solver.setNumThreads(threads);
	// The first steps look at the graph for the first time, and fill caches.
	for (int i = 0; i < 3; ++i)
	{
		stock.step();
		ours.step();
	}
	solver.resetStatistics();
	std::vector<double> stockTimes, ourTimes;
	for (auto _ : state)
	{
		stockTimes.push_back(stock.step());
		ourTimes.push_back(ours.step());
		state.SetIterationTime(ourTimes.back());
	}
	const btElasticPlasticStatistics& s = solver.getStatistics();
	const double steps = double(ourTimes.size());
	state.counters["joints"] = ours.joints();
	state.counters["stock_us"] = 1e6 * medianOf(stockTimes);
	state.counters["direct_us"] = 1e6 * medianOf(ourTimes);
	state.counters["direct/stock"] = medianOf(ourTimes) / medianOf(stockTimes);
	state.counters["newton"] = double(s.m_newtonSteps) / steps;
	state.counters["factorisations"] = double(s.m_factorisations) / steps;
	state.counters["iterations"] = double(s.m_iterations) / steps;
	state.counters["fallbacks"] = double(s.m_fallbacks) / steps;
	const double parts[] = {s.m_setUpTime,         s.m_analysisTime, s.m_assemblyTime,
							s.m_factorisationTime, s.m_solutionTime, s.m_searchTime};
	const char* const names[] = {"set_up_us",        "analysis_us", "assembly_us",
								 "factorisation_us", "solution_us", "search_us"};
	for (int i = 0; i < 6; ++i)
		state.counters[names[i]] = 1e6 * parts[i] / steps;
}

#define EP_DIRECT(name, shape, collapsing, size, steps)                       \
	BENCHMARK_CAPTURE(Direct, name, StiffStructure::Shape::shape, collapsing) \
		->Arg(size)                                                           \
		->Iterations(steps)                                                   \
		->UseManualTime()                                                     \
		->Unit(benchmark::kMicrosecond)

EP_DIRECT(chain, Chain, false, 10, 3000);
EP_DIRECT(chain, Chain, false, 100, 1000);
EP_DIRECT(chains, Chains, false, 500, 60);
BENCHMARK_CAPTURE(Direct, chains_unsplit, StiffStructure::Shape::Chains, false, false)
	->Arg(500)
	->Iterations(60)
	->UseManualTime()
	->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Direct, chains_unsplit_two_threads, StiffStructure::Shape::Chains, false, false, 2)
	->Arg(500)
	->Iterations(60)
	->UseManualTime()
	->Unit(benchmark::kMicrosecond);
EP_DIRECT(frame_elastic, Frame, false, 8, 40);
EP_DIRECT(wall_elastic, Wall, false, 70, 40);
EP_DIRECT(frame_collapsing, Frame, true, 8, 12);
EP_DIRECT(wall_collapsing, Wall, true, 70, 12);

// The same with sections that yield as a whole.
#define EP_FIBRES(name, shape, collapsing, size, steps)                                   \
	BENCHMARK_CAPTURE(Direct, name, StiffStructure::Shape::shape, collapsing, true, 1, 8) \
		->Arg(size)                                                                       \
		->Iterations(steps)                                                               \
		->UseManualTime()                                                                 \
		->Unit(benchmark::kMicrosecond)

EP_FIBRES(chain_8_fibres, Chain, false, 100, 1000);
EP_FIBRES(frame_elastic_8_fibres, Frame, false, 8, 40);
EP_FIBRES(wall_elastic_8_fibres, Wall, false, 70, 40);
EP_FIBRES(frame_collapsing_8_fibres, Frame, true, 8, 12);
EP_FIBRES(wall_collapsing_8_fibres, Wall, true, 70, 12);
}  // namespace benchDirect
