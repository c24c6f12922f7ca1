// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SCALE_H
#define EP_SCALE_H

#include <vector>

#include "trials/Trial.h"

namespace ep
{
/// Stiffness, mass, size, step, damping.
std::vector<Trial> trialsOfScale();
}  // namespace ep

#endif  // EP_SCALE_H
