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
/// \param view  of it, as PNG in base64; may be empty
void writeProblem(std::ostream& out, const std::string& name, const Selection& records, const std::string& view);
}  // namespace ep

#endif  // EP_REPORT_HTML_PARTS_H
