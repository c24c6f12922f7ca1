// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_JUDGEMENT_H
#define EP_REPORT_JUDGEMENT_H

#include <vector>

#include "collect/Record.h"

namespace ep
{
/// Those that no other beats in both error and time, the quickest first.
std::vector<const Record*> nonDominated(const std::vector<const Record*>& records);

/// The quickest within an error, null if there is none. It may be so by luck, where an error does not fall evenly.
const Record* quickestWithin(const std::vector<const Record*>& records, double error);

/// The quickest that is within an error and stays so with all of its finer substeps among the records: what one can rely on
/// without knowing the answer. Null if there is none.
const Record* quickestReliable(const std::vector<const Record*>& records, double error);

/// Order of convergence of one family with all else as in Bullet's defaults: the slope of log error over log step, by least
/// squares over the steps at which the error is neither 0 nor above 1/2. Not a number if there are less than three.
double orderOf(const std::vector<const Record*>& records, const Family& family);

/// The middle one; not a number of none.
double median(std::vector<double> values);

/// How far run times of one and the same case are apart, over all cases the median: small on a machine that does nothing else.
/// Not a number if none was timed twice.
double spreadOfTimes(const std::vector<Record>& records);
}  // namespace ep

#endif  // EP_REPORT_JUDGEMENT_H
