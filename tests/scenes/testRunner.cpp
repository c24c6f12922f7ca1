// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// ep-run from outside: what it writes, what it tells by its status, and how it computes many cases.

#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cases/CaseRunner.h"
#include "run/CaseTable.h"
#include "scenes/Scenes.h"

namespace testRunner
{
using namespace ep;

const char* const FALL =
	R"({"version": 1, "title": "fall", "parameters": {"g": 10}, "world": {"gravity": [0, "=-g", 0], "step": 0.01},
	"bodies": [{"name": "box", "box": [1, 1, 1]}], "end": {"time": 1},
	"probes": [{"name": "y", "of": "box", "measure": "position"}, {"name": "v", "of": "box", "measure": "velocity"}],
	"expect": [{"probe": "v", "least": -11, "most": -9}]})";

struct Ran
{
	int status;
	std::string text;
};

Ran epRun(const std::string& arguments)
{
	const std::string log = std::filesystem::temp_directory_path() / ("ep-run-" + std::to_string(getpid()) + ".log");
	const int status = std::system((shellWord(EP_RUN) + " " + arguments + " >" + log + " 2>&1").c_str());
	std::ifstream stream(log);
	const Ran ran = {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
					 std::string((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>())};
	std::filesystem::remove(log);
	return ran;
}

std::string textOf(const std::string& file)
{
	std::ifstream stream(file);
	return std::string((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
}

size_t linesOf(const std::string& file)
{
	const std::string text = textOf(file);
	return size_t(std::count(text.begin(), text.end(), '\n'));
}

TEST(EpRun, WritesTablesAndASummary)
{
	const TemporaryFolder folder;
	const std::string scene = folder.write("fall.json", FALL), out = folder.path() + "/out";
	const Ran ran = epRun(scene + " --out " + out);
	EXPECT_EQ(ran.status, 0) << ran.text;
	const nlohmann::json summary = nlohmann::json::parse(textOf(out + "/summary.json"));
	EXPECT_EQ(summary.at("ending"), "time");
	EXPECT_NEAR(summary.at("probes").at("v").at("last").get<double>(), -10, 1e-4);
	EXPECT_TRUE(summary.at("not_as_expected").empty());
	// A head, the beginning, and 100 steps.
	EXPECT_EQ(linesOf(out + "/probes.csv"), 102u);
	EXPECT_EQ(linesOf(out + "/energy.csv"), 102u);
	EXPECT_EQ(textOf(out + "/probes.csv").substr(0, 11), "time_s,y,v\n");
	EXPECT_EQ(linesOf(out + "/events.csv"), 1u);
}

TEST(EpRun, WritesWhatProbedSectionsBear)
{
	// 0.2 x 0.1 m, 100 MPa: N_p = 2 MN; 36 fibres about z in pure bending W_pl f_y = 1e-3 x 100e6 = 100 kN m, about y the half.
	const TemporaryFolder folder;
	const std::string out = folder.path() + "/out",
					  scene = folder.write("rod.json", R"({"version": 1, "world": {"gravity": [0, 0, 0], "step": 0.01},
		"bodies": [{"name": "box", "box": [1, 1, 1]}],
		"joints": [{"name": "rod", "from": "world", "to": "box", "at": [0, 0, 0], "along": [1, 0, 0], "up": [0, 1, 0], "lengths": [1, 1],
			"material": {"yield_stress": 100e6}, "section": {"rectangle": [0.1, 0.2], "fibres": 36}}, {"name": "other", "from": "world", "to": "box",
			"at": [0, 0, 0], "along": [1, 0, 0], "lengths": [1, 1], "material": {}, "section": {"rectangle": [0.1, 0.2], "fibres": 36}}],
		"probes": [{"name": "N", "of": "rod", "measure": "force", "dof": "axial"}], "end": {"time": 0.1}})");
	const Ran ran = epRun(scene + " --out " + out);
	ASSERT_EQ(ran.status, 0) << ran.text;
	std::ifstream file(out + "/strength.csv");
	std::string line;
	ASSERT_TRUE(std::getline(file, line));
	EXPECT_EQ(line, "joint,moment,when,axial_N,moment_Nm");
	size_t count = 0;
	double most = 0, moment[2] = {};
	while (std::getline(file, line))
	{
		std::istringstream stream(line);
		std::string cells[5];
		for (std::string& cell : cells)
			std::getline(stream, cell, ',');
		EXPECT_EQ(cells[0], "rod");
		++count;
		most = std::max(most, std::fabs(std::stod(cells[3])));
		double& own = moment[cells[1] == "bending_z"];
		own = std::max(own, std::fabs(std::stod(cells[4])));
	}
	// Two moments, at the start and at the end, each with the corners of a line that closes.
	EXPECT_EQ(count, size_t(4 * (2 * 36 + 1)));
	EXPECT_NEAR(most, 2e6, 2e6 * 1e-5);
	EXPECT_NEAR(moment[1], 100e3, 100e3 * 1e-3);
	EXPECT_NEAR(moment[0], 50e3, 50e3 * 1e-3);
	file.close();
	// A scene without fibres leaves none of another one's in its folder.
	EXPECT_EQ(epRun(folder.write("fall.json", FALL) + " --out " + out).status, 0);
	EXPECT_FALSE(std::ifstream(out + "/strength.csv").is_open());
}

TEST(EpRun, TellsByItsStatus)
{
	const TemporaryFolder folder;
	const std::string scene = folder.write("fall.json", FALL), out = " --out " + folder.path() + "/out";
	const Ran unmet = epRun(scene + out + " --set g=20");
	EXPECT_EQ(unmet.status, 3);
	expectParts(unmet.text, {"not as expected: v is -20; it is to be from -11 to -9"});
	const Ran wrong = epRun(scene + out + " --set h=20");
	EXPECT_EQ(wrong.status, 1);
	expectParts(wrong.text, {"--set h=20", "key \"h\" is not known"});
	EXPECT_EQ(epRun(scene + " --check").status, 0);
	EXPECT_EQ(epRun(scene + " --check --set g=ten").status, 1);
	EXPECT_EQ(epRun("").status, 1);
	expectParts(epRun(scene + " --print --set g=3").text, {"\"g\": 3"});
	expectParts(epRun(scene + " --out /dev/null/x").text, {"cannot make the directory", "--out"});
	expectParts(epRun("--schema").text, {"json-schema.org"});
}

TEST(EpRun, ComputesCasesInShardsAndGoesOn)
{
	const TemporaryFolder folder;
	const std::string scene = folder.write("fall.json", FALL), out = folder.path() + "/out",
					  command = scene + " --out " + out + " --sweep g=5:10:2 --sweep bodies.box.mass=1:3:3";
	EXPECT_EQ(epRun(command + " --shard 1/2").status, 0);
	EXPECT_EQ(linesOf(out + "/cases.csv"), 1u + 3);
	const Ran rest = epRun(command + " --jobs 2");
	EXPECT_EQ(rest.status, 0);
	expectParts(rest.text, {"6 cases, 3 of them computed before"});
	const std::string table = textOf(out + "/cases.csv");
	expectParts(table, {"case,g,bodies.box.mass,ending,", "v last", "\n1,5,1,time,", "\n6,10,3,time,"});
	EXPECT_EQ(linesOf(out + "/cases.csv"), 1u + 6);
	const Ran other = epRun(scene + " --out " + out + " --sweep g=5:10:3");
	EXPECT_EQ(other.status, 1);
	expectParts(other.text, {"another scene or other cases"});
	expectParts(epRun(scene + " --shard 1/2").text, {"--shard is for the cases"});
	expectParts(epRun(command + " --shard 3/2").text, {"--shard is '3/2'", "1 <= i <= n"});
}

TEST(EpRun, TellsOfCasesThatFailAndTriesThemAgain)
{
	const TemporaryFolder folder;
	const std::string scene = folder.write("fall.json", FALL), out = folder.path() + "/out",
					  command = scene + " --out " + out + " --sweep bodies.box.mass=-1:1:2";
	const Ran ran = epRun(command);
	EXPECT_EQ(ran.status, 1);
	expectParts(ran.text, {"FAILED", "1 cases failed: see the .failed files"});
	expectParts(textOf(out + "/cases/case-000001.failed"), {"bodies.box.mass=-1", "ended with status"});
	EXPECT_EQ(linesOf(out + "/cases.csv"), 1u + 1);
	expectParts(epRun(command).text, {"2 cases, 1 of them computed before"});
}

// ---- cases, by themselves

TEST(Variation, CombinesSweepsAndDrawsTheSameAgain)
{
	const Variation sweeps = Variation::make({"a=1:3:3", "b=0:1:2"}, 0, {}, 1);
	ASSERT_EQ(sweeps.cases.size(), 6u);
	EXPECT_EQ(sweeps.cases[3], (std::vector<std::string>{"2", "1"}));
	const std::vector<std::string> vary = {"c=normal(5,2)", "d=uniform(1,2)", "e=lognormal(10,0.1)"};
	const Variation drawn = Variation::make({}, 2000, vary, 7);
	EXPECT_EQ(drawn.text(), Variation::make({}, 2000, vary, 7).text());
	EXPECT_NE(drawn.text(), Variation::make({}, 2000, vary, 8).text());
	double mean[3] = {}, square = 0;
	for (const auto& values : drawn.cases)
	{
		for (int i = 0; i < 3; ++i)
			mean[i] += std::stod(values[i]) / 2000;
		square += std::pow(std::stod(values[0]) - 5, 2) / 2000;
		EXPECT_GE(std::stod(values[1]), 1);
		EXPECT_LE(std::stod(values[1]), 2);
	}
	// Four standard errors: 4 * 2 / sqrt(2000), 4 * 0.29 / sqrt(2000), 4 * 1 / sqrt(2000).
	EXPECT_NEAR(mean[0], 5, .18);
	EXPECT_NEAR(mean[1], 1.5, .026);
	EXPECT_NEAR(mean[2], 10 * std::exp(.005), .09);
	EXPECT_NEAR(square, 4, 4 * 4 * std::sqrt(2. / 2000));
}

TEST(Variation, RefusesWhatItCannotRead)
{
	const auto refusal = [](const std::vector<std::string>& sweeps, int random, const std::vector<std::string>& vary)
	{
		try
		{
			Variation::make(sweeps, random, vary, 1);
		}
		catch (const std::exception& error)
		{
			return std::string(error.what());
		}
		return std::string();
	};
	expectParts(refusal({"a=1:2"}, 0, {}), {"--sweep is 'a=1:2'", "path=from:to:count"});
	expectParts(refusal({"a=1:2:0"}, 0, {}), {"count from 1"});
	expectParts(refusal({"1:2:3"}, 0, {}), {"--sweep is"});
	expectParts(refusal({"a=1:2:10000", "b=1:2:10000"}, 0, {}), {"more than 1000000 cases"});
	expectParts(refusal({}, 5, {}), {"belong together"});
	expectParts(refusal({}, 0, {"a=normal(1,2)"}), {"belong together"});
	for (const char* law :
		 {"a=normal(1,-2)", "a=gauss(1,2)", "a=normal(1)", "a=normal(1,2", "a=lognormal(-1,2)", "a=uniform(2,1)"})
		expectParts(refusal({}, 5, {law}), {"--vary is '", "path=normal(mean,deviation)"});
}

TEST(Shards, ShareAllCasesOut)
{
	std::vector<int> count(10);
	for (const char* shard : {"1/3", "2/3", "3/3"})
		for (size_t i : shardOf(10, shard))
			++count[i];
	EXPECT_EQ(count, std::vector<int>(10, 1));
	EXPECT_EQ(shardOf(10, "").size(), 10u);
	for (const char* shard : {"0/3", "4/3", "1/0", "a", "1/3x", "1"})
		EXPECT_THROW(shardOf(10, shard), std::runtime_error) << shard;
}
}  // namespace testRunner
