// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <benchmark/benchmark.h>

#include <cstring>

int main(int argc, char** argv)
{
	// What takes minutes runs when it is asked for.
	bool isAskedFor = false;
	for (int i = 1; i < argc; ++i)
		isAskedFor |= std::strncmp(argv[i], "--benchmark_filter", std::strlen("--benchmark_filter")) == 0;
	benchmark::Initialize(&argc, argv);
	if (benchmark::ReportUnrecognizedArguments(argc, argv))
		return 1;
	if (isAskedFor)
		benchmark::RunSpecifiedBenchmarks();
	else
		benchmark::RunSpecifiedBenchmarks(nullptr, nullptr, "-^Large");
	benchmark::Shutdown();
	return 0;
}
