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
