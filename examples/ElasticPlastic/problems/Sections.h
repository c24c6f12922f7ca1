// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PROBLEM_SECTIONS_H
#define EP_PROBLEM_SECTIONS_H

#include "problems/Problem.h"

namespace ep
{
/// What sections bear under forces that act together.
std::vector<Problem> problemsOfSections();
}  // namespace ep

#endif  // EP_PROBLEM_SECTIONS_H
