// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_RECORDS_H
#define EP_REPORT_RECORDS_H

#include "collect/Record.h"

namespace ep
{
/// What the files of a folder hold.
struct Records
{
	std::vector<Record> ofProblems;
	std::vector<TrialRecord> ofTrials;
};

/// In the order of the files' names. Throws std::runtime_error naming a file that cannot be read.
Records readRecords(const std::string& folder);
}  // namespace ep

#endif  // EP_REPORT_RECORDS_H
