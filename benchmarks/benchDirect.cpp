// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Whole steps of the direct solver, 1/60 s, beside those of another world with the same bodies: of Bullet's own solver with 10
// iterations, which joins them by btGeneric6DofSpring2Constraint, or of the direct solver with sections that yield by independent
// bounds. Both take turns, so that the ratio holds on a noisy machine. What either gives for it is another matter: 10 iterations
// do not hold any of these structures.

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "StiffStructure.h"

namespace benchDirect
{
using namespace ep;

btElasticPlasticConstraintSolver& solverOf(StiffStructure& structure)
{
	return static_cast<btElasticPlasticConstraintSolver&>(*structure.world().bullet().getConstraintSolver());
}

void compare(benchmark::State& state, StiffStructure& direct, StiffStructure& other, const std::string& nameOfOther)
{
	// The first steps look at the graph for the first time, and fill caches.
	for (int i = 0; i < 3; ++i)
	{
		other.step();
		direct.step();
	}
	solverOf(direct).resetStatistics();
	std::vector<double> otherTimes, directTimes;
	for (auto _ : state)
	{
		otherTimes.push_back(other.step());
		directTimes.push_back(direct.step());
		state.SetIterationTime(directTimes.back());
	}
	const btElasticPlasticStatistics& s = solverOf(direct).getStatistics();
	const double steps = double(directTimes.size());
	state.counters["joints"] = direct.joints();
	state.counters[nameOfOther + "_us"] = 1e6 * medianOf(otherTimes);
	state.counters["direct_us"] = 1e6 * medianOf(directTimes);
	state.counters["direct/" + nameOfOther] = medianOf(directTimes) / medianOf(otherTimes);
	state.counters["newton"] = double(s.m_newtonSteps) / steps;
	state.counters["factorisations"] = double(s.m_factorisations) / steps;
	state.counters["iterations"] = double(s.m_iterations) / steps;
	state.counters["fallbacks"] = double(s.m_fallbacks) / steps;
	// In steps of their own: reading the clock takes time.
	btElasticPlasticSolverSettings timed = solverOf(direct).getSettings();
	timed.m_measuresTime = true;
	solverOf(direct).setSettings(timed);
	solverOf(direct).resetStatistics();
	const int timedSteps = 10;
	for (int i = 0; i < timedSteps; ++i)
		direct.step();
	const double parts[] = {s.m_setUpTime,         s.m_analysisTime, s.m_assemblyTime,
							s.m_factorisationTime, s.m_solutionTime, s.m_searchTime};
	const char* const names[] = {"set_up_us",        "analysis_us", "assembly_us",
								 "factorisation_us", "solution_us", "search_us"};
	for (int i = 0; i < 6; ++i)
		state.counters[names[i]] = 1e6 * parts[i] / timedSteps;
}

void Direct(benchmark::State& state, StiffStructure::Shape shape, bool collapsing, bool splitIslands = true,
			int threads = 1)
{
	StiffStructure::Settings settings;
	settings.shape = shape;
	settings.size = int(state.range(0));
	settings.collapsing = collapsing;
	settings.splitIslands = splitIslands;
	StiffStructure ours(settings);
	settings.joints = Joints::Springs;
	settings.solver = Solver::Stock;
	StiffStructure stock(settings);
	solverOf(ours).setNumThreads(threads);
	compare(state, ours, stock, "stock");
}

void Fibres(benchmark::State& state, StiffStructure::Shape shape, bool collapsing)
{
	StiffStructure::Settings settings;
	settings.shape = shape;
	settings.size = int(state.range(0));
	settings.collapsing = collapsing;
	StiffStructure independent(settings);
	settings.fibres = 8;
	StiffStructure fibres(settings);
	compare(state, fibres, independent, "independent");
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

// Sections that yield as a whole, beside independent bounds.
#define EP_FIBRES(name, shape, collapsing, size, steps)                       \
	BENCHMARK_CAPTURE(Fibres, name, StiffStructure::Shape::shape, collapsing) \
		->Arg(size)                                                           \
		->Iterations(steps)                                                   \
		->UseManualTime()                                                     \
		->Unit(benchmark::kMicrosecond)

EP_FIBRES(chain, Chain, false, 100, 1000);
EP_FIBRES(frame_elastic, Frame, false, 8, 40);
EP_FIBRES(wall_elastic, Wall, false, 70, 40);
EP_FIBRES(frame_collapsing, Frame, true, 8, 12);
EP_FIBRES(wall_collapsing, Wall, true, 70, 12);
}  // namespace benchDirect
