// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_PROBLEM_VIEW_H
#define EP_REPORT_PROBLEM_VIEW_H

#include <string>

namespace ep
{
/// What a problem looks like when it has moved furthest: a PNG file, which is drawn if it is not there.
/// \return the file in base64; empty if there is no such problem, or if this is built without pictures
std::string viewOfProblem(const std::string& name, const std::string& file);
}  // namespace ep

#endif  // EP_REPORT_PROBLEM_VIEW_H
