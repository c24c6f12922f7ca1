// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <random>
#include <thread>

#include "cases/CaseRunner.h"
#include "cli/CommandLine.h"
#include "page/Page.h"
#include "page/Pictures.h"
#include "LinearMath/btScalar.h"
#include "problems/Catalogue.h"
#include "collect/Case.h"
#include "collect/Records.h"
#include "judge/Judgement.h"
#include "page/ProblemView.h"
#include "page/Tables.h"
#include "text/OutputFiles.h"

namespace
{
namespace fs = std::filesystem;

const char* const SETTINGS = "settings.txt";

struct Options
{
	std::string out = "report", shard;
	std::vector<std::string> problems;
	int jobs = 1, repeats = 0;
	bool quick = false, few = false, list = false;
};

std::vector<std::string> allProblems()
{
	std::vector<std::string> names;
	for (const ep::Problem& problem : ep::problems())
		names.push_back(problem.name);
	names.push_back(ep::Case::STABILITY);
	return names;
}

/// The programs beside this one, by precision.
std::map<ep::Precision, std::string> programsBeside(const char* self)
{
	const fs::path folder = ep::programFolder(self);
	std::map<ep::Precision, std::string> programs;
	for (const auto& [precision, name] : {std::pair(ep::Precision::Float, "ep-report-case"),
										  std::pair(ep::Precision::Double, "ep-report-case-float64")})
		if (fs::exists(folder / name))
			programs[precision] = (folder / name).string();
	if (programs.empty())
		throw std::runtime_error("there is no ep-report-case beside this program in " + folder.string() + ": build it");
	return programs;
}

/// What computes a case. \param options  for all cases
ep::CaseJob jobOf(const ep::Case& c, const std::string& program, const std::string& options)
{
	const std::string command = ep::shellWord(program) + " --problem " + ep::shellWord(c.problem) + " --rate " +
								std::to_string(c.rate) + " --substeps " + std::to_string(c.substeps) + options +
								" --out ";
	return {c.name(), c.name() + ".json", [command](const std::string& part) { return command + ep::shellWord(part); }};
}

std::string processor()
{
	std::ifstream file("/proc/cpuinfo");
	for (std::string line; std::getline(file, line);)
		if (line.rfind("model name", 0) == 0)
			return line.substr(line.find(':') + 2);
	return "unknown";
}

std::string today()
{
	const std::time_t now = std::time(nullptr);
	char text[32];
	std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", std::localtime(&now));
	return text;
}

/// On a quiet machine run times of one case are within some per cent.
std::string warningOf(double spread)
{
	const double most = 0.1;
	return spread > most ? "The machine was loaded: run times of one and the same case are " + ep::percent(spread) +
							   " apart. Errors are right, times are not to be trusted."
						 : "";
}

/// Refuses to write over what no report has written: a folder that one has begun has its settings, and lists that are of records.
void checkFolder(const fs::path& out)
{
	for (const char* name : {"report.json", "stability.json", "report.csv", "report.html", "pictures"})
		if (fs::exists(out / name) && !fs::exists(out / SETTINGS))
			throw std::runtime_error("'" + (out / name).string() +
									 "' would be overwritten, and no report has written it: there is no " + SETTINGS +
									 " beside it. Move it away, or give another folder (--out)");
	for (const char* name : {"report.json", "stability.json"})
		if (fs::exists(out / name))
			ep::readRecords((out / name).string());
}

/// Cases of few and of all settings have the same names: a folder is for one or the other.
void checkSettings(const fs::path& out, bool few)
{
	const fs::path file = out / SETTINGS;
	const std::string mine = few ? "few" : "all";
	std::string begun = mine;
	std::ifstream(file) >> begun;
	if (begun != mine)
		throw std::runtime_error("the report in '" + out.string() + "' was begun with " + begun +
								 " settings, now it is to have " + mine + ": give another folder (--out)");
	fs::create_directories(out);
	ep::writeText(file.string(), mine + "\n");
}

/// Written aside: another shard that looks at the file finds it whole.
void replace(const fs::path& file, const std::string& text)
{
	const std::string part = file.string() + "." + std::to_string(std::random_device()()) + ".part";
	ep::writeText(part, text);
	fs::rename(part, file);
}

void run(const Options& o, const char* self)
{
	const std::map<ep::Precision, std::string> programs = programsBeside(self);
	const std::string folder = (fs::path(o.out) / "cases").string();
	const bool isQuick = o.quick || o.few;
	const int repeats = o.repeats > 0 ? o.repeats : o.quick ? 1 : 3;
	std::vector<ep::Precision> precisions;
	for (const auto& program : programs)
		precisions.push_back(program.first);
	const std::vector<ep::Case> cases =
		ep::casesOf(o.problems.empty() ? allProblems() : o.problems, precisions, o.quick);
	std::vector<ep::CaseJob> jobs;
	for (size_t i : ep::shardOf(cases.size(), o.shard))
		jobs.push_back(jobOf(cases[i], programs.at(cases[i].precision),
							 " --repeats " + std::to_string(repeats) + (isQuick ? " --quick" : "")));
	checkFolder(o.out);
	checkSettings(o.out, isQuick);
	const int failed = ep::runCases(jobs, folder, o.jobs);

	const ep::Records records = ep::readAllRecords(folder);
	const fs::path out(o.out);
	replace(out / "report.json", toJson(ep::Record::columns(), records.ofProblems).dump(1) + "\n");
	replace(out / "stability.json", toJson(ep::TrialRecord::columns(), records.ofTrials).dump(1) + "\n");
	ep::writeText((out / "report.csv").string(), toCsv(ep::Record::columns(), records.ofProblems));
	const double spread = ep::spreadOfTimes(records.ofProblems);
	const std::vector<std::pair<std::string, std::string>> stamp = {
		{"Processor", processor() + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads"},
		{"Compiler", __VERSION__},
		{"Bullet", std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100)},
#ifdef EP_ODE_VERSION
		{"ODE", EP_ODE_VERSION},
#endif
		{"Date", today()},
		{"Records", std::to_string(records.ofProblems.size())},
		{"Run times", std::isfinite(spread) ? "medians; those of one case are " + ep::percent(spread) +
												  " apart (longest less shortest, median of all cases)"
											: "each case timed once"},
	};
	const ep::ByProblem problems(records.ofProblems);
	fs::create_directories(out / "pictures");
	ep::Page page = {stamp, warningOf(spread), {}};
	for (const std::string& name : problems.names)
		page.views[name] = ep::viewOfProblem(name, (out / "pictures" / (name + ".png")).string());
	ep::writeText((out / "report.html").string(), ep::htmlOf(problems, records.ofTrials, page));
	if (!page.warning.empty())
		std::cout << page.warning << "\n";
	const std::pair<const char*, ep::Grid> tables[] = {{"overview", ep::overviewOf(problems)},
													   {"profile", ep::profileOf(problems)},
													   {"parts", ep::partsOf(problems)},
													   {"fibres", ep::fibresOf(problems)}};
	for (const auto& [name, grid] : tables)
		ep::writeText((out / "pictures" / (std::string(name) + ".svg")).string(), grid.svg());
	for (const std::string& name : problems.names)
		ep::writeText((out / "pictures" / (name + ".svg")).string(),
					  ep::problemPicture(name, ep::comparedOf(problems.records.at(name))));
	std::cout << "Report in " << (out / "report.html").string() << "\n";
	if (failed > 0)
		throw std::runtime_error(std::to_string(failed) + " cases failed: see the .failed files in " + folder);
}
}  // namespace

