// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_LOADING_H
#define EP_LOADING_H

#include <vector>

#include "trials/Trial.h"

namespace ep
{
/// What games do to bodies that joints hold: impulses in place of forces, supports that move or have a velocity.
std::vector<Trial> trialsOfLoading();
}  // namespace ep

#endif  // EP_LOADING_H
