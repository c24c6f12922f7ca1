// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PROBLEM_CATALOGUE_H
#define EP_PROBLEM_CATALOGUE_H

#include "problems/Problem.h"

namespace ep
{
/// All reference problems.
const std::vector<Problem>& problems();

/// \return null if there is none of that name
const Problem* findProblem(const std::string& name);
}  // namespace ep

#endif  // EP_PROBLEM_CATALOGUE_H
