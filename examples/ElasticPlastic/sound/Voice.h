// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VOICE_H
#define EP_VOICE_H

#include <vector>

#include "drawing/Burst.h"

namespace ep
{
/// How loud a burst is, 0 to 1: silent below 10 J, as loud as can be at a megajoule.
float loudnessOf(const Burst& burst);

/// What it sounds like, by its kind and material, lower and longer with its energy: samples from -1 to 1.
std::vector<float> voiceOf(const Burst& burst, int samplesPerSecond);
}  // namespace ep

#endif  // EP_VOICE_H
