// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "problems/Beams.h"

#include <cmath>

#include "problems/LimitLoad.h"
#include "scenes/Cantilever.h"
#include "scenes/HangingChain.h"
#include "scenes/LoadedBeam.h"
#include "scenes/PortalFrame.h"

namespace ep
{
namespace
{
Outcome cantileverAtRest(const Method& method, const Stepping& stepping)
{
	Cantilever::Settings settings;
	settings.method = method;
	Cantilever cantilever(settings);
	Outcome outcome;
	Run run(cantilever.m_world, stepping, outcome);
	const double sag = run.meanUntil(1.5, 1, [&] { return double(cantilever.sag()); });
	outcome.quantities = {{"sag of the tip [m]", sag, cantilever.staticSag()}};
	return outcome;
}

Outcome cantileverSwinging(const Method& method, const Stepping& stepping)
{
	Cantilever::Settings settings = Cantilever::Settings::twentyBlocks();
	settings.method = method;
	Cantilever cantilever(settings);
	Outcome outcome;
	Run run(cantilever.m_world, stepping, outcome);
	// Whole periods: between the first and the last time that it sinks past its place at rest.
	double before = 0, sum = 0, pending = 0;
	int counted = 0, pendingSteps = 0;
	bool begun = false;
	while (run.stepsUntil(10) > 0)
	{
		run.step();
		const double sag = cantilever.sag();
		if (before < cantilever.staticSag() && sag >= cantilever.staticSag())
		{
			if (begun)
			{
				sum += pending;
				counted += pendingSteps;
			}
			begun = true;
			pending = pendingSteps = 0;
		}
		pending += sag;
		++pendingSteps;
		before = sag;
	}
	// By explicit integration (tests/problems/testReferences.cpp); so far from straight it is half a per cent less than by statics.
	outcome.quantities = {{"mean sag of the tip [m]", counted > 0 ? sum / counted : before, 0.58358}};
	return outcome;
}

Outcome hangingChain(const Method& method, const Stepping& stepping)
{
	HangingChain::Settings settings;
	settings.method = method;
	HangingChain chain(settings);
	Outcome outcome;
	Run run(chain.m_world, stepping, outcome);
	const double stretch = run.meanUntil(2, 1.5, [&] { return double(chain.stretch()); });
	outcome.quantities = {{"stretch [m]", stretch, chain.staticStretch()}};
	return outcome;
}

// ---- limit loads

Outcome beam(const Method& method, const Stepping& stepping, LoadedBeam::Supports supports, bool uniform)
{
	LoadedBeam::Settings settings;
	settings.method = method;
	settings.supports = supports;
	Outcome outcome;
	const double factor = limitFactor(
		[&](double f)
		{
			LoadedBeam b(settings);
			// What stands sags by less than 0.02 of the length.
			return stands(
				b, stepping, outcome, 0.05 * double(settings.length),
				[&](double share) {
					uniform ? b.loadUniformly(f * share * b.uniformCollapseLoad())
							: b.load(f * share * b.collapseLoad());
				},
				[&] { return double(b.sag()); });
		});
	outcome.quantities = {{"load at collapse over the exact one", factor, 1}};
	return outcome;
}

template <LoadedBeam::Supports supports, bool uniform>
Outcome beamOf(const Method& method, const Stepping& stepping)
{
	return beam(method, stepping, supports, uniform);
}

/// Loads in multiples of Mp/L and Mp/h.
Outcome portal(const Method& method, const Stepping& stepping, double vertical, double horizontal)
{
	PortalFrame::Settings settings;
	settings.method = method;
	Outcome outcome;
	const double factor = limitFactor(
		[&](double f)
		{
			PortalFrame frame(settings);
			const double v = vertical * frame.plasticMoment() / double(settings.span),
						 h = horizontal * frame.plasticMoment() / double(settings.height);
			const double exact = frame.collapseFactor(v, h);
			// What stands gives by less than a centimetre, but close to collapse.
			return stands(
				frame, stepping, outcome, 0.05,
				[&](double share) { frame.load(f * share * exact * v, f * share * exact * h); },
				[&] { return double(frame.sag() + frame.sway()); });
		});
	outcome.quantities = {{"load at collapse over the exact one", factor, 1}};
	return outcome;
}

Outcome portalBeam(const Method& method, const Stepping& stepping) { return portal(method, stepping, 8, 0); }
Outcome portalSway(const Method& method, const Stepping& stepping) { return portal(method, stepping, 0, 4); }
Outcome portalBoth(const Method& method, const Stepping& stepping) { return portal(method, stepping, 6, 3); }
}  // namespace

std::vector<Problem> problemsOfBeams()
{
	typedef LoadedBeam::Supports Supports;
	const char* const rest = "statics of rigid parts and springs";
	const char* const limit = "limit analysis";
	return {
		{"cantilever-at-rest", "2 m of steel in ten blocks", rest, cantileverAtRest},
		{"cantilever-swinging", "10 m of steel in twenty blocks, let go", "explicit integration at 10 us",
		 cantileverSwinging},
		{"hanging-chain", "six steel blocks, the last a thousand times heavier", rest, hangingChain},
		{"beam-simple", "load at mid span, ends hinged", limit, beamOf<Supports::Simple, false>},
		{"beam-propped", "load at mid span, one end clamped", limit, beamOf<Supports::Propped, false>},
		{"beam-fixed", "load at mid span, both ends clamped", limit, beamOf<Supports::Fixed, false>},
		{"beam-simple-uniform", "uniform load, ends hinged", limit, beamOf<Supports::Simple, true>},
		{"beam-propped-uniform", "uniform load, one end clamped", limit, beamOf<Supports::Propped, true>},
		{"beam-fixed-uniform", "uniform load, both ends clamped", limit, beamOf<Supports::Fixed, true>},
		{"portal-beam", "a frame whose beam fails", limit, portalBeam},
		{"portal-sway", "a frame that falls sideways", limit, portalSway},
		{"portal-both", "a frame that fails both ways at once", limit, portalBoth},
	};
}
}  // namespace ep
