// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// ep-report-case: computes one case of the report and writes its records as JSON. The report starts it; the precision is
// that of the Bullet it is linked with.

#include <fstream>
#include <iostream>

#include "cli/CommandLine.h"
#include "collect/Case.h"
#include "compute/Computation.h"
#include "problems/Catalogue.h"

namespace
{
struct Options
{
	std::string problem, out;
	ep::ComputationSettings settings;
};
}  // namespace

int main(int argc, char** argv)
{
	Options o;
	ep::CommandLine line("One case of the report, as JSON");
	line.add("--problem", o.problem, "Name of the problem").required();
	line.add("--rate", o.settings.rate, "Steps per second").within(1, 1000000).showDefault();
	line.add("--substeps", o.settings.substeps, "Substeps of each step").within(1, 10000).showDefault();
	line.add("--repeats", o.settings.repeats, "Runs of which the median time counts").within(1, 1000).showDefault();
	line.addFlag("--quick", o.settings.quick, "Few methods");
	line.add("--out", o.out, "File to write").required();
	if (const std::optional<int> status = line.parse(argc, argv))
		return *status;
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
	file << (isStability ? toJson(ep::TrialRecord::columns(), ep::computeTrials())
						 : toJson(ep::Record::columns(), compute(*problem, o.settings)))
				.dump(1)
		 << "\n";
	file.close();
	if (!file)
	{
		std::cerr << "ep-report-case: cannot write '" << o.out << "'\n";
		return 1;
	}
	return 0;
}
