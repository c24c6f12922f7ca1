// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_MOTION_H
#define EP_MOTION_H

#include <vector>

#include "trials/Trial.h"

namespace ep
{
/// Turns, spin, impacts, all at once.
std::vector<Trial> trialsOfMotion();
}  // namespace ep

#endif  // EP_MOTION_H
