// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_RECORDS_H
#define EP_REPORT_RECORDS_H

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ep
{
/// A line of the report: what a method made of a quantity.
struct Record
{
	std::string problem, quantity, solver, scheme, jointClass, precision;
	double dt, value, exact, error, runTime, simulated, energyAudit;  ///< infinite or not a number where there is none
	double budget;                                                    ///< of the profile, else 0
	int substeps, iterations, steps;

	/// Time it takes per simulated second.
	double cost() const { return runTime / simulated; }
	/// By another engine than Bullet? Such have no joint class.
	bool isOutside() const { return jointClass == "-"; }
	/// Default scheme: the solver; else the scheme, of another engine with the solver.
	std::string family() const { return scheme == "default" ? solver : isOutside() ? scheme + " " + solver : scheme; }
	/// In words that a user can follow.
	std::string setting() const;
};

/// A cell of the stability matrix.
struct TrialRecord
{
	std::string group, trial, solver, jointClass, precision, complaint;
};

/// What the files of a folder hold.
struct Merged
{
	nlohmann::json records = nlohmann::json::array(), trials = nlohmann::json::array();
};

/// In the order of the files' names. Throws std::runtime_error naming a file that cannot be read.
Merged mergeRecords(const std::string& folder);

std::vector<Record> recordsOf(const nlohmann::json& json);
std::vector<TrialRecord> trialsOf(const nlohmann::json& json);

std::string csvOf(const nlohmann::json& json);
}  // namespace ep

#endif  // EP_REPORT_RECORDS_H
