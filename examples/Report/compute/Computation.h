// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_COMPUTATION_H
#define EP_REPORT_COMPUTATION_H

#include "collect/Record.h"
#include "problems/Problem.h"

namespace ep
{
/// What a problem is computed with, by all methods that are compared at that.
struct ComputationSettings
{
	int rate = 60;  ///< steps per second
	int substeps = 1;
	int repeats = 3;     ///< of which the median time counts
	bool quick = false;  ///< few methods
};
std::vector<Record> compute(const Problem& problem, const ComputationSettings& settings);

/// The stability matrix.
std::vector<TrialRecord> computeTrials();
}  // namespace ep

#endif  // EP_REPORT_COMPUTATION_H
