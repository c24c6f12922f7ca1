// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "studies/CharpyStudies.h"

#include <cmath>

#include "studies/CharpyFriction.h"

namespace ep
{
namespace
{
CharpyResult runWith(CharpySettings settings, double step, double friction)
{
	settings.step = step;
	settings.friction = friction;
	return Charpy(settings).run();
}

CharpyTable tableXI(const CharpySettings& settings)
{
	CharpyTable t;
	t.name = "table-xi";
	t.title = "Table XI of the paper, energy loss [J], and the same in both presets";
	t.columns = {"dt_ms",
				 "paper",
				 "paper_preset",
				 "its_least_of_41_shifts",
				 "its_most_of_41_shifts",
				 "repeatable_no_friction",
				 "repeatable_friction_0.1",
				 "least_of_41_shifts",
				 "most_of_41_shifts",
				 "passing_energy"};
	const struct
	{
		double step, loss;
	} printed[] = {{0.2e-3, 170}, {0.1e-3, 120}, {0.05e-3, 150}};
	for (const auto& row : printed)
	{
		CharpySettings paper = CharpySettings::paper(), ours = settings;
		paper.step = ours.step = row.step;
		ours.friction = 0.1;
		const CharpySpread its = spreadOf(lossesOverShifts(paper)), mine = spreadOf(lossesOverShifts(ours));
		t.add({row.step * 1e3, row.loss, Charpy(paper).run().loss(), its.least, its.most,
			   runWith(ours, row.step, 0).loss(), Charpy(ours).run().loss(), mine.least, mine.most,
			   ours.passingEnergy()});
	}
	return t;
}

CharpyTable steps(const CharpySettings& settings)
{
	CharpyTable t;
	t.name = "steps";
	t.title = "Energy loss over the time step";
	t.yTitle = "loss [J]";
	t.logarithmic = true;
	t.columns = {
		"dt_ms", "no friction", "friction 0.1", "paper preset", "M theta + kinetic, no friction", "M theta, geometry"};
	t.series = {{1, true}, {2, true}, {3, true}, {5, true}};
	for (double step : {0.5e-3, 0.2e-3, 0.1e-3, 0.05e-3, 0.02e-3, 0.01e-3})
	{
		CharpySettings paper = CharpySettings::paper();
		paper.step = step;
		const CharpyResult free = runWith(settings, step, 0);
		t.add({step * 1e3, free.loss(), runWith(settings, step, 0.1).loss(), Charpy(paper).run().loss(),
			   free.plasticMoment * free.hingeAngle + free.specimenEnergy, settings.passingEnergy()});
	}
	return t;
}

CharpyTable shifts(const CharpySettings& settings)
{
	CharpyTable t;
	t.name = "shifts";
	t.title = "Energy loss over the hammer's place";
	t.yTitle = "loss [J]";
	t.columns = {"shift_um", "no friction", "friction 0.1", "paper preset"};
	t.series = {{1, false}, {2, false}, {3, false}};
	CharpySettings free = settings, rubbing = settings, paper = CharpySettings::paper();
	free.friction = 0;
	rubbing.friction = 0.1;
	paper.step = settings.step;
	const std::vector<double> a = lossesOverShifts(free), b = lossesOverShifts(rubbing), c = lossesOverShifts(paper);
	for (size_t i = 0; i < a.size(); ++i)
		t.add({double(i) - 20, a[i], b[i], c[i]});
	return t;
}

CharpyTable ways(const CharpySettings& settings)
{
	CharpyTable t;
	t.name = "ways";
	t.title = "The ways of modelling";
	t.labelColumn = "joint";
	t.columns = {"loss_J",    "plastic_J",   "kinetic_J",         "friction_J", "contacts_J",
				 "elastic_J", "numerical_J", "greatest_bend_rad", "broken",     "bounced"};
	for (const auto& way : charpyWays())
	{
		CharpySettings s = settings;
		s.way = way.value;
		const CharpyResult r = Charpy(s).run();
		t.add({r.loss(), r.plasticWork, r.specimenEnergy, r.frictionWork, r.contactWork, r.elasticEnergy,
			   r.numericalDissipation, r.greatestAngle, double(r.broken), double(r.outcome == CharpyOutcome::Bounced)},
			  way.name);
	}
	return t;
}

/// A sweep of one setting, beside the exact M (theta - M / k).
CharpyTable sweep(const CharpySettings& settings, const char* name, const char* title, double CharpySettings::*field,
				  const char* column, double unit, double from, double to, int steps)
{
	CharpyTable t;
	t.name = name;
	t.title = title;
	t.yTitle = "energy [J]";
	t.columns = {column,          "exact plastic work",           "plastic work", "loss",
				 "friction work", "kinetic energy of the pieces", "hinge_rad",    "broken",
				 "bounced"};
	t.series = {{1, true}, {2, false}, {3, false}, {4, false}, {5, false}};
	for (int i = 0; i <= steps; ++i)
	{
		CharpySettings s = settings;
		const double value = from + (to - from) * i / steps;
		s.*field = value * unit;
		const CharpyResult r = Charpy(s).run();
		t.add({value, btMin(s.plasticMoment() * s.maxRotation, s.passingPlasticWork()), r.plasticWork, r.loss(),
			   r.frictionWork, r.specimenEnergy, r.hingeAngle, double(r.broken),
			   double(r.outcome == CharpyOutcome::Bounced)});
	}
	return t;
}

CharpyTable yieldStress(const CharpySettings& s)
{
	return sweep(s, "yield", "Energy over yield stress", &CharpySettings::yieldStress, "yield_MPa", 1e6, 200, 800, 12);
}

CharpyTable notchDepth(const CharpySettings& s)
{
	return sweep(s, "notch", "Energy over the notch's depth", &CharpySettings::notch, "notch_mm", 1e-3, 1, 5, 16);
}

CharpyTable specimenWidth(const CharpySettings& s)
{
	return sweep(s, "width", "Energy over the specimen's thickness", &CharpySettings::width, "width_mm", 1e-3, 4, 20,
				 16);
}

/// Beside what it takes without inertia, up to where it holds the specimen.
CharpyTable friction(const CharpySettings& settings)
{
	CharpyTable t;
	t.name = "friction";
	t.title = "Energy over friction";
	t.yTitle = "energy [J]";
	t.columns = {"friction", "quasi-static friction work", "friction work", "plastic work", "loss", "hinge_rad",
				 "stuck"};
	t.series = {{1, true}, {2, false}, {3, false}, {4, false}};
	for (int i = 0; i <= 20; ++i)
	{
		CharpySettings s = settings;
		s.friction = 0.02 * i;
		const CharpyResult r = Charpy(s).run();
		t.add({s.friction, quasiStaticFriction(s), r.frictionWork, r.plasticWork, r.loss(), r.hingeAngle,
			   double(r.outcome == CharpyOutcome::Stuck)});
	}
	return t;
}

CharpyTable maxRotation(const CharpySettings& s)
{
	return sweep(s, "rotation", "Energy over the maximum rotation: brittle to ductile", &CharpySettings::maxRotation,
				 "max_rotation_rad", 1, 0.1, 2.5, 24);
}
}  // namespace

std::vector<double> lossesOverShifts(CharpySettings settings)
{
	std::vector<double> losses;
	for (int i = -20; i <= 20; ++i)
	{
		settings.shift = i * 1e-6;
		losses.push_back(Charpy(settings).run().loss());
	}
	return losses;
}

CharpySpread spreadOf(const std::vector<double>& losses)
{
	CharpySpread s = {0, 0, HUGE_VAL, -HUGE_VAL};
	for (double loss : losses)
	{
		s.mean += loss / double(losses.size());
		s.least = btMin(s.least, loss);
		s.most = btMax(s.most, loss);
	}
	for (double loss : losses)
		s.deviation += (loss - s.mean) * (loss - s.mean) / double(losses.size());
	s.deviation = std::sqrt(s.deviation);
	return s;
}

const std::vector<CharpyStudy>& charpyStudies()
{
	static const std::vector<CharpyStudy> studies = {
		{"table-xi", "the paper's Table XI beside both presets", tableXI},
		{"steps", "loss over the time step", steps},
		{"shifts", "loss over 41 shifts of the hammer by up to 20 um", shifts},
		{"ways", "the ways of modelling", ways},
		{"yield", "energy over yield stress", yieldStress},
		{"notch", "energy over the notch's depth", notchDepth},
		{"width", "energy over the specimen's thickness", specimenWidth},
		{"friction", "energy over friction", friction},
		{"rotation", "energy over the maximum rotation", maxRotation},
	};
	return studies;
}
}  // namespace ep
