// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "DestructionRun.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "world/EnergyAudit.h"

namespace ep
{
namespace
{
const int REPEATS = 2;

/// What this thread has computed [s]: others on the same machine have no part in it.
double threadTime()
{
	timespec now;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
	return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

Stage::Settings settingsOf(const DestructionScene& scene, bool isBulletsWay)
{
	Stage::Settings settings;
	settings.strength = scene.strength;
	settings.isBulletsWay = isBulletsWay;
	return settings;
}

void step(Stage& stage, DestructionRun::Way& way)
{
	const size_t frame = size_t(stage.frame());
	stage.playScript();
	const double begin = threadTime();
	stage.step();
	const double time = threadTime() - begin;
	if (frame == way.times.size())
		way.times.push_back(time);
	else
		way.times[frame] = std::min(way.times[frame], time);
}

void playBothWays(const DestructionScene& scene, DestructionRun& run)
{
	Stage bullets(settingsOf(scene, true)), ours(settingsOf(scene, false));
	scene.build(bullets);
	scene.build(ours);
	run.joints = ours.numJoints();
	run.statistics.clear();
	while (ours.frame() < scene.frames)
	{
		step(bullets, run.bullets);
		ours.solver()->resetStatistics();
		step(ours, run.ours);
		run.statistics.push_back(ours.solver()->getStatistics());
	}
	run.ours.broken = ours.numBroken();
	run.bullets.broken = bullets.numBroken();
}

void audit(const DestructionScene& scene, bool isBulletsWay, DestructionRun::Way& way)
{
	Stage stage(settingsOf(scene, isBulletsWay));
	scene.build(stage);
	EnergyAudit audit(stage.world());
	double largest = 0, sum = 0;
	while (stage.frame() < scene.frames)
	{
		stage.playScript();
		audit.begin();
		stage.step();
		audit.end(btScalar(Stage::FRAME));
		const double gain = std::max(0., audit.gain() - audit.bulletsRecovery());
		largest = std::max(largest, gain);
		sum += gain;
	}
	way.largestGain = largest / audit.turnover();
	way.summedGain = sum / audit.turnover();
}
}  // namespace

double DestructionRun::Way::mean() const
{
	return std::accumulate(times.begin(), times.end(), 0.) / double(times.size());
}

double DestructionRun::Way::largest() const { return *std::max_element(times.begin(), times.end()); }

double DestructionRun::Way::quantile(double share) const
{
	std::vector<double> sorted = times;
	std::sort(sorted.begin(), sorted.end());
	return sorted[size_t(share * double(sorted.size() - 1))];
}

btElasticPlasticStatistics DestructionRun::sum() const
{
	btElasticPlasticStatistics sum;
	for (const btElasticPlasticStatistics& frame : statistics)
		sum += frame;
	return sum;
}

DestructionRun DestructionRun::play(const DestructionScene& scene, bool isAudited)
{
	DestructionRun run;
	run.ours.largestGain = run.ours.summedGain = run.bullets.largestGain = run.bullets.summedGain = NAN;
	// All is the same each time but what else the machine does: the least time of a frame has least of that.
	for (int i = 0; i < REPEATS; ++i)
		playBothWays(scene, run);
	if (isAudited)
	{
		audit(scene, false, run.ours);
		audit(scene, true, run.bullets);
	}
	return run;
}
}  // namespace ep
