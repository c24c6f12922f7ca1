// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_RECORD_H
#define EP_REPORT_RECORD_H

#include <string>
#include <tuple>
#include <vector>

#include "collect/Choices.h"
#include "collect/Column.h"

namespace ep
{
/// What is looked at together: a scheme; of the default one, and of another engine's, each solver by itself.
struct Family
{
	Scheme scheme;
	std::optional<ReportSolver> solver = {};

	bool operator==(const Family& other) const { return scheme == other.scheme && solver == other.solver; }
	bool operator!=(const Family& other) const { return !(*this == other); }
};
std::string nameOf(const Family& family);

/// A line of the report: what a method made of a quantity.
struct Record
{
	std::string problem, quantity;
	ReportSolver solver;
	Scheme scheme;
	std::optional<JointClass> jointClass;
	Precision precision;
	double dt, value, exact, error, runTime, simulated, energyAudit;  ///< infinite or not a number where there is none
	double budget;                                                    ///< of the profile, else 0
	double spread;  ///< of run times: longest less shortest over the median; not a number of one
	int substeps, iterations, steps;

	static const std::vector<Column<Record>>& columns();

	/// Time it takes per simulated second.
	double cost() const { return runTime / simulated; }
	/// By another engine than Bullet? Such have no joint class.
	bool isOutside() const { return !jointClass; }
	Family family() const;
	/// All that makes a method but its step, to compare.
	auto method() const { return std::make_tuple(scheme, solver, jointClass, precision, iterations, budget); }
	double substep() const { return dt / substeps; }
	/// In words that a user can follow.
	std::string setting() const;
};

/// A cell of the stability matrix.
struct TrialRecord
{
	std::string group, trial;
	ReportSolver solver;
	std::optional<JointClass> jointClass;
	Precision precision;
	std::string complaint;
	double value, exact, energyCreated, runTime;  ///< infinite or not a number where there is none

	static const std::vector<Column<TrialRecord>>& columns();
};
}  // namespace ep

#endif  // EP_REPORT_RECORD_H
