// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_GRID_H
#define EP_REPORT_GRID_H

#include <cmath>
#include <string>
#include <vector>

namespace ep
{
/// A table with a row for each problem and cells coloured by an error, as part of a page or as a picture.
struct Grid
{
	struct Cell
	{
		std::string text;
		double error = NAN;    ///< green to red by its order of magnitude, not a number: no colour
		std::string tip = {};  ///< what else there is to know, under the mouse
	};
	struct Row
	{
		std::string name;  ///< of a problem; empty: a line about all of them
		std::vector<Cell> cells;
	};

	std::string title, what;
	std::vector<std::string> columns;
	std::vector<Row> rows;

	/// With its title as heading, names lead to sections of the same name.
	std::string html() const;
	std::string svg() const;
};

/// Two digits, "–" for what is no number.
std::string percent(double share);
}  // namespace ep

#endif  // EP_REPORT_GRID_H
