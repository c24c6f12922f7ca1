// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "collect/Records.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace ep
{
namespace fs = std::filesystem;
using nlohmann::json;

namespace
{
double numberOf(const json& value) { return value.is_number() ? value.get<double>() : HUGE_VAL; }

const char* const COLUMNS[] = {"problem",    "quantity",     "dt_s",        "substeps", "solver", "iterations",
							   "scheme",     "joint_class",  "precision",   "value",    "exact",  "error",
							   "run_time_s", "energy_audit", "simulated_s", "steps",    "budget"};
}  // namespace

std::string Record::setting() const
{
	std::ostringstream out;
	out << "1/" << std::lround(1 / dt) << " s";
	if (substeps > 1)
		out << " in " << substeps << " substeps";
	out << ", ";
	if (scheme == "default")
		out << "our joints";
	else if (scheme == "profile")
		out << "profile for " << 100 * budget << " %";
	else
		out << scheme;
	out << ", " << solver;
	if (solver != "direct" && solver != "mlcp" && solver != "ode-step")
		out << " " << iterations << " iterations";
	out << ", " << precision;
	return out.str();
}

Merged mergeRecords(const std::string& folder)
{
	std::vector<fs::path> files;
	for (const auto& entry : fs::directory_iterator(folder))
		if (entry.path().extension() == ".json")
			files.push_back(entry.path());
	std::sort(files.begin(), files.end());
	Merged all;
	for (const fs::path& file : files)
	{
		std::ifstream stream(file);
		const json records = json::parse(stream, nullptr, false);
		if (!records.is_array())
			throw std::runtime_error("'" + file.string() +
									 "' is no list of records: delete it, and it is computed again");
		for (const json& record : records)
			(record.contains("trial") ? all.trials : all.records).push_back(record);
	}
	return all;
}

std::vector<Record> recordsOf(const json& list)
{
	std::vector<Record> records;
	for (const json& j : list)
	{
		Record r;
		r.problem = j.at("problem");
		r.quantity = j.at("quantity");
		r.solver = j.at("solver");
		r.scheme = j.at("scheme");
		r.jointClass = j.at("joint_class");
		r.precision = j.at("precision");
		r.dt = j.at("dt_s");
		r.budget = j.at("budget").is_number() ? j.at("budget").get<double>() : 0;
		r.steps = j.at("steps");
		r.substeps = j.at("substeps");
		r.iterations = j.at("iterations");
		r.value = numberOf(j.at("value"));
		r.exact = numberOf(j.at("exact"));
		r.error = numberOf(j.at("error"));
		r.runTime = j.at("run_time_s");
		r.simulated = j.at("simulated_s");
		r.energyAudit = numberOf(j.at("energy_audit"));
		records.push_back(r);
	}
	return records;
}

std::vector<TrialRecord> trialsOf(const json& list)
{
	std::vector<TrialRecord> trials;
	for (const json& j : list)
		trials.push_back(
			{j.at("group"), j.at("trial"), j.at("solver"), j.at("joint_class"), j.at("precision"), j.at("complaint")});
	return trials;
}

std::string csvOf(const json& list)
{
	std::ostringstream out;
	for (const char* column : COLUMNS)
		out << (column == COLUMNS[0] ? "" : ",") << column;
	out << "\n";
	for (const json& record : list)
	{
		for (const char* column : COLUMNS)
			out << (column == COLUMNS[0] ? "" : ",") << record.at(column).dump();
		out << "\n";
	}
	return out.str();
}
}  // namespace ep
