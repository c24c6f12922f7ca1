// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_HANDLING_H
#define EP_HANDLING_H

#include <vector>

#include "trials/Trial.h"

namespace ep
{
/// Capacities, frames, partners, sleep, long times, bad input.
std::vector<Trial> trialsOfHandling();
}  // namespace ep

#endif  // EP_HANDLING_H
