// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "collect/Runner.h"

#include <sys/wait.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <stdexcept>
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

/// While it waits std::system() keeps the user's interrupt from this program: the case's end tells of it.
bool isInterrupt(int status)
{
	return WIFSIGNALED(status) ? WTERMSIG(status) == SIGINT : WEXITSTATUS(status) == 128 + SIGINT;
}

enum class End
{
	WELL,
	FAILED,
	INTERRUPTED
};

End compute(const Case& c, const RunnerSettings& s)
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
		fs::remove(part, ignored);
		if (isInterrupt(status))
			return End::INTERRUPTED;
		std::ofstream(failed) << command << "\nended with status " << status << "\n";
		return End::FAILED;
	}
	fs::rename(part, file);
	fs::remove(failed, ignored);
	return End::WELL;
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
	std::atomic<bool> interrupted{false};
	std::mutex output;
	const auto begin = std::chrono::steady_clock::now();
	const auto work = [&]
	{
		for (size_t i; !interrupted && (i = next++) < open.size();)
		{
			const End end = compute(*open[i], settings);
			if (end == End::INTERRUPTED)
				interrupted = true;
			if (interrupted)
				return;
			failed += end == End::FAILED;
			const std::lock_guard<std::mutex> lock(output);
			const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
			const size_t n = ++done;
			printf("[%zu/%zu] %s%s, about %.0f s left\n", n, open.size(), open[i]->name().c_str(),
				   end == End::WELL ? "" : " FAILED", passed / double(n) * double(open.size() - n));
			fflush(stdout);
		}
	};
	std::vector<std::thread> threads;
	for (int i = 1; i < settings.jobs; ++i)
		threads.emplace_back(work);
	work();
	for (std::thread& thread : threads)
		thread.join();
	if (interrupted)
		throw std::runtime_error("interrupted; called again with the same --out it goes on");
	return failed;
}
}  // namespace ep
