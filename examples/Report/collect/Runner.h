// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_RUNNER_H
#define EP_REPORT_RUNNER_H

#include <map>
#include <string>
#include <vector>

#include "collect/Case.h"

namespace ep
{
struct RunnerSettings
{
	std::string folder;                         ///< for the cases' files
	std::map<Precision, std::string> programs;  ///< that compute cases
	int jobs = 1;
	int repeats = 3;
	bool quick = false;
};

/// Computes cases that have no file yet, each in a process of its own, several at a time; tells how far it is on standard
/// output. A case that fails leaves a file "<name>.failed" and is tried again the next time.
/// \return how many have failed; an interrupt (Ctrl-C) is thrown as a std::runtime_error
int runCases(const std::vector<Case>& cases, const RunnerSettings& settings);
}  // namespace ep

#endif  // EP_REPORT_RUNNER_H
