// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_FAMILIES_H
#define EP_REPORT_FAMILIES_H

#include <vector>

#include "judge/ByProblem.h"

namespace ep
{
/// All that are compared, as readers know them.
const std::vector<Named<Family>>& families();

/// Those that there are records of.
std::vector<Named<Family>> familiesOf(const ByProblem& problems);
}  // namespace ep

#endif  // EP_REPORT_FAMILIES_H
