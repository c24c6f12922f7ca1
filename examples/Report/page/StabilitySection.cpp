// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The stability matrix.

#include <algorithm>
#include <map>

#include "page/Sections.h"
#include "text/Markup.h"

namespace ep
{
void writeStability(std::ostream& out, const std::vector<TrialRecord>& trials)
{
	if (trials.empty())
		return;
	std::vector<std::string> columns, rows;
	std::map<std::string, std::map<std::string, const TrialRecord*>> table;
	for (const TrialRecord& t : trials)
	{
		const std::string row = t.group + ": " + t.trial, column = nameOf(reportSolvers(), t.solver) + ", " +
																   nameOf(jointClasses(), t.jointClass) + ", " +
																   nameOf(precisions(), t.precision);
		if (std::find(columns.begin(), columns.end(), column) == columns.end())
			columns.push_back(column);
		if (!table.count(row))
			rows.push_back(row);
		table[row][column] = &t;
	}
	out << "<h2>Stability</h2><p>Green: everything stays finite, no energy is created, and the answer is right where "
		   "one is "
		   "known. Other cells tell what went wrong.</p>\n<table><tr><th></th>";
	for (const std::string& column : columns)
		out << "<th>" << escaped(column) << "</th>";
	out << "</tr>\n";
	for (const std::string& row : rows)
	{
		out << "<tr><td>" << escaped(row) << "</td>";
		for (const std::string& column : columns)
		{
			const TrialRecord* const t = table[row][column];
			const char* const shade = !t ? "#eee" : t->complaint.empty() ? "#91cf60" : "#fc8d59";
			out << "<td style=\"background:" << shade << "\">" << (t ? escaped(t->complaint) : "") << "</td>";
		}
		out << "</tr>\n";
	}
	out << "</table>\n";
}
}  // namespace ep
