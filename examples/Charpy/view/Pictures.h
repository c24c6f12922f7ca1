// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_PICTURES_H
#define EP_CHARPY_PICTURES_H

#include "test/Settings.h"

namespace ep::charpy
{
/// Runs a test and leaves its pictures in a directory: the paper's Figure 9 (details) and 10 (overview).
/// Throws std::runtime_error if they cannot be written.
void takePictures(const Settings& settings, const std::string& directory);
}  // namespace ep::charpy

#endif  // EP_CHARPY_PICTURES_H
