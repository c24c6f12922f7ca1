// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The reference problems, whole: what each takes at the game's step of 1/60 s, and how right it comes out.

#include <benchmark/benchmark.h>

#include "problems/Catalogue.h"

namespace benchProblems
{
using namespace ep;

struct Way
{
	const char* name;
	Solver solver;
	Stepping stepping;
};

void Solve(benchmark::State& state, const Problem& problem, const Way& way)
{
	Outcome outcome;
	double time = 0;
	for (auto _ : state)
	{
		outcome = problem.solve(way.solver, way.stepping);
		time += outcome.runTime;
		state.SetIterationTime(outcome.runTime);
	}
	state.counters["error_%"] = 100 * outcome.error();
	state.counters["substeps"] = outcome.substeps;
	state.counters["us_per_substep"] = 1e6 * time / double(state.iterations()) / outcome.substeps;
}

const bool IS_REGISTERED = []
{
	static const Way ways[] = {{"stock", Solver::Stock, {1. / 60, 1, 0}},
							   {"iterative", Solver::Iterative, {1. / 60, 1, 0}},
							   {"direct", Solver::Direct, {1. / 60, 1, 0}},
							   {"direct_8_substeps", Solver::Direct, {1. / 60, 8, 0}},
							   {"direct_for_10_percent", Solver::Direct, {1. / 60, 1, 0.1}},
							   {"direct_for_1_percent", Solver::Direct, {1. / 60, 1, 0.01}}};
	for (const Problem& problem : problems())
		for (const Way& way : ways)
			benchmark::RegisterBenchmark((std::string("Problem/") + problem.name + "/" + way.name).c_str(), Solve,
										 problem, way)
				->UseManualTime()
				->Iterations(5)
				->Unit(benchmark::kMillisecond);
	return true;
}();
}  // namespace benchProblems
