// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_STUDIES_H
#define EP_CHARPY_STUDIES_H

#include "test/ImpactTest.h"
#include "studies/Table.h"

namespace ep::charpy
{
/// A row of tests that differ in something, by name.
struct Study
{
	const char* name;
	const char* help;
	Table (*run)(const Settings& settings);
};
const std::vector<Study>& studies();

/// Loss of tests whose hammers stand a micrometre from each other [J]. \param most  to either side of the place of the settings
std::vector<double> lossesOverShifts(Settings settings, int most = 20);

struct Spread
{
	double mean, deviation, least, most;  ///< [J]
};
Spread spreadOf(const std::vector<double>& losses);
}  // namespace ep::charpy

#endif  // EP_CHARPY_STUDIES_H
