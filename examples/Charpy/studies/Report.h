// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_REPORT_H
#define EP_CHARPY_REPORT_H

#include "test/ImpactTest.h"
#include "studies/Table.h"

namespace ep::charpy
{
/// The result and what it was got with in JSON, units in the names.
std::string toJson(const Result& result, const Settings& settings);

/// One line for the terminal.
std::string toLine(const Result& result);

/// Energies over time, a row for each step of the time stepping.
Table energyTable();
void addEnergies(Table& table, const ImpactTest& charpy);

/// Runs a test and leaves summary.json, energy.csv and energy.svg in a directory.
Result runAndReport(const Settings& settings, const std::string& directory);
/// Writes a table, and its picture if it has one. \return the files' names
std::string writeTable(const Table& table, const std::string& directory);
}  // namespace ep::charpy

#endif  // EP_CHARPY_REPORT_H
