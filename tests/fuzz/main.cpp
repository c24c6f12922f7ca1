// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Random sequences of calls: fuzz [--first SEED] [--sequences N | --seconds T] [--fresh] [--legal | --hostile] [--pool]
// Ends with 1 if one has gone wrong, and tells how to see it again. Meant to be built with sanitizers.

#include <chrono>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <string>

#include "LinearMath/btThreads.h"
#include "fuzz/Sequence.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define EP_HAS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define EP_HAS_SANITIZER 1
#endif
#endif
#ifdef EP_HAS_SANITIZER
#include <sanitizer/common_interface_defs.h>
#endif

namespace
{
struct Options
{
	unsigned first = 1;
	long sequences = -1;
	double seconds = -1;
	bool isLegal = true, isHostile = true, isPool = false;
};

unsigned s_seed = 0;
std::string s_mode;

void tellSeed()
{
	printf("FAILED: fuzz --first %u --sequences 1 %s\n", s_seed, s_mode.c_str());
	fflush(stdout);
}

[[noreturn]] void refuse(const char* what)
{
	printf(
		"fuzz: %s. Options: --first SEED, --sequences N, --seconds T, --fresh (seeds by the clock), --legal, "
		"--hostile, --pool (worlds of Bullet's with threads)\n",
		what);
	exit(2);
}

double numberAfter(int& i, int argc, char** argv)
{
	char* end = nullptr;
	const double value = i + 1 < argc ? strtod(argv[i + 1], &end) : -1;
	if (!(value >= 0 && value < 1e9) || !end || *end)
		refuse((std::string(argv[i]) + " needs a number from 0 to 1e9").c_str());
	++i;
	return value;
}

Options read(int argc, char** argv)
{
	Options o;
	for (int i = 1; i < argc; ++i)
		if (!strcmp(argv[i], "--first"))
			o.first = unsigned(numberAfter(i, argc, argv));
		else if (!strcmp(argv[i], "--sequences"))
			o.sequences = long(numberAfter(i, argc, argv));
		else if (!strcmp(argv[i], "--seconds"))
			o.seconds = numberAfter(i, argc, argv);
		else if (!strcmp(argv[i], "--fresh"))
			o.first = unsigned(std::chrono::system_clock::now().time_since_epoch().count() / 1000000);
		else if (!strcmp(argv[i], "--legal"))
			o.isHostile = false;
		else if (!strcmp(argv[i], "--hostile"))
			o.isLegal = false;
		else if (!strcmp(argv[i], "--pool"))
			o.isPool = true;
		else
			refuse((std::string("unknown option ") + argv[i]).c_str());
	if (o.sequences < 0 && o.seconds < 0)
		o.sequences = 1000;
	return o;
}
}  // namespace

int main(int argc, char** argv)
{
	const Options o = read(argc, argv);
#ifdef EP_HAS_SANITIZER
	__sanitizer_set_death_callback(tellSeed);
#endif
#ifdef __GLIBC__
	// What is refused without a listener is printed. Sanitizers write past this.
	stderr = fopen("/dev/null", "w");
#endif
	printf("Seeds from %u\n", o.first);
	fflush(stdout);
	if (o.isPool)
	{
		// Null where Bullet is built without threads.
		btITaskScheduler* const scheduler = btCreateDefaultTaskScheduler();
		btSetTaskScheduler(scheduler ? scheduler : btGetSequentialTaskScheduler());
	}
	const auto begin = std::chrono::steady_clock::now();
	long done = 0;
	const auto goesOn = [&]
	{
		return (o.sequences < 0 || done < o.sequences) &&
			   (o.seconds < 0 ||
				std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < o.seconds);
	};
	for (s_seed = o.first; goesOn(); ++s_seed, ++done)
		for (const bool isHostile : {false, true})
		{
			if (isHostile ? !o.isHostile : !o.isLegal)
				continue;
			s_mode = (isHostile ? "--hostile" : "--legal") + std::string(o.isPool ? " --pool" : "");
			const std::string complaint = Sequence(s_seed, isHostile, o.isPool).run();
			if (complaint.empty())
				continue;
			printf("%s\n", complaint.c_str());
			tellSeed();
			return 1;
		}
	printf("%ld seeds passed\n", done);
	return 0;
}
