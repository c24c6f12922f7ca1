// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The report as a user runs it: as a program, into a folder.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace testReport
{
namespace fs = std::filesystem;
using nlohmann::json;

struct Ended
{
	int status;
	std::string output;
};

class Report : public testing::Test
{
protected:
	void SetUp() override
	{
		m_folder = fs::temp_directory_path() / ("ep-report-test-" + std::to_string(::getpid()));
		fs::remove_all(m_folder);
	}
	void TearDown() override { fs::remove_all(m_folder); }

	Ended run(const std::string& arguments, const std::string& program = EP_REPORT) const
	{
		fs::create_directories(m_folder);
		const fs::path log = m_folder / "log";
		const int status = std::system((program + " " + arguments + " > " + log.string() + " 2>&1").c_str());
		return {WEXITSTATUS(status), read(log)};
	}
	Ended report(const std::string& arguments, const std::string& out = "out") const
	{
		return run("--quick --problem block-released --out " + (m_folder / out).string() + " " + arguments);
	}
	static std::string read(const fs::path& file)
	{
		std::ostringstream text;
		text << std::ifstream(file).rdbuf();
		return text.str();
	}
	json records(const std::string& out = "out") const { return json::parse(read(m_folder / out / "report.json")); }

	fs::path m_folder;
};

TEST_F(Report, HasRecordsOfEverySetting)
{
	ASSERT_EQ(0, report("").status);
	const json list = records();
	std::set<std::string> solvers, schemes;
	for (const json& record : list)
	{
		for (const char* key : {"problem", "quantity", "dt_s", "substeps", "solver", "iterations", "scheme",
								"joint_class", "precision", "value", "exact", "error", "run_time_s", "energy_audit"})
			EXPECT_TRUE(record.contains(key)) << key;
		solvers.insert(record.at("solver").get<std::string>());
		schemes.insert(record.at("scheme").get<std::string>());
		if (record.at("error").is_number())
		{
			// By its definition, from what stands beside it.
			EXPECT_NEAR(std::fabs(record.at("value").get<double>() / record.at("exact").get<double>() - 1),
						record.at("error").get<double>(), 1e-9);
		}
	}
	for (const char* solver : {"direct", "iterative", "stock", "nncg", "mlcp"})
		EXPECT_TRUE(solvers.count(solver)) << solver;
	for (const char* scheme : {"default", "inner steps", "paper", "bullet-fixed", "bullet-spring2", "profile",
							   "everything", "without elasticity", "without direct solve"})
		EXPECT_TRUE(schemes.count(scheme)) << scheme;
	// As many lines as records, and the headings.
	const std::string csv = read(m_folder / "out" / "report.csv");
	EXPECT_EQ(list.size() + 1, size_t(std::count(csv.begin(), csv.end(), '\n')));
}

TEST_F(Report, PageNeedsNothingElse)
{
	ASSERT_EQ(0, report("").status);
	const std::string page = read(m_folder / "out" / "report.html");
	EXPECT_NE(std::string::npos, page.find("<svg"));
	EXPECT_NE(std::string::npos, page.find("nothing better and quicker"));
	// Pictures are in it.
	const std::string source = "src=\"";
	for (size_t i = page.find(source); i != std::string::npos; i = page.find(source, i + 1))
		EXPECT_EQ("data:image/png;base64,iVBORw0KGgo", page.substr(i + source.size(), 33));
#ifdef EP_WITH_PICTURES
	EXPECT_NE(std::string::npos, page.find("<img alt=\"block-released\" src="));
#endif
	EXPECT_EQ(std::string::npos, page.find("<link"));
	EXPECT_EQ(std::string::npos, page.find("<script"));
	EXPECT_TRUE(fs::exists(m_folder / "out" / "pictures" / "overview.svg"));
}

TEST_F(Report, PointsOfAMethodAreJoined)
{
	ASSERT_EQ(0, report("").status);
	const std::string plot = read(m_folder / "out" / "pictures" / "block-released.svg");
	// Three steps of the direct solver in each precision: a finer step and substeps each lead on from the frame.
	const std::string tip = "our joints, direct, ";
	for (const char* precision : {"float", "double"})
		for (const char* step : {"1/60 s, ", "1/240 s, ", "1/60 s in 8 substeps, "})
			EXPECT_NE(std::string::npos, plot.find(step + tip + precision)) << step << tip << precision;
	const std::regex two("<polyline [^>]*points=\"[0-9.,]+ [0-9.,]+ \"/>");
	EXPECT_LE(4, std::distance(std::sregex_iterator(plot.begin(), plot.end(), two), std::sregex_iterator()));
	// The legend names a family once.
	const std::string name = ">our joints, our solver, direct<";
	const size_t first = plot.find(name);
	ASSERT_NE(std::string::npos, first);
	EXPECT_EQ(std::string::npos, plot.find(name, first + 1));
}

TEST_F(Report, CellsHoldOneNumberAndTellMoreUnderTheMouse)
{
	ASSERT_EQ(0, report("").status);
	const std::string page = read(m_folder / "out" / "report.html");
	const std::string tables = page.substr(0, page.find("<h2 id="));
	const std::regex cell("<td style=\"background:#[0-9a-f]+\"( title=\"([^\"]+)\")?>([^<]*)</td>"),
		one("|–|none other|(x )?[0-9.e+-]+( %)?");
	int cells = 0, tips = 0;
	for (std::sregex_iterator i(tables.begin(), tables.end(), cell); i != std::sregex_iterator(); ++i)
	{
		++cells;
		tips += (*i)[2].length() > 0;
		EXPECT_TRUE(std::regex_match(i->str(3), one)) << i->str(3);
	}
	// The profile's six, and the parts' eight.
	EXPECT_LT(14, cells);
	EXPECT_LE(14, tips);
	EXPECT_NE(std::string::npos, tables.find("substeps on average"));
}

TEST_F(Report, WarnsOfAMachineThatWasLoaded)
{
	ASSERT_EQ(0, report("").status);
	const auto withSpread = [this](const json& spread)
	{
		for (const auto& file : fs::directory_iterator(m_folder / "out" / "cases"))
		{
			json list = json::parse(read(file.path()));
			for (json& record : list)
				record["run_time_spread"] = spread;
			std::ofstream(file.path()) << list;
		}
		const Ended ended = report("");
		EXPECT_EQ(0, ended.status);
		const std::string page = read(m_folder / "out" / "report.html");
		const char* const warning = "The machine was loaded";
		EXPECT_EQ(ended.output.find(warning) == std::string::npos, page.find(warning) == std::string::npos);
		return page;
	};
	const std::string loaded = withSpread(0.4);
	EXPECT_NE(std::string::npos, loaded.find("The machine was loaded"));
	EXPECT_NE(std::string::npos, loaded.find("40 % apart"));
	const std::string quiet = withSpread(0.03);
	EXPECT_EQ(std::string::npos, quiet.find("The machine was loaded"));
	EXPECT_NE(std::string::npos, quiet.find("3 % apart"));
	EXPECT_NE(std::string::npos, withSpread(json()).find("each case timed once"));
}

TEST_F(Report, WhatCasesSayStaysOutOfTheTerminal)
{
	fs::create_directories(m_folder);
	const fs::path program = m_folder / "ep-report", stub = m_folder / "ep-report-case",
				   cases = m_folder / "out" / "cases";
	fs::copy_file(EP_REPORT, program);
	const std::string command =
		program.string() + " --quick --problem block-released --out " + (m_folder / "out").string();
	const auto runWith = [&](const std::string& body)
	{
		std::ofstream(stub) << "#!/bin/sh\necho a joint sags\necho and tells >&2\n" << body;
		fs::permissions(stub, fs::perms::owner_all);
		return run("", command);
	};
	const Ended failing = runWith("exit 1\n");
	EXPECT_EQ(1, failing.status);
	EXPECT_EQ(std::string::npos, failing.output.find("sags")) << failing.output;
	EXPECT_NE(std::string::npos, read(cases / "block-released.60x1.float.failed").find("a joint sags\nand tells\n"));
	const Ended ended = runWith("for last; do :; done\necho '[]' > \"$last\"\n");
	EXPECT_EQ(0, ended.status) << ended.output;
	EXPECT_EQ(std::string::npos, ended.output.find("sags")) << ended.output;
	EXPECT_NE(std::string::npos, ended.output.find("3 cases had something to say")) << ended.output;
	EXPECT_EQ("a joint sags\nand tells\n", read(cases / "block-released.60x1.float.log"));
}

TEST_F(Report, GoesOnWhereItWasInterrupted)
{
	ASSERT_EQ(0, report("").status);
	const json before = records();
	fs::path gone;
	for (const auto& file : fs::directory_iterator(m_folder / "out" / "cases"))
		gone = file.path();
	fs::remove(gone);
	const Ended again = report("");
	EXPECT_EQ(0, again.status);
	EXPECT_NE(std::string::npos, again.output.find("[1/1]")) << again.output;
	EXPECT_EQ(before.size(), records().size());
}

TEST_F(Report, ShardsMakeTheWhole)
{
	for (int i = 1; i <= 3; ++i)
		ASSERT_EQ(0, report("--shard " + std::to_string(i) + "/3", "shards").status);
	ASSERT_EQ(0, report("", "whole").status);
	json shards = records("shards"), whole = records("whole");
	ASSERT_EQ(whole.size(), shards.size());
	for (size_t i = 0; i < whole.size(); ++i)
		for (const char* key : {"problem", "quantity", "solver", "scheme", "precision", "value"})
			EXPECT_EQ(whole[i].at(key), shards[i].at(key));
}

TEST_F(Report, SaysWhatIsWrong)
{
	const struct
	{
		const char *arguments, *answer;
	} cases[] = {{"--problem nothing", "block-released"}, {"--quick --shard 4/3", "--shard is '4/3'; it must be i/n"},
				 {"--quick --shard x", "--shard is 'x'"}, {"--jobs 0", "--jobs"},
				 {"--repeats none", "--repeats"},         {"--nonsense", "--nonsense"}};
	for (const auto& c : cases)
	{
		const Ended result = run(std::string(c.arguments) + " --out " + (m_folder / "out").string());
		EXPECT_NE(0, result.status) << c.arguments;
		EXPECT_NE(std::string::npos, result.output.find(c.answer)) << result.output;
	}
	// Few settings where all were begun.
	ASSERT_EQ(0, report("", "few").status);
	const Ended mixed = run("--problem block-released --out " + (m_folder / "few").string());
	EXPECT_NE(0, mixed.status);
	EXPECT_NE(std::string::npos, mixed.output.find("was begun with few settings")) << mixed.output;
	// A file that is no list of records.
	fs::create_directories(m_folder / "out" / "cases");
	std::ofstream(m_folder / "out" / "cases" / "block-released.60x1.float.json") << "{";
	const Ended result = report("");
	EXPECT_NE(0, result.status);
	EXPECT_NE(std::string::npos, result.output.find("block-released.60x1.float.json' is no list of records"))
		<< result.output;
}

/// What stands in the folder for records may come from anywhere.
TEST_F(Report, ForeignRecordsAreRefused)
{
	ASSERT_EQ(0, report("").status);
	const fs::path file = m_folder / "out" / "cases" / "block-released.60x1.float.json";
	const std::string whole = read(file);
	const json record = json::parse(whole)[0];
	const auto with = [&record](const char* key, const json& value)
	{
		json changed = record;
		changed[key] = value;
		return json::array({changed}).dump();
	};
	json without = record;
	without.erase("steps");
	const struct
	{
		std::string text, answer;
	} cases[] = {{std::string(100000, '['), "more than 16 levels deep"},
				 {"[{}]", "record 1: problem is missing"},
				 {"[7]", "record 1 is 7; it must be an object"},
				 {"{\"a\": [1, 2]}", "it is an object with 1 keys"},
				 {json::array({without}).dump(), "record 1: steps is missing"},
				 {with("problem", "../../evil"), "problem is \"../../evil\"; it must be 1 to 64 letters"},
				 {with("problem", ""), "problem is \"\"; it must be"},
				 {with("problem", json::array({1, 2, 3})), "problem is a list of 3; it must be a text"},
				 {with("steps", 0), "steps is 0; it must be a whole number from 1 to 1000000000"},
				 {with("steps", -5), "steps is -5; it must be"},
				 {with("steps", 2.5), "steps is 2.5; it must be"},
				 {with("substeps", 0), "substeps is 0; it must be"},
				 {with("dt_s", 0), "dt_s is 0; it must be a number from 1e-12"},
				 {with("dt_s", -0.01), "dt_s is -0.01; it must be"},
				 // So small that a logarithmic axis has no end.
				 {with("run_time_s", 1e-323), "run_time_s is 1e-323; it must be"},
				 {with("simulated_s", json()), "simulated_s is null; it must be"},
				 {with("value", "much"), "value is \"much\"; it must be a number or null"},
				 {with("solver", "magic"), "solver is \"magic\"; it must be one of stock, nncg"},
				 {with("precision", std::string(100000, 'x')), "precision is \"xxxx"}};
	for (const auto& c : cases)
	{
		std::ofstream(file) << c.text;
		const Ended result = report("");
		EXPECT_EQ(1, result.status) << c.answer;
		EXPECT_NE(std::string::npos, result.output.find(c.answer)) << c.answer << "\n" << result.output.substr(0, 1000);
		EXPECT_NE(std::string::npos, result.output.find(file.string() + "' is no list of records")) << c.answer;
		EXPECT_NE(std::string::npos, result.output.find("delete it, and it is computed again")) << c.answer;
		EXPECT_LT(result.output.size(), 1000u) << c.answer;
	}
	// Nothing beside the folder.
	EXPECT_EQ(2, std::distance(fs::directory_iterator(m_folder), fs::directory_iterator()));
	std::ofstream(file) << whole;
	EXPECT_EQ(0, report("").status);
}

TEST_F(Report, WritesOverNothingThatIsNoReports)
{
	const fs::path out = m_folder / "out";
	const auto refuses = [&](const char* name, const std::string& text, const std::string& reason)
	{
		fs::create_directories(out);
		const std::string before = fs::exists(out / name) ? read(out / name) : "";
		std::ofstream(out / name) << text;
		const Ended result = report("");
		EXPECT_EQ(1, result.status) << name;
		EXPECT_NE(std::string::npos, result.output.find("'" + (out / name).string() + "' " + reason)) << result.output;
		EXPECT_EQ(text, read(out / name));
		EXPECT_FALSE(fs::exists(out / "cases") && before.empty()) << name;
		fs::remove(out / name);
		if (!before.empty())
			std::ofstream(out / name) << before;
	};
	// In a folder that no report has begun, whatever it is.
	for (const char* name : {"report.json", "stability.json", "report.csv", "report.html"})
		refuses(name, "[]", "would be overwritten, and no report has written it");
	fs::create_directories(out / "pictures");
	EXPECT_EQ(1, report("").status);
	fs::remove(out / "pictures");
	ASSERT_EQ(0, report("").status);
	// In one that has been begun.
	refuses("report.json", "[{}]", "is no list of records (record 1: problem is missing): delete it");
	refuses("stability.json", "{}", "is no list of records");
	EXPECT_EQ(0, report("").status);
}

/// Each problem's name is one that its own records may have.
TEST_F(Report, ReadsWhatItHasWrittenOfEachProblem)
{
	ASSERT_EQ(0, report("").status);
	const json list = json::parse(read(m_folder / "out" / "cases" / "block-released.60x1.float.json"));
	const std::string names = run("--list").output;
	std::istringstream lines(names);
	size_t count = 0;
	for (std::string line; std::getline(lines, line);)
	{
		json changed = list;
		const std::string name = line.substr(0, line.find(':'));
		if (name == "stability")
			continue;
		for (json& record : changed)
			record["problem"] = name;
		std::ofstream(m_folder / "out" / "cases" / (name + ".60x1.float.json")) << changed;
		// A picture that is there is not drawn again, which would take seconds each.
		std::ofstream(m_folder / "out" / "pictures" / (name + ".png")) << "";
		++count;
	}
	const Ended ended = report("");
	EXPECT_EQ(0, ended.status) << ended.output;
	// Beside them: overview, profile, parts and fibres.
	EXPECT_EQ(count,
			  size_t(std::count_if(fs::directory_iterator(m_folder / "out" / "pictures"), fs::directory_iterator(),
								   [](const auto& file) { return file.path().extension() == ".svg"; })) -
				  4);
	EXPECT_LT(20u, count);
}

TEST_F(Report, TextIsEscaped)
{
	ASSERT_EQ(0, report("").status);
	const fs::path cases = m_folder / "out" / "cases";
	const std::string text = "<script>alert(\"1 & 2\")</script>";
	for (const auto& file : fs::directory_iterator(cases))
	{
		json list = json::parse(read(file.path()));
		for (json& record : list)
			record["quantity"] = text;
		std::ofstream(file.path()) << list;
	}
	const json trial = {{"group", text},      {"trial", text},        {"solver", "direct"},
						{"joint_class", "-"}, {"precision", "float"}, {"complaint", text},
						{"value", json()},    {"exact", json()},      {"energy_created", json()},
						{"run_time_s", 1}};
	std::ofstream(cases / "stability.float.json") << json::array({trial});
	ASSERT_EQ(0, report("").status);
	const std::string page = read(m_folder / "out" / "report.html");
	EXPECT_EQ(std::string::npos, page.find("<script"));
	const std::string shown = "&lt;script&gt;alert(&quot;1 &amp; 2&quot;)&lt;/script&gt;";
	size_t count = 0;
	for (size_t i = page.find(shown); i != std::string::npos; i = page.find(shown, i + 1))
		++count;
	// The quantity in the heading and in each point's tip; group and trial in a cell, the complaint in another one.
	EXPECT_LT(4u, count);
}

TEST_F(Report, EndsWhenItIsInterrupted)
{
	// Programs that end as by Ctrl-C, beside a report of its own.
	fs::create_directories(m_folder);
	const fs::path program = m_folder / "ep-report", stub = m_folder / "ep-report-case";
	fs::copy_file(EP_REPORT, program);
	std::ofstream(stub) << "#!/bin/sh\nkill -INT $$\n";
	fs::permissions(stub, fs::perms::owner_all);
	const Ended ended = run("--quick --jobs 2 --out " + (m_folder / "out").string(), program.string());
	EXPECT_EQ(1, ended.status);
	EXPECT_NE(std::string::npos, ended.output.find("interrupted")) << ended.output;
	EXPECT_TRUE(fs::is_empty(m_folder / "out" / "cases"));
}
}  // namespace testReport
