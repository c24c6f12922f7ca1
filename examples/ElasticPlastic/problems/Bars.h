// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BARS_H
#define EP_BARS_H

#include "problems/Problem.h"

namespace ep
{
/// One degree of freedom: pulled, twisted and bent to and fro, broken.
std::vector<Problem> problemsOfBars();
}  // namespace ep

#endif  // EP_BARS_H
