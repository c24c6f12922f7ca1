// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_HTML_H
#define EP_REPORT_HTML_H

#include <string>
#include <utility>
#include <vector>

#include "judge/ByProblem.h"

namespace ep
{
/// The report as one page, plots inside. \param stamp  names and values: machine, compiler, versions, date
std::string htmlOf(const ByProblem& problems, const std::vector<TrialRecord>& trials,
				   const std::vector<std::pair<std::string, std::string>>& stamp);
}  // namespace ep

#endif  // EP_REPORT_HTML_H
