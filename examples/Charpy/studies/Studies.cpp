// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "studies/Studies.h"

#include <cmath>

#include "studies/Friction.h"

namespace ep::charpy
{
namespace
{
Result runWith(Settings settings, double step, double friction)
{
	settings.step = step;
	settings.friction = friction;
	return ImpactTest(settings).run();
}

Table tableXI(const Settings& settings)
{
	Table t;
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
		Settings paper = Settings::paper(), ours = settings;
		paper.step = ours.step = row.step;
		ours.friction = 0.1;
		const Spread its = spreadOf(lossesOverShifts(paper)), mine = spreadOf(lossesOverShifts(ours));
		t.add({row.step * 1e3, row.loss, ImpactTest(paper).run().loss(), its.least, its.most,
			   runWith(ours, row.step, 0).loss(), ImpactTest(ours).run().loss(), mine.least, mine.most,
			   ours.passingEnergy()});
	}
	return t;
}

Table steps(const Settings& settings)
{
	Table t;
	t.name = "steps";
	t.title = "Energy loss over the time step";
	t.yTitle = "loss [J]";
	t.logarithmic = true;
	t.columns = {
		"dt_ms", "no friction", "friction 0.1", "paper preset", "M theta + kinetic, no friction", "M theta, geometry"};
	t.series = {{1, true}, {2, true}, {3, true}, {5, true}};
	for (double step : {0.5e-3, 0.2e-3, 0.1e-3, 0.05e-3, 0.02e-3, 0.01e-3})
	{
		Settings paper = Settings::paper();
		paper.step = step;
		const Result free = runWith(settings, step, 0);
		t.add({step * 1e3, free.loss(), runWith(settings, step, 0.1).loss(), ImpactTest(paper).run().loss(),
			   free.plasticMoment * free.hingeAngle + free.specimenEnergy, settings.passingEnergy()});
	}
	return t;
}

Table shifts(const Settings& settings)
{
	Table t;
	t.name = "shifts";
	t.title = "Energy loss over the hammer's place";
	t.yTitle = "loss [J]";
	t.columns = {"shift_um", "no friction", "friction 0.1", "paper preset"};
	t.series = {{1, false}, {2, false}, {3, false}};
	Settings free = settings, rubbing = settings, paper = Settings::paper();
	free.friction = 0;
	rubbing.friction = 0.1;
	paper.step = settings.step;
	const std::vector<double> a = lossesOverShifts(free), b = lossesOverShifts(rubbing), c = lossesOverShifts(paper);
	for (size_t i = 0; i < a.size(); ++i)
		t.add({double(i) - 20, a[i], b[i], c[i]});
	return t;
}

Table ways(const Settings& settings)
{
	Table t;
	t.name = "ways";
	t.title = "The ways of modelling";
	t.labelColumn = "joint";
	t.columns = {"loss_J",    "plastic_J",   "kinetic_J",         "friction_J", "contacts_J",
				 "elastic_J", "numerical_J", "greatest_bend_rad", "broken",     "bounced"};
	for (const auto& way : joints())
	{
		Settings s = settings;
		s.way = way.value;
		const Result r = ImpactTest(s).run();
		t.add({r.loss(), r.plasticWork, r.specimenEnergy, r.frictionWork, r.contactWork, r.elasticEnergy,
			   r.numericalDissipation, r.greatestAngle, double(r.broken), double(r.outcome == Outcome::Bounced)},
			  way.name);
	}
	return t;
}

/// A sweep of one setting, beside the exact M (theta - M / k).
Table sweep(const Settings& settings, const char* name, const char* title, double Settings::*field, const char* column,
			double unit, double from, double to, int steps)
{
	Table t;
	t.name = name;
	t.title = title;
	t.yTitle = "energy [J]";
	t.columns = {column,          "exact plastic work",           "plastic work", "loss",
				 "friction work", "kinetic energy of the pieces", "hinge_rad",    "broken",
				 "bounced"};
	t.series = {{1, true}, {2, false}, {3, false}, {4, false}, {5, false}};
	for (int i = 0; i <= steps; ++i)
	{
		Settings s = settings;
		const double value = from + (to - from) * i / steps;
		s.*field = value * unit;
		const Result r = ImpactTest(s).run();
		t.add({value, btMin(s.plasticMoment() * s.maxRotation, s.passingPlasticWork()), r.plasticWork, r.loss(),
			   r.frictionWork, r.specimenEnergy, r.hingeAngle, double(r.broken),
			   double(r.outcome == Outcome::Bounced)});
	}
	return t;
}

Table yieldStress(const Settings& s)
{
	return sweep(s, "yield", "Energy over yield stress", &Settings::yieldStress, "yield_MPa", 1e6, 200, 800, 12);
}

Table notchDepth(const Settings& s)
{
	return sweep(s, "notch", "Energy over the notch's depth", &Settings::notch, "notch_mm", 1e-3, 1, 5, 16);
}

Table specimenWidth(const Settings& s)
{
	return sweep(s, "width", "Energy over the specimen's thickness", &Settings::width, "width_mm", 1e-3, 4, 20, 16);
}

/// Beside what it takes without inertia, up to where it holds the specimen.
Table friction(const Settings& settings)
{
	Table t;
	t.name = "friction";
	t.title = "Energy over friction";
	t.yTitle = "energy [J]";
	t.columns = {"friction", "quasi-static friction work", "friction work", "plastic work", "loss", "hinge_rad",
				 "stuck"};
	t.series = {{1, true}, {2, false}, {3, false}, {4, false}};
	for (int i = 0; i <= 20; ++i)
	{
		Settings s = settings;
		s.friction = 0.02 * i;
		const Result r = ImpactTest(s).run();
		t.add({s.friction, quasiStaticFriction(s), r.frictionWork, r.plasticWork, r.loss(), r.hingeAngle,
			   double(r.outcome == Outcome::Stuck)});
	}
	return t;
}

Table maxRotation(const Settings& s)
{
	return sweep(s, "rotation", "Energy over the maximum rotation: brittle to ductile", &Settings::maxRotation,
				 "max_rotation_rad", 1, 0.1, 2.5, 24);
}
}  // namespace

std::vector<double> lossesOverShifts(Settings settings, int most)
{
	std::vector<double> losses;
	for (int i = -most; i <= most; ++i)
	{
		settings.shift = i * 1e-6;
		losses.push_back(ImpactTest(settings).run().loss());
	}
	return losses;
}

Spread spreadOf(const std::vector<double>& losses)
{
	Spread s = {0, 0, HUGE_VAL, -HUGE_VAL};
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

const std::vector<Study>& studies()
{
	static const std::vector<Study> studies = {
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
}  // namespace ep::charpy
