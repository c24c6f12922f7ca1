// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_PICTURES_H
#define EP_CHARPY_PICTURES_H

#include "test/CharpySettings.h"

namespace ep
{
/// Runs a test and leaves its pictures in a directory: the paper's Figure 9 (details) and 10 (overview).
/// Throws std::runtime_error if they cannot be written.
void takeCharpyPictures(const CharpySettings& settings, const std::string& directory);
}  // namespace ep

#endif  // EP_CHARPY_PICTURES_H
