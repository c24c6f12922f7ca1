// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_FAMILIES_H
#define EP_REPORT_FAMILIES_H

#include <string>
#include <vector>

#include "judge/ByProblem.h"

namespace ep
{
/// What is compared, as readers know it.
struct Family
{
	const char* key;  ///< Record::family()
	const char* name;
};

/// All of them.
const std::vector<Family>& families();

/// Those that there are records of.
std::vector<Family> familiesOf(const ByProblem& problems);
}  // namespace ep

#endif  // EP_REPORT_FAMILIES_H
