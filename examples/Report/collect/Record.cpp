// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "collect/Record.h"

#include <sstream>

namespace ep
{
namespace
{
const double SHORTEST = 1e-12, LONGEST = 1e9;  // times [s]
const int MOST = 1000000000;
}  // namespace

std::string nameOf(const Family& family)
{
	const std::string scheme = nameOf(schemes(), family.scheme);
	const std::string solver = family.solver ? nameOf(reportSolvers(), *family.solver) : "";
	return family.scheme == Scheme::Default ? solver : solver.empty() ? scheme : scheme + " " + solver;
}

const std::vector<Column<Record>>& Record::columns()
{
	static const std::vector<Column<Record>> all = {fileName("problem", &Record::problem),
													column("quantity", &Record::quantity),
													column("dt_s", &Record::dt, SHORTEST, LONGEST),
													column("substeps", &Record::substeps, 1, MOST),
													column("solver", &Record::solver, reportSolvers()),
													column("iterations", &Record::iterations, 0, MOST),
													column("scheme", &Record::scheme, schemes()),
													column("joint_class", &Record::jointClass, jointClasses()),
													column("precision", &Record::precision, precisions()),
													column("value", &Record::value, HUGE_VAL),
													column("exact", &Record::exact, HUGE_VAL),
													column("error", &Record::error, HUGE_VAL),
													column("run_time_s", &Record::runTime, SHORTEST, LONGEST),
													column("run_time_spread", &Record::spread, HUGE_VAL),
													column("energy_audit", &Record::energyAudit, HUGE_VAL),
													column("simulated_s", &Record::simulated, SHORTEST, LONGEST),
													column("steps", &Record::steps, 1, MOST),
													column("budget", &Record::budget, 0)};
	return all;
}

const std::vector<Column<TrialRecord>>& TrialRecord::columns()
{
	static const std::vector<Column<TrialRecord>> all = {
		column("group", &TrialRecord::group),
		column("trial", &TrialRecord::trial),
		column("solver", &TrialRecord::solver, reportSolvers()),
		column("joint_class", &TrialRecord::jointClass, jointClasses()),
		column("precision", &TrialRecord::precision, precisions()),
		column("complaint", &TrialRecord::complaint),
		column("value", &TrialRecord::value, HUGE_VAL),
		column("exact", &TrialRecord::exact, HUGE_VAL),
		column("energy_created", &TrialRecord::energyCreated, HUGE_VAL),
		column("run_time_s", &TrialRecord::runTime, 0., LONGEST)};
	return all;
}

Family Record::family() const
{
	return scheme == Scheme::Default || isOutside() ? Family{scheme, solver} : Family{scheme};
}

std::string Record::setting() const
{
	std::ostringstream out;
	out << "1/" << std::lround(1 / dt) << " s";
	if (substeps > 1)
		out << " in " << substeps << " substeps";
	out << ", ";
	if (scheme == Scheme::Default)
		out << "our joints";
	else if (scheme == Scheme::Profile)
		out << "profile for " << 100 * budget << " %";
	else
		out << nameOf(schemes(), scheme);
	out << ", " << nameOf(reportSolvers(), solver);
	if (iterates(solver))
		out << " " << iterations << " iterations";
	out << ", " << nameOf(precisions(), precision);
	return out.str();
}
}  // namespace ep
