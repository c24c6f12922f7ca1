#include "Runner.h"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <thread>

namespace ep
{
namespace fs = std::filesystem;

namespace
{
std::string quoted(const std::string& text)
{
	std::string out = "'";
	for (const char c : text)
		out += c == '\'' ? std::string("'\\''") : std::string(1, c);
	return out + "'";
}

/// \return whether it went well
bool compute(const Case& c, const RunnerSettings& s)
{
	const fs::path file = fs::path(s.folder) / (c.name() + ".json"), part = file.string() + ".part",
				   failed = fs::path(s.folder) / (c.name() + ".failed");
	const std::string command = quoted(s.programs.at(c.precision)) + " --problem " + quoted(c.problem) + " --rate " +
								std::to_string(c.rate) + " --substeps " + std::to_string(c.substeps) + " --repeats " +
								std::to_string(s.repeats) + (s.quick ? " --quick" : "") + " --out " +
								quoted(part.string());
	const int status = std::system(command.c_str());
	std::error_code ignored;
	if (status != 0)
	{
		std::ofstream(failed) << command << "\nended with status " << status << "\n";
		fs::remove(part, ignored);
		return false;
	}
	fs::rename(part, file);
	fs::remove(failed, ignored);
	return true;
}
}  // namespace

int runCases(const std::vector<Case>& cases, const RunnerSettings& settings)
{
	fs::create_directories(settings.folder);
	std::vector<const Case*> open;
	for (const Case& c : cases)
		if (!fs::exists(fs::path(settings.folder) / (c.name() + ".json")))
			open.push_back(&c);
	printf("%zu cases, %zu of them computed before\n", cases.size(), cases.size() - open.size());

	std::atomic<size_t> next{0}, done{0};
	std::atomic<int> failed{0};
	std::mutex output;
	const auto begin = std::chrono::steady_clock::now();
	const auto work = [&]
	{
		for (size_t i; (i = next++) < open.size();)
		{
			const bool well = compute(*open[i], settings);
			failed += !well;
			const std::lock_guard<std::mutex> lock(output);
			const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
			const size_t n = ++done;
			printf("[%zu/%zu] %s%s, about %.0f s left\n", n, open.size(), open[i]->name().c_str(),
				   well ? "" : " FAILED", passed / double(n) * double(open.size() - n));
			fflush(stdout);
		}
	};
	std::vector<std::thread> threads;
	for (int i = 1; i < settings.jobs; ++i)
		threads.emplace_back(work);
	work();
	for (std::thread& thread : threads)
		thread.join();
	return failed;
}
}  // namespace ep
