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
#include <set>
#include <sstream>
#include <string>

namespace
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
	for (const char* scheme : {"default", "paper", "bullet-fixed", "bullet-spring2", "profile", "everything",
							   "without elasticity", "without direct solve"})
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
	EXPECT_EQ(std::string::npos, page.find("src="));
	EXPECT_EQ(std::string::npos, page.find("<link"));
	EXPECT_EQ(std::string::npos, page.find("<script"));
	EXPECT_TRUE(fs::exists(m_folder / "out" / "pictures" / "overview.svg"));
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
				 {with("problem", "../../evil"), "problem is \"../../evil\"; it must be 1 to 64 lower-case letters"},
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
}  // namespace
