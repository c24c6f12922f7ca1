// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "page/Tables.h"

#include <algorithm>
#include <cstdio>

#include "judge/Families.h"
#include "judge/Judgement.h"
#include "text/Format.h"

namespace ep
{
namespace
{
const Scheme WITHOUT[] = {Scheme::WithoutElasticity,
						  Scheme::WithoutShear,
						  Scheme::WithoutTorsion,
						  Scheme::WithoutContactCoupling,
						  Scheme::WithoutContinuousCollision,
						  Scheme::WithoutDirectSolve};

bool isStudyOfParts(Scheme scheme)
{
	return scheme == Scheme::Everything ||
		   std::find(std::begin(WITHOUT), std::end(WITHOUT), scheme) != std::end(WITHOUT);
}

bool isGamesStep(const Record& r) { return std::lround(1 / r.dt) == 60; }

Grid::Cell cellOf(double error) { return {std::isnan(error) ? "" : percent(error), error}; }

/// The error of the one record that stands for a family at 1/60 s; not a number if there is none.
double errorAtGamesStep(const Selection& records, const Family& family)
{
	for (const Record* r : records)
		if (r->family() == family && r->substeps == 1 && isGamesStep(*r) && r->iterations == 10 &&
			(r->isOutside() || (r->jointClass == JointClass::Spring2 && r->precision == Precision::Float)) &&
			(r->budget == 0 || r->budget == 0.01))
			return r->error;
	return NAN;
}

/// In double.
const Record* findScheme(const Selection& records, Scheme scheme, double budget = 0)
{
	for (const Record* r : records)
		if (r->scheme == scheme && r->precision == Precision::Double && r->budget == budget)
			return r;
	return nullptr;
}
}  // namespace

Grid overviewOf(const ByProblem& problems)
{
	Grid grid;
	grid.title = "Relative error at 1/60 s";
	grid.what =
		"In float; iterative solvers with 10 iterations; only the profile, for 1 %, takes substeps. Green keeps to 1 "
		"%, dark "
		"green to 0.1 %, yellow to 10 %.";
	const std::vector<Named<Family>> compared = familiesOf(problems);
	for (const Named<Family>& family : compared)
		grid.columns.push_back(family.name);
	for (const std::string& name : problems.names)
	{
		grid.rows.push_back({name, {}});
		for (const Named<Family>& family : compared)
			grid.rows.back().cells.push_back(cellOf(errorAtGamesStep(problems.records.at(name), family.value)));
	}
	return grid;
}

namespace
{
/// Error, substeps, and the time over that of others, which may be null.
std::string profileText(const Record& mine, const Record* best, const Record* luckiest)
{
	std::string text = format("%s, %.1f", percent(mine.error).c_str(), mine.steps * mine.dt / mine.simulated);
	if (best)
		text += format(", x %.1f", mine.cost() / best->cost());
	if (luckiest && luckiest != best)
		text += format(" (%.1f)", mine.cost() / luckiest->cost());
	return text;
}
}  // namespace

Grid profileOf(const ByProblem& problems)
{
	Grid grid;
	grid.title = "The profile: error, mean substeps, time over that of the best setting";
	grid.what =
		"For an error of 10, 1 and 0.1 %, direct solver, double, 1/60 s; the best is the quickest of all of Bullet's "
		"and our "
		"settings that keeps to the error in its number of substeps and all higher ones; in brackets over the quickest "
		"that "
		"happens to keep to it.";
	const double budgets[] = {0.1, 0.01, 0.001};
	for (const double budget : budgets)
	{
		grid.columns.push_back("for " + percent(budget));
		grid.columns.push_back("the best within " + percent(budget));
	}
	for (const std::string& name : problems.names)
	{
		const Selection& records = problems.records.at(name);
		Selection rivals;
		for (const Record* r : records)
			if (isGamesStep(*r) && !r->isOutside() && r->budget == 0 && !isStudyOfParts(r->scheme) &&
				r->precision == Precision::Double)
				rivals.push_back(r);
		grid.rows.push_back({name, {}});
		for (const double budget : budgets)
		{
			const Record* const mine = findScheme(records, Scheme::Profile, budget);
			const Record* const best = quickestReliable(rivals, budget);
			const Record* const luckiest = quickestWithin(rivals, budget);
			grid.rows.back().cells.push_back(
				{mine ? profileText(*mine, best, luckiest) : "", mine ? mine->error : NAN});
			char text[96] = "none";
			if (best)
				snprintf(text, sizeof text, "%s, %s, %d substeps", percent(best->error).c_str(),
						 nameOf(best->family()).c_str(), best->substeps);
			grid.rows.back().cells.push_back({text});
		}
	}
	return grid;
}

Grid partsOf(const ByProblem& problems)
{
	Grid grid;
	grid.title = "What a scene can leave out: error, and time over that with everything";
	grid.what =
		"1/60 s in 8 substeps, direct solver, double; without substeps is one of 1/60 s. Energies and events cost 0.3 "
		"% of a "
		"step's instructions (callgrind, 100 joints), so there is no switch for them.";
	grid.columns = {"everything"};
	for (const Scheme scheme : WITHOUT)
		grid.columns.push_back(nameOf(schemes(), scheme));
	grid.columns.push_back("without substeps");
	for (const std::string& name : problems.names)
	{
		const Selection& records = problems.records.at(name);
		const Record* const whole = findScheme(records, Scheme::Everything);
		if (!whole)
			continue;
		Selection others;
		for (const Scheme scheme : WITHOUT)
			others.push_back(findScheme(records, scheme));
		const Record* coarse = nullptr;
		for (const Record* r : records)
			if (isGamesStep(*r) && r->substeps == 1 && r->scheme == Scheme::Default &&
				r->solver == ReportSolver::Direct && r->precision == Precision::Double &&
				r->jointClass == JointClass::Spring2)
				coarse = r;
		others.push_back(coarse);
		grid.rows.push_back({name, {cellOf(whole->error)}});
		for (const Record* r : others)
		{
			char text[64] = "";
			if (r)
				snprintf(text, sizeof text, "%s, x %.2f", percent(r->error).c_str(), r->cost() / whole->cost());
			grid.rows.back().cells.push_back({text, r ? r->error : NAN});
		}
	}
	return grid;
}
}  // namespace ep
