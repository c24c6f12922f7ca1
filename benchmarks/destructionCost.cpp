// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Step times of the scenes of destruction, ours and Bullet's own way:
// ep-destruction-cost DIR [--large] [SCENE ...] writes destruction.md (a table), destruction.csv (every frame), and a plot of step time
// over the frame's number for each scene, destruction-SCENE.svg, to a folder. The machine should have nothing else to do.

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "DestructionRun.h"
#include "plot/Plot.h"
#include "text/Format.h"
#include "text/OutputFiles.h"

namespace
{
using namespace ep;

std::string heading()
{
	return "| Scene (joints) | Bullet: mean, p99, largest | ours | ratio | broken: Bullet, ours | energy gained: "
		   "Bullet, ours | "
		   "Newton, interior, factors a step | largest step: Newton, interior, factors | cut |\n"
		   "|---|---|---|---|---|---|---|---|---|\n";
}

std::string times(const DestructionRun::Way& way)
{
	return format("%.2f, %.2f, %.2f ms", 1e3 * way.mean(), 1e3 * way.quantile(0.99), 1e3 * way.largest());
}

std::string row(const DestructionScene& scene, const DestructionRun& run)
{
	const DestructionRun::Way &ours = run.ours, &bullets = run.bullets;
	const btElasticPlasticStatistics sum = run.sum();
	const size_t longest = size_t(std::max_element(ours.times.begin(), ours.times.end()) - ours.times.begin());
	const btElasticPlasticStatistics& worst = run.statistics[longest];
	const double frames = double(run.statistics.size());
	return format("| `%s` (%d) | ", scene.name, run.joints) + times(bullets) + " | " + times(ours) + " | " +
		   format("%.2f, %.2f, %.2f | %d, %d | ", ours.mean() / bullets.mean(),
				  ours.quantile(0.99) / bullets.quantile(0.99), ours.largest() / bullets.largest(), bullets.broken,
				  ours.broken) +
		   format("%.1e, %.1e | %.1f, %.1f, %.1f | ", bullets.summedGain, ours.summedGain,
				  double(sum.m_newtonSteps) / frames, double(sum.m_interiorIterations) / frames,
				  double(sum.m_factorisations) / frames) +
		   format("%lld, %lld, %lld | %lld |\n", worst.m_newtonSteps, worst.m_interiorIterations,
				  worst.m_factorisations, sum.m_cutSearches);
}

std::string csv(const DestructionScene& scene, const DestructionRun& run)
{
	std::string text;
	for (size_t i = 0; i < run.statistics.size(); ++i)
	{
		const btElasticPlasticStatistics& s = run.statistics[i];
		text += format("%s,%d,%.4f,%.4f,%lld,%lld,%lld,%lld,%lld\n", scene.name, int(i), 1e3 * run.bullets.times[i],
					   1e3 * run.ours.times[i], s.m_newtonSteps, s.m_interiorIterations, s.m_factorisations,
					   s.m_cutSearches, s.m_fallbacks);
	}
	return text;
}

Plot plotOf(const DestructionScene& scene, const DestructionRun& run)
{
	Plot plot;
	plot.m_title = scene.name;
	plot.m_xLabel = "frame";
	plot.m_yLabel = "time of the step [ms]";
	plot.m_fromZero = true;
	Plot::Curve bullets{"Bullet's own way", {}, Plot::DASHED, 0}, ours{"direct form", {}, Plot::SOLID, 1};
	for (size_t i = 0; i < run.ours.times.size(); ++i)
	{
		bullets.m_points.emplace_back(double(i), 1e3 * run.bullets.times[i]);
		ours.m_points.emplace_back(double(i), 1e3 * run.ours.times[i]);
	}
	plot.m_curves = {bullets, ours};
	return plot;
}

/// \param names  of scenes; none: all that are not large
void play(const std::string& folder, const std::vector<std::string>& names, bool withLarge)
{
	std::string table = heading(),
				frames = "scene,frame,bullet_ms,ours_ms,newton,interior,factorisations,cut,fallbacks\n";
	std::vector<const DestructionScene*> scenes;
	for (const std::string& name : names)
	{
		scenes.push_back(findDestructionScene(name));
		if (!scenes.back())
			throw std::runtime_error("there is no scene '" + name + "'");
	}
	for (const DestructionScene& scene : destructionScenes())
		if (names.empty() && (withLarge || !scene.isLarge))
			scenes.push_back(&scene);
	for (const DestructionScene* scene : scenes)
	{
		const DestructionRun run = DestructionRun::play(*scene, true);
		printf("%s", row(*scene, run).c_str());
		fflush(stdout);
		table += row(*scene, run);
		frames += csv(*scene, run);
		writeText(folder + "/destruction-" + scene->name + ".svg", plotOf(*scene, run).svg());
	}
	writeText(folder + "/destruction.md", table);
	writeText(folder + "/destruction.csv", frames);
}
}  // namespace

int main(int argc, char** argv)
{
	if (argc < 2 || argv[1][0] == '-')
	{
		fprintf(stderr,
				"Usage: ep-destruction-cost DIR [--large] [SCENE ...]\n"
				"Writes a table, step times and plots to a folder that exists.\n");
		return 1;
	}
	bool withLarge = false;
	std::vector<std::string> names;
	for (int i = 2; i < argc; ++i)
		if (std::strcmp(argv[i], "--large") == 0)
			withLarge = true;
		else
			names.push_back(argv[i]);
	try
	{
		play(argv[1], names, withLarge);
	}
	catch (const std::exception& error)
	{
		fprintf(stderr, "ep-destruction-cost: %s\n", error.what());
		return 1;
	}
	return 0;
}
