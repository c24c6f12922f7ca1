// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What it costs to go back, beside what it costs to go on: a game that rolls back restores a snapshot and steps again.

#include <benchmark/benchmark.h>

#include <chrono>
#include <vector>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticSnapshot.h"
#include "StiffStructure.h"

namespace benchSnapshot
{
using namespace ep;

void Snapshot(benchmark::State& state)
{
	StiffStructure::Settings settings;
	settings.shape = StiffStructure::Shape::Wall;
	settings.size = int(state.range(0));
	settings.collapsing = state.range(1) != 0;
	StiffStructure structure(settings);
	World& world = structure.world();
	auto& broadphase = static_cast<btDbvtBroadphase&>(*world.bullet().getBroadphase());
	std::vector<unsigned char> bytes;
	const auto save = [&]
	{
		bytes.resize(
			size_t(btElasticPlasticSave(world.bullet(), broadphase, world.action(), bytes.data(), int(bytes.size()))));
	};
	for (int i = 0; i < 5; ++i)
		structure.step();
	save();
	std::vector<double> steps, saves, restores;
	for (auto _ : state)
	{
		auto begin = std::chrono::steady_clock::now();
		save();
		saves.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
		for (int i = 0; i < 8; ++i)
			steps.push_back(structure.step());
		begin = std::chrono::steady_clock::now();
		if (btElasticPlasticRestore(world.bullet(), broadphase, world.action(), bytes.data(), int(bytes.size())))
			state.SkipWithError("The snapshot is refused");
		restores.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
		state.SetIterationTime(restores.back());
		structure.step();
	}
	state.counters["joints"] = structure.joints();
	state.counters["bytes/joint"] = double(bytes.size()) / structure.joints();
	state.counters["step_us"] = 1e6 * medianOf(steps);
	state.counters["save_us"] = 1e6 * medianOf(saves);
	// Of a game that saves in each step and goes back by eight.
	state.counters["rollback_steps"] = (8 * medianOf(saves) + medianOf(restores)) / medianOf(steps);
}

BENCHMARK(Snapshot)->Args({16, 0})->Args({16, 1})->Iterations(50)->UseManualTime()->Unit(benchmark::kMicrosecond);
}  // namespace benchSnapshot
