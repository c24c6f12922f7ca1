// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "runs/Comparison.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "text/Format.h"

namespace ep
{
namespace
{
const double REST = 6;      // for the bridge to come to rest in, the last one of them to measure its mean [s]
const double LONGEST = 40;  // [s]

/// Of this program, whatever else the machine does [s].
double processorTime() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Of what has flown apart there is nothing to tell.
std::string metres(double value)
{
	return std::isfinite(value) && std::fabs(value) < 100 ? format("%.4f m", value) : "-";
}

std::string line(const Comparison& c)
{
	const std::string ratio = metres(c.sag) == "-" ? "-" : format("%.3g", c.sag / c.exactSag);
	return format("| `%s` | %s | %s | %s | %s | %d | %d | %s | %.0f µs |\n", nameOf(jointKinds(), c.kind).c_str(),
				  nameOf(solvers(), c.solver).c_str(), metres(c.sag).c_str(), ratio.c_str(),
				  c.end.crossed ? "yes" : "no", c.end.yielded, c.end.broken, metres(c.end.sag).c_str(),
				  c.stepTime * 1e6);
}

/// Simulated over real time of the whole drive, and of its slowest second.
std::string speedLine(const char* name, DemolisherSettings settings, const std::vector<Scene>& built)
{
	settings.scenes = built;
	Demolisher demolisher(settings);
	double slowest = HUGE_VAL, spent = 0, before = 0;
	const int second = int(1 / double(settings.step) + .5);
	for (int i = 0; demolisher.time() < LONGEST && !demolisher.autopilot().hasArrived(); ++i)
	{
		const double begin = processorTime();
		demolisher.stepByAutopilot();
		spent += processorTime() - begin;
		if (i % second == second - 1)
		{
			slowest = std::min(slowest, 1 / (spent - before));
			before = spent;
		}
	}
	return format("| %s | %d | %.0f | %.0f |\n", name, int(demolisher.joints().records().size()),
				  demolisher.time() / spent, slowest);
}
}  // namespace

Comparison compare(const DemolisherSettings& settings, const JointKind& kind, Solver solver)
{
	DemolisherSettings s = settings;
	s.scenes = {Scene::Bridge};
	s.route.clear();
	s.method = Method(solver, kind, settings.method.iterations);
	s.sleepSpeed = 0;
	Demolisher demolisher(s);
	Controls waits;
	waits.handbrake = true;
	double sum = 0;
	int samples = 0;
	while (demolisher.time() < REST)
	{
		demolisher.step(waits);
		if (demolisher.time() > REST - 1)
		{
			sum += demolisher.summary().sag;
			++samples;
		}
	}
	Comparison c = {kind, solver, sum / samples, demolisher.bridge()->exactSag(s.gravity), 0, {}};
	double spent = 0;
	int steps = 0;
	for (; demolisher.time() < LONGEST && !demolisher.autopilot().hasArrived(); ++steps)
	{
		const double begin = processorTime();
		demolisher.stepByAutopilot();
		spent += processorTime() - begin;
	}
	c.stepTime = spent / steps;
	c.end = demolisher.summary();
	return c;
}

std::string comparisonTables(const DemolisherSettings& settings)
{
	std::string text =
		format("%d substeps in each step of %.4g s, %d iterations, %s\n\n", settings.substeps, double(settings.step),
			   settings.method.iterations, sizeof(btScalar) == sizeof(double) ? "double" : "float");
	text += "| Joint | Solver | Sag at rest | Over exact | Crossed | Yielded | Broken | Sag at the end | A step |\n";
	text += "|---|---|---|---|---|---|---|---|---|\n";
	for (const auto& kind : jointKinds())
		for (const auto& solver : solvers())
			// Our solver leaves islands without our joints to Bullet's.
			if (kind.value.isElasticPlastic() || solver.value == Solver::Stock)
				text += line(compare(settings, kind.value, solver.value));
	text += "\n| Scene | Joints | Times real time | In its slowest second |\n|---|---|---|---|\n";
	for (const auto& scene : scenes())
		text += speedLine(scene.name, settings, {scene.value});
	return text + speedLine("all", settings, DemolisherSettings().scenes);
}
}  // namespace ep
