// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "page/Tables.h"

#include <algorithm>

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

const Scheme FIBRES[] = {Scheme::WithoutInteraction, Scheme::Fibres4, Scheme::Fibres8, Scheme::Fibres16,
						 Scheme::Fibres60};

bool isStudyOfParts(Scheme scheme)
{
	return scheme == Scheme::Everything ||
		   std::find(std::begin(WITHOUT), std::end(WITHOUT), scheme) != std::end(WITHOUT) ||
		   std::find(std::begin(FIBRES), std::end(FIBRES), scheme) != std::end(FIBRES);
}

bool isGamesStep(const Record& r) { return std::lround(1 / r.dt) == 60; }

std::string quantityOf(const Record& r) { return "of " + r.quantity; }

Grid::Cell cellOf(const Record* r)
{
	return r ? Grid::Cell{std::isnan(r->error) ? "" : percent(r->error), r->error, quantityOf(*r)} : Grid::Cell{""};
}

/// The one record that stands for a family at 1/60 s; null if there is none.
const Record* findAtGamesStep(const Selection& records, const Family& family)
{
	for (const Record* r : records)
		if (r->family() == family && r->substeps == 1 && isGamesStep(*r) && r->iterations == 10 &&
			(r->isOutside() || (r->jointClass == JointClass::Spring2 && r->precision == Precision::Float)) &&
			(r->budget == 0 || r->budget == 0.01))
			return r;
	return nullptr;
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
		"In float; iterative solvers with 10 iterations; the profile, for 1 %, takes substeps, the solver by default "
		"inner steps, "
		"all others neither. Green keeps to 1 "
		"%, dark "
		"green to 0.1 %, yellow to 10 %. Of which quantity it is, the worst of the problem's, is under the mouse.";
	const std::vector<Named<Family>> compared = familiesOf(problems);
	for (const Named<Family>& family : compared)
		grid.columns.push_back(family.name);
	for (const std::string& name : problems.names)
	{
		grid.rows.push_back({name, {}});
		for (const Named<Family>& family : compared)
			grid.rows.back().cells.push_back(cellOf(findAtGamesStep(problems.records.at(name), family.value)));
	}
	return grid;
}

namespace
{
/// What else there is to know of a record of the profile. \param luckiest  may be null
std::string profileTip(const Record& mine, const Record* luckiest)
{
	std::string text = quantityOf(mine) + format("; %.1f substeps on average, %.3g ms a second",
												 mine.steps * mine.dt / mine.simulated, 1e3 * mine.cost());
	if (luckiest)
		text += format("; x %.2f the time of what happens to keep to it: %s in %d substeps",
					   mine.cost() / luckiest->cost(), nameOf(luckiest->family()).c_str(), luckiest->substeps);
	return text;
}

/// Its time over that of the best.
Grid::Cell timeCell(const Record* mine, const Record* best)
{
	if (!mine)
		return {""};
	if (!best)
		return {"none other", NAN, "none of those tried keeps to it"};
	return {format("x %.1f", mine->cost() / best->cost()), NAN,
			format("the best: %s, %s, %d substeps, %.3g ms a second", percent(best->error).c_str(),
				   nameOf(best->family()).c_str(), best->substeps, 1e3 * best->cost())};
}
}  // namespace

Grid profileOf(const ByProblem& problems)
{
	Grid grid;
	grid.title = "The profile: error, and time over that of the best setting";
	grid.what =
		"For an error of 10, 1 and 0.1 %, direct solver, double, 1/60 s; the best is the quickest of all of Bullet's "
		"and our "
		"settings that keeps to the error in its number of substeps and all higher ones. More under the mouse.";
	const double budgets[] = {0.1, 0.01, 0.001};
	for (const double budget : budgets)
	{
		grid.columns.push_back("for " + percent(budget));
		grid.columns.push_back("time");
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
				mine ? Grid::Cell{percent(mine->error), mine->error, profileTip(*mine, luckiest)} : Grid::Cell{""});
			grid.rows.back().cells.push_back(timeCell(mine, best));
		}
	}
	return grid;
}

namespace
{
/// A row of errors, with the time over that of the first under the mouse.
/// \param records  of one problem; null: there is none
/// \param times    gets the times over that of the first, by columns
Grid::Row rowOfParts(const std::string& name, const Selection& records, std::vector<std::vector<double>>& times)
{
	Grid::Row row = {name, {}};
	for (size_t i = 0; i < records.size(); ++i)
	{
		row.cells.push_back({""});
		if (!records[i])
			continue;
		times[i].push_back(records[i]->cost() / records[0]->cost());
		row.cells.back() = {percent(records[i]->error), records[i]->error, format("x %.2f the time", times[i].back())};
	}
	return row;
}

Grid::Row rowOfMedians(std::vector<std::vector<double>>& times)
{
	Grid::Row row = {"", {}};
	for (std::vector<double>& some : times)
		row.cells.push_back({some.empty() ? "" : format("x %.2f", median(some)), NAN});
	return row;
}
}  // namespace

Grid partsOf(const ByProblem& problems)
{
	Grid grid;
	grid.title = "What a scene can leave out";
	grid.what =
		"1/60 s in 8 substeps, direct solver, double; without substeps is one of 1/60 s. Errors, and in the last line "
		"the median of the times over that with everything; each problem's under the mouse. Energies and events cost "
		"0.3 % of a step's instructions (callgrind, 100 joints), so there is no switch for them.";
	grid.columns = {"everything"};
	for (const Scheme scheme : WITHOUT)
		grid.columns.push_back(nameOf(schemes(), scheme));
	grid.columns.push_back("without substeps");
	std::vector<std::vector<double>> times(grid.columns.size());
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
		others.insert(others.begin(), whole);
		grid.rows.push_back(rowOfParts(name, others, times));
	}
	if (grid.rows.empty())
		return grid;
	grid.rows.push_back(rowOfMedians(times));
	return grid;
}

Grid fibresOf(const ByProblem& problems)
{
	Grid grid;
	grid.title = "How many fibres a section needs";
	grid.what =
		"1/60 s in 8 substeps, direct solver, double. Errors, and in the last line the median of the times over those "
		"with independent bounds; each problem's under the mouse. A rectangle has 36 fibres at most, a circle 14 to "
		"33, "
		"an I-section 12 at least.";
	std::vector<std::vector<double>> times(std::size(FIBRES));
	for (const Scheme scheme : FIBRES)
		grid.columns.push_back(nameOf(schemes(), scheme));
	for (const std::string& name : problems.names)
	{
		Selection records;
		for (const Scheme scheme : FIBRES)
			records.push_back(findScheme(problems.records.at(name), scheme));
		if (records[0])
			grid.rows.push_back(rowOfParts(name, records, times));
	}
	if (!grid.rows.empty())
		grid.rows.push_back(rowOfMedians(times));
	return grid;
}
}  // namespace ep
