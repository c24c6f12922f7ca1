// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// ep-report-case: computes one case of the report and writes its records as JSON. The report starts it; the precision is
// that of the Bullet it is linked with.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "collect/Case.h"
#include "compute/Methods.h"
#ifdef EP_WITH_ODE
#include "compute/OdeEngine.h"
#endif
#include "problems/Problem.h"
#include "problems/Stability.h"

namespace
{
using nlohmann::json;

struct Options
{
	std::string problem, out;
	ep::Stepping stepping;
	int rate = 60, repeats = 3;
	bool quick = false;
};

#ifdef BT_USE_DOUBLE_PRECISION
const char* const PRECISION = "double";
#else
const char* const PRECISION = "float";
#endif

json numberOrNull(double value) { return std::isfinite(value) ? json(value) : json(); }

json recordsOf(const Options& o, const ep::Problem& problem)
{
	std::vector<ep::Setting> settings = ep::settingsToCompare(o.rate, o.stepping.substeps, o.quick);
#ifdef EP_WITH_ODE
	for (const ep::Setting& setting : ep::odeSettings(problem.name, o.rate, o.stepping.substeps, o.quick))
		settings.push_back(setting);
#endif
	std::vector<ep::Outcome> outcomes(settings.size());
	std::vector<std::vector<double>> times(settings.size());
	for (int round = 0; round < o.repeats; ++round)
		for (size_t i = 0; i < settings.size(); ++i)
		{
			// What takes long needs no median.
			if (round > 0 && times[i][0] > 0.3)
				continue;
			ep::Stepping stepping = o.stepping;
			stepping.error = settings[i].budget;
			outcomes[i] = problem.solve(settings[i].method, stepping);
			times[i].push_back(outcomes[i].runTime);
		}
	json records = json::array();
	for (size_t i = 0; i < settings.size(); ++i)
	{
		std::sort(times[i].begin(), times[i].end());
		const ep::Method& method = settings[i].method;
		const bool isOurs = settings[i].engine.empty();
		for (const ep::Quantity& quantity : outcomes[i].quantities)
			records.push_back({{"problem", problem.name},
							   {"quantity", quantity.name},
							   {"dt_s", o.stepping.step},
							   {"substeps", o.stepping.substeps},
							   {"solver", isOurs ? ep::nameOf(method.solver) : settings[i].engine},
							   {"iterations", method.iterations},
							   {"scheme", settings[i].scheme},
							   {"joint_class", isOurs ? ep::nameOf(method.jointClass) : "-"},
							   {"precision", PRECISION},
							   {"value", numberOrNull(quantity.value)},
							   {"exact", quantity.exact},
							   {"error", numberOrNull(quantity.error())},
							   {"run_time_s", times[i][times[i].size() / 2]},
							   {"energy_audit", numberOrNull(outcomes[i].energyCreated)},
							   {"simulated_s", outcomes[i].simulated},
							   {"steps", outcomes[i].substeps},
							   {"budget", settings[i].budget > 0 ? json(settings[i].budget) : json()}});
	}
	return records;
}
json stabilityOf()
{
	json records = json::array();
	for (const ep::Trial& trial : ep::stabilityTrials())
		for (const ep::Solver solver : {ep::Solver::Direct, ep::Solver::Iterative, ep::Solver::Stock})
			for (const ep::JointClass jointClass : {ep::JointClass::Spring2, ep::JointClass::Spring})
			{
				ep::Method method(solver);
				method.jointClass = jointClass;
				const ep::Verdict verdict = trial.run(method);
				records.push_back({{"group", trial.group},
								   {"trial", trial.name},
								   {"solver", ep::nameOf(solver)},
								   {"joint_class", ep::nameOf(jointClass)},
								   {"precision", PRECISION},
								   {"complaint", verdict.complaint()},
								   {"value", numberOrNull(verdict.value)},
								   {"exact", numberOrNull(verdict.exact)},
								   {"energy_created", numberOrNull(std::max(verdict.created, verdict.createdByJoints))},
								   {"run_time_s", verdict.runTime}});
			}
	return records;
}
}  // namespace

int main(int argc, char** argv)
{
	Options o;
	CLI::App app("One case of the report, as JSON");
	app.add_option("--problem", o.problem, "Name of the problem")->required();
	app.add_option("--rate", o.rate, "Steps per second")->check(CLI::Range(1, 1000000))->capture_default_str();
	app.add_option("--substeps", o.stepping.substeps, "Substeps of each step")
		->check(CLI::Range(1, 10000))
		->capture_default_str();
	app.add_option("--repeats", o.repeats, "Runs of which the median time counts")
		->check(CLI::Range(1, 1000))
		->capture_default_str();
	app.add_flag("--quick", o.quick, "Few methods");
	app.add_option("--out", o.out, "File to write")->required();
	CLI11_PARSE(app, argc, argv);
	o.stepping.step = 1. / o.rate;
	const bool isStability = o.problem == ep::Case::STABILITY;
	const ep::Problem* const problem = ep::findProblem(o.problem);
	if (!problem && !isStability)
	{
		std::cerr << "ep-report-case: there is no problem '" << o.problem << "'; there are:";
		for (const ep::Problem& p : ep::problems())
			std::cerr << " " << p.name;
		std::cerr << "\n";
		return 1;
	}
	std::ofstream file(o.out);
	file << (isStability ? stabilityOf() : recordsOf(o, *problem)).dump(1) << "\n";
	file.close();
	if (!file)
	{
		std::cerr << "ep-report-case: cannot write '" << o.out << "'\n";
		return 1;
	}
	return 0;
}
