// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_HELD_BEAMS_H
#define EP_HELD_BEAMS_H

#include "problems/Problem.h"

namespace ep
{
/// Bodies and beams in which axial force and bending act together as they move.
std::vector<Problem> problemsOfHeldBeams();
}  // namespace ep

#endif  // EP_HELD_BEAMS_H
