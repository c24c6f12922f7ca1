// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TRIAL_CATALOGUE_H
#define EP_TRIAL_CATALOGUE_H

#include <vector>

#include "trials/Trial.h"

namespace ep
{
/// All trials of stability.
const std::vector<Trial>& stabilityTrials();

/// By its full name. \return null if there is none of that name
const Trial* findTrial(const std::string& fullName);
}  // namespace ep

#endif  // EP_TRIAL_CATALOGUE_H
