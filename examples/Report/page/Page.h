// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_HTML_H
#define EP_REPORT_HTML_H

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "judge/ByProblem.h"

namespace ep
{
struct Page
{
	std::vector<std::pair<std::string, std::string>> stamp;  ///< names and values: machine, compiler, versions, date
	std::string warning;                                     ///< about the times; may be empty
	std::map<std::string, std::string> views;                ///< of problems, by their names: PNG in base64
};

/// The report as one page, plots and pictures inside.
std::string htmlOf(const ByProblem& problems, const std::vector<TrialRecord>& trials, const Page& page);
}  // namespace ep

#endif  // EP_REPORT_HTML_H
