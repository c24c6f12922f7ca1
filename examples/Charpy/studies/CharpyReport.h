// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_REPORT_H
#define EP_CHARPY_REPORT_H

#include "test/Charpy.h"
#include "studies/CharpyTable.h"

namespace ep
{
/// The result and what it was got with in JSON, units in the names.
std::string toJson(const CharpyResult& result, const CharpySettings& settings);

/// One line for the terminal.
std::string toLine(const CharpyResult& result);

/// Energies over time, a row for each step of the time stepping.
CharpyTable energyTable();
void addEnergies(CharpyTable& table, const Charpy& charpy);

/// Runs a test and leaves summary.json, energy.csv and energy.svg in a directory.
CharpyResult runAndReport(const CharpySettings& settings, const std::string& directory);
/// Writes a table, and its picture if it has one. \return the files' names
std::string writeTable(const CharpyTable& table, const std::string& directory);
}  // namespace ep

#endif  // EP_CHARPY_REPORT_H
