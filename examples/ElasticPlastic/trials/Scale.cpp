// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "trials/Scale.h"

#include <cmath>

#include "scenes/Cantilever.h"
#include "scenes/HangingChain.h"
#include "trials/TrialRun.h"

namespace ep
{
namespace
{
std::string times(double factor)
{
	char text[32];
	snprintf(text, sizeof text, "x %.0e", factor);
	return text;
}

/// What a length can tell; and where k dt^2 A is beyond 1e16, the solve has no digits for what is less than a billionth of it.
double slackOf(double length) { return std::max(roundingAt(length), 1e-10 * length); }

/// A steel cantilever of ten blocks comes to rest; its sag is to be exact to 1 %.
Verdict restingCantilever(const TrialSetup& setup, double scale, double stiffness, double step, double time,
						  double damping = 0)
{
	Cantilever::Settings settings;
	settings.method = setup.method;
	settings.length *= btScalar(scale);
	settings.member.width *= btScalar(scale);
	settings.member.height *= btScalar(scale);
	settings.gravity /= btScalar(scale);
	settings.member.material.m_youngsModulus *= btScalar(stiffness);
	Cantilever cantilever(settings);
	for (btRigidBody* part : cantilever.m_member.m_parts)
		part->setDamping(btScalar(damping), btScalar(damping));
	TrialRun run(cantilever.m_world, setup);
	run.runFor(time, step);
	const double sag = cantilever.staticSag(), length = double(settings.length);
	// What hangs deeper than a tenth of its length is no small deflection.
	if (sag > 0.1 * length)
		return run.verdict();
	return run.verdict(double(cantilever.sag()), sag, 0.01 * sag + slackOf(length));
}

Verdict chainWithEnd(const TrialSetup& setup, double ratio)
{
	HangingChain::Settings settings;
	settings.method = setup.method;
	settings.lastFactor = btScalar(ratio);
	// Of the same stretch whatever it bears.
	settings.member.material.m_youngsModulus *= btScalar(std::max(1., ratio / 1000));
	settings.member.material.m_yieldStress = btElasticPlasticCapacity::unlimited();
	HangingChain chain(settings);
	TrialRun run(chain.m_world, setup);
	run.runFor(3, 1. / 60);
	const double stretch = chain.staticStretch();
	return run.verdict(double(chain.stretch()), stretch, 0.01 * stretch + roundingAt(double(settings.length)));
}

/// Every step of another length, between 1/30 and 1/3000 s.
Verdict changingSteps(const TrialSetup& setup)
{
	Cantilever::Settings settings;
	settings.method = setup.method;
	Cantilever cantilever(settings);
	TrialRun run(cantilever.m_world, setup);
	unsigned random = 1;
	for (double time = 0; time < 2;)
	{
		random = random * 1664525u + 1013904223u;
		const double step = 1. / 30 * std::pow(0.01, double(random >> 8) / (1 << 24));
		run.step(step);
		time += step;
	}
	const double sag = cantilever.staticSag();
	return run.verdict(double(cantilever.sag()), sag, 0.01 * sag + roundingAt(2));
}
}  // namespace

std::vector<Trial> trialsOfScale()
{
	std::vector<Trial> trials;
	for (const double factor : {1e-6, 1e-3, 1., 1e3, 1e6, 1e9})
		trials.push_back({"stiffness", times(factor), [factor](const TrialSetup& setup) {
							  return restingCantilever(setup, 1, factor, 1. / 60, 2);
						  }});
	for (const double ratio : {1e-6, 1e-3, 1e3, 1e6})
		trials.push_back({"mass of a chain's end over the others'", times(ratio),
						  [ratio](const TrialSetup& setup) { return chainWithEnd(setup, ratio); }});
	for (const auto& [scale, name] :
		 {std::pair(0.005, "1 mm"), std::pair(0.5, "100 mm"), std::pair(5., "1 m"), std::pair(5000., "1 km")})
		trials.push_back({"size of the elements", name,
						  [s = scale](const TrialSetup& setup)
						  {
							  // A kilometre swings in 250 s, which the step resolves and so does not damp.
							  return s > 1000 ? restingCantilever(setup, s, 1, 1. / 60, 500, 0.025)
											  : restingCantilever(setup, s, 1, 1. / 60, 2);
						  },
						  scale > 1000 ? "a step moves it by less than a float can tell at 10 km" : nullptr});
	for (const int rate : {10, 30, 240, 1000})
		trials.push_back({"step", "1/" + std::to_string(rate) + " s", [rate](const TrialSetup& setup) {
							  return restingCantilever(setup, 1, 1, 1. / rate, 10, rate > 100 ? 0.9 : 0);
						  }});
	// A tenth of a second of 20 Hz: no rest to compare with.
	trials.push_back({"step", "1/100000 s",
					  [](const TrialSetup& setup)
					  {
						  Verdict v = restingCantilever(setup, 1, 1, 1e-5, 0.1);
						  v.exact = NAN;
						  return v;
					  }});
	trials.push_back({"step", "changing between 1/30 and 1/3000 s", changingSteps});
	for (const double damping : {0.5, 0.99, 1.})
		trials.push_back({"Bullet's damping of bodies", std::to_string(damping).substr(0, 4),
						  [damping](const TrialSetup& setup)
						  {
							  Verdict v = restingCantilever(setup, 1, 1, 1. / 60, 2, damping);
							  // All velocity is gone before each step: work by mean velocities sees half of the way, and there
							  // is no time at which the bodies have their velocities.
							  v.createdByJoints = damping == 1 ? 0 : v.createdByJoints;
							  return v;
						  }});
	return trials;
}
}  // namespace ep
