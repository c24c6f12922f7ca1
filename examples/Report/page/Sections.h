// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_HTML_PARTS_H
#define EP_REPORT_HTML_PARTS_H

#include <ostream>
#include <string>
#include <vector>

#include "judge/ByProblem.h"

namespace ep
{
// The page's parts, from the top.
void writeStability(std::ostream& out, const std::vector<TrialRecord>& trials);
void writeProblem(std::ostream& out, const std::string& name, const Selection& records);
}  // namespace ep

#endif  // EP_REPORT_HTML_PARTS_H
