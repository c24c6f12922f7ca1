// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "cases/CaseRunner.h"

#include <sys/wait.h>

#include <algorithm>
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
/// While it waits std::system() keeps the user's interrupt from this program: the case's end tells of it.
bool isInterrupt(int status)
{
	return WIFSIGNALED(status) ? WTERMSIG(status) == SIGINT : WEXITSTATUS(status) == 128 + SIGINT;
}

/// What a case says.
fs::path logOf(const CaseJob& job, const fs::path& folder) { return folder / (job.name + ".log"); }

enum class End
{
	WELL,
	FAILED,
	INTERRUPTED
};

End compute(const CaseJob& job, const fs::path& folder)
{
	const fs::path product = folder / job.product, part = product.string() + ".part",
				   failed = folder / (job.name + ".failed"), log = logOf(job, folder);
	const std::string command = job.command(part.string());
	std::error_code ignored;
	fs::remove_all(part, ignored);
	// What a case says is about that case: among the lines that tell how far all are it would say nothing.
	const int status = std::system(("{ " + command + "\n} > " + shellWord(log.string()) + " 2>&1").c_str());
	if (isInterrupt(status) || fs::is_empty(log, ignored))
		fs::remove(log, ignored);
	if (status != 0)
	{
		if (isInterrupt(status))
			return End::INTERRUPTED;
		std::ofstream(failed) << command << "\nended with status " << status << "\n" << std::ifstream(log).rdbuf();
		fs::remove(log, ignored);
		return End::FAILED;
	}
	fs::rename(part, product);
	fs::remove(failed, ignored);
	return End::WELL;
}
}  // namespace

std::string shellWord(const std::string& text)
{
	std::string out = "'";
	for (const char c : text)
		out += c == '\'' ? std::string("'\\''") : std::string(1, c);
	return out + "'";
}

std::vector<size_t> shardOf(size_t cases, const std::string& shard)
{
	size_t i = 1, n = 1;
	int first = 0, step = 0;
	char rest;
	if (!shard.empty())
	{
		if (sscanf(shard.c_str(), "%d/%d%c", &first, &step, &rest) != 2 || step < 1 || first < 1 || first > step)
			throw std::runtime_error("--shard is '" + shard + "'; it must be i/n with 1 <= i <= n, such as 3/8");
		i = size_t(first);
		n = size_t(step);
	}
	std::vector<size_t> mine;
	for (size_t k = i - 1; k < cases; k += n)
		mine.push_back(k);
	return mine;
}

std::string programFolder(const char* self)
{
	std::error_code none;
	const fs::path folder = fs::read_symlink("/proc/self/exe", none).parent_path();
	return (folder.empty() ? fs::absolute(self).parent_path() : folder).string();
}

int runCases(const std::vector<CaseJob>& jobs, const std::string& folder, int parallel)
{
	fs::create_directories(folder);
	std::vector<const CaseJob*> open;
	for (const CaseJob& job : jobs)
		if (!fs::exists(fs::path(folder) / job.product))
			open.push_back(&job);
	printf("%zu cases, %zu of them computed before\n", jobs.size(), jobs.size() - open.size());

	std::atomic<size_t> next{0}, done{0};
	std::atomic<int> failed{0};
	std::atomic<bool> interrupted{false};
	std::mutex output;
	const auto begin = std::chrono::steady_clock::now();
	const auto work = [&]
	{
		for (size_t i; !interrupted && (i = next++) < open.size();)
		{
			const End end = compute(*open[i], folder);
			if (end == End::INTERRUPTED)
				interrupted = true;
			if (interrupted)
				return;
			failed += end == End::FAILED;
			const std::lock_guard<std::mutex> lock(output);
			const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
			const size_t n = ++done;
			printf("[%zu/%zu] %s%s, about %.0f s left\n", n, open.size(), open[i]->name.c_str(),
				   end == End::WELL ? "" : " FAILED", passed / double(n) * double(open.size() - n));
			fflush(stdout);
		}
	};
	std::vector<std::thread> threads;
	for (int i = 1; i < parallel; ++i)
		threads.emplace_back(work);
	work();
	for (std::thread& thread : threads)
		thread.join();
	if (interrupted)
		throw std::runtime_error("interrupted; called again with the same --out it goes on");
	const size_t talkers = size_t(std::count_if(
		open.begin(), open.end(), [&folder](const CaseJob* job) { return fs::exists(logOf(*job, folder)); }));
	if (talkers > 0)
		printf("%zu cases had something to say: see the .log files in %s\n", talkers, folder.c_str());
	return failed;
}
}  // namespace ep