int main(int argc, char** argv)
{
	Options o;
	ep::CommandLine line("Error against run time: every reference problem by every method");
	line.add("--out", o.out, "Folder for the report; a report begun there goes on").showDefault();
	line.addFlag("--quick", o.quick, "Few steps and methods: some minutes");
	line.addFlag("--few", o.few, "All steps, but few methods: a quarter of the time");
	line.add("--problem", o.problems, "Only this problem; may be given several times").oneOf(allProblems());
	line.add("--jobs", o.jobs, "Cases computed at the same time; 1 for times that can be trusted")
		.within(1, 1024)
		.showDefault();
	line.add("--shard", o.shard, "i/n: only every n-th case from the i-th; the same folder collects all shards");
	line.add("--repeats", o.repeats, "Runs of which the median time counts; default: 3, with --quick 1")
		.within(1, 1000);
	line.addFlag("--list", o.list, "Tells the problems");
	if (const std::optional<int> status = line.parse(argc, argv))
		return *status;
	if (o.list)
	{
		for (const ep::Problem& problem : ep::problems())
			std::cout << problem.name << ": " << problem.what << " (exact by " << problem.source << ")\n";
		std::cout << ep::Case::STABILITY << ": what is stiff, extreme or unusual, green or what went wrong\n";
		return 0;
	}
	try
	{
		run(o, argv[0]);
	}
	catch (const std::exception& error)
	{
		std::cerr << "ep-report: " << error.what() << "\n";
		return 1;
	}
	return 0;
}
