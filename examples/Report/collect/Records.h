// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_RECORDS_H
#define EP_REPORT_RECORDS_H

#include "collect/Record.h"

namespace ep
{
struct Records
{
	std::vector<Record> ofProblems;
	std::vector<TrialRecord> ofTrials;
};

/// What a file holds. Throws std::runtime_error naming it if it is no list of records.
Records readRecords(const std::string& file);

/// What all files of a folder hold, in the order of their names.
Records readAllRecords(const std::string& folder);
}  // namespace ep

#endif  // EP_REPORT_RECORDS_H
