// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Scenes of destruction, from standing to rubble, compared with Bullet's own way: fixed joints with a breaking threshold and ten
// sequential impulses. A game shows its longest steps: mean, 99th percentile and largest step, of both and as ratios.

#include <benchmark/benchmark.h>

#include "DestructionRun.h"

namespace benchDestruction
{
using namespace ep;

void Destruction(benchmark::State& state, const DestructionScene& scene)
{
	DestructionRun run;
	for (auto _ : state)
	{
		run = DestructionRun::play(scene, true);
		state.SetIterationTime(run.ours.mean());
	}
	const DestructionRun::Way &ours = run.ours, &bullets = run.bullets;
	const btElasticPlasticStatistics sum = run.sum();
	const double frames = double(run.statistics.size());
	benchmark::UserCounters& counters = state.counters;
	counters["joints"] = run.joints;
	counters["mean_ms"] = 1e3 * ours.mean();
	counters["p99_ms"] = 1e3 * ours.quantile(0.99);
	counters["largest_ms"] = 1e3 * ours.largest();
	counters["bullet_mean_ms"] = 1e3 * bullets.mean();
	counters["bullet_p99_ms"] = 1e3 * bullets.quantile(0.99);
	counters["bullet_largest_ms"] = 1e3 * bullets.largest();
	counters["mean_ratio"] = ours.mean() / bullets.mean();
	counters["p99_ratio"] = ours.quantile(0.99) / bullets.quantile(0.99);
	counters["largest_ratio"] = ours.largest() / bullets.largest();
	counters["broken"] = ours.broken;
	counters["bullet_broken"] = bullets.broken;
	counters["largest_gain"] = ours.largestGain;
	counters["summed_gain"] = ours.summedGain;
	counters["bullet_summed_gain"] = bullets.summedGain;
	counters["newton"] = double(sum.m_newtonSteps) / frames;
	counters["interior"] = double(sum.m_interiorIterations) / frames;
	counters["factorisations"] = double(sum.m_factorisations) / frames;
	counters["cut"] = double(sum.m_cutSearches);
	counters["fallbacks"] = double(sum.m_fallbacks);
}

const bool IS_REGISTERED = []
{
	for (const DestructionScene& scene : destructionScenes())
		benchmark::RegisterBenchmark(
			(std::string(scene.isLarge ? "LargeDestruction/" : "Destruction/") + scene.name).c_str(), Destruction,
			scene)
			->UseManualTime()
			->Iterations(1)
			->Unit(benchmark::kMillisecond);
	return true;
}();
}  // namespace benchDestruction
