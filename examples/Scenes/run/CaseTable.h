// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CASE_TABLE_H
#define EP_CASE_TABLE_H

#include "run/Variation.h"

namespace ep
{
/// A folder's name for the results of a case, from 0.
std::string caseName(size_t index);

/// One line for each case that has been computed: what was varied, and what its summary says, with the probes' last, least and
/// most values. \param folder  with a folder for each case. Throws a std::runtime_error naming a summary that cannot be read.
std::string caseTable(const Variation& variation, const std::string& folder);
}  // namespace ep

#endif  // EP_CASE_TABLE_H
