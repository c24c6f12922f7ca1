// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_ROUTE_FILE_H
#define EP_ROUTE_FILE_H

#include <string>

#include "vehicle/Autopilot.h"

namespace ep
{
/// Reads a route from a JSON file: {"legs": [{"to_x_m": 60, "speed_m_s": 12, "stop": true, "wait_s": 2}, {"wait_s": 5}]}.
/// Throws std::runtime_error that names the file, what is wrong and what would be right.
Route readRoute(const std::string& file);
}  // namespace ep

#endif  // EP_ROUTE_FILE_H
