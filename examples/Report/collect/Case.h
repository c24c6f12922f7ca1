// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_CASE_H
#define EP_REPORT_CASE_H

#include <string>
#include <vector>

#include "collect/Choices.h"

namespace ep
{
/// What one process computes: a problem at one step in one precision, by all methods, which take turns; or, as problem
/// STABILITY, the stability matrix of a precision.
struct Case
{
	static constexpr const char* STABILITY = "stability";

	std::string problem;
	Precision precision;
	int rate = 60;  ///< steps per second
	int substeps = 1;

	/// A name for files: cantilever-at-rest.60x1.float
	std::string name() const;
};

/// All cases of some problems. \param quick  few steps
std::vector<Case> casesOf(const std::vector<std::string>& problems, const std::vector<Precision>& precisions,
						  bool quick);
}  // namespace ep

#endif  // EP_REPORT_CASE_H
