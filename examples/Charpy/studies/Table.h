// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_TABLE_H
#define EP_CHARPY_TABLE_H

#include <string>
#include <vector>

namespace ep::charpy
{
/// Numbers in rows and named columns, that can be written, read and drawn. What is not known is NaN.
struct Table
{
	std::string name;   ///< of files
	std::string title;  ///< for people
	std::vector<std::string> columns;
	std::vector<std::vector<double>> rows;
	std::string labelColumn;          ///< empty: rows have no labels
	std::vector<std::string> labels;  ///< of rows

	/// A column to draw over column 0.
	struct Series
	{
		size_t column;
		bool line;  ///< else points
	};
	std::vector<Series> series;
	bool logarithmic = false;  ///< column 0
	std::string yTitle;

	void add(const std::vector<double>& row, const std::string& label = std::string());

	std::string toCsv() const;
	/// Columns aligned.
	std::string toText() const;
	/// A picture of the series, empty if there are none.
	std::string toSvg() const;
};
}  // namespace ep::charpy

#endif  // EP_CHARPY_TABLE_H
