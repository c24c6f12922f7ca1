// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BLOWS_H
#define EP_BLOWS_H

#include "problems/Problem.h"

namespace ep
{
/// Motion that plastic hinges stop.
std::vector<Problem> problemsOfBlows();
}  // namespace ep

#endif  // EP_BLOWS_H
