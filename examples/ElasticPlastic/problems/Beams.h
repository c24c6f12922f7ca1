// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BEAMS_H
#define EP_BEAMS_H

#include "problems/Problem.h"

namespace ep
{
/// Structures that carry a load, up to their collapse.
std::vector<Problem> problemsOfBeams();
}  // namespace ep

#endif  // EP_BEAMS_H
