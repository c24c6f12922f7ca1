// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_BY_PROBLEM_H
#define EP_REPORT_BY_PROBLEM_H

#include <map>
#include <string>
#include <vector>

#include "collect/Record.h"

namespace ep
{
typedef std::vector<const Record*> Selection;

/// Of all problems, each by the quantity in which a case is worst.
struct ByProblem
{
	std::vector<std::string> names;  ///< in the order of the records
	std::map<std::string, Selection> records;
	std::map<std::string, std::vector<std::string>> quantities;

	/// They point into the records.
	explicit ByProblem(const std::vector<Record>& all);
};
}  // namespace ep

#endif  // EP_REPORT_BY_PROBLEM_H
