// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_STUDIES_H
#define EP_CHARPY_STUDIES_H

#include "test/Charpy.h"
#include "studies/CharpyTable.h"

namespace ep
{
/// A row of tests that differ in something, by name.
struct CharpyStudy
{
	const char* name;
	const char* help;
	CharpyTable (*run)(const CharpySettings& settings);
};
const std::vector<CharpyStudy>& charpyStudies();

/// Loss of tests that differ in the hammer's place by up to 20 um, in 41 equal steps [J].
std::vector<double> lossesOverShifts(CharpySettings settings);

struct CharpySpread
{
	double mean, deviation, least, most;  ///< [J]
};
CharpySpread spreadOf(const std::vector<double>& losses);
}  // namespace ep

#endif  // EP_CHARPY_STUDIES_H
