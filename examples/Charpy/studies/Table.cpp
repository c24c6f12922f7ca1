// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "studies/Table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plot/Plot.h"

namespace ep::charpy
{
namespace
{
std::string number(const char* pattern, double value)
{
	if (!std::isfinite(value))
		return "";
	char text[64];
	std::snprintf(text, sizeof text, pattern, value);
	return text;
}

/// A comma within a name does not end it.
std::string csvField(const std::string& text) { return text.find(',') == std::string::npos ? text : '"' + text + '"'; }

std::string padded(const std::string& text, size_t width)
{
	return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}
}  // namespace

void Table::add(const std::vector<double>& row, const std::string& label)
{
	rows.push_back(row);
	labels.push_back(label);
}

std::string Table::toCsv() const
{
	std::string csv = labelColumn.empty() ? "" : labelColumn + ",";
	for (size_t c = 0; c < columns.size(); ++c)
		csv += (c > 0 ? "," : "") + csvField(columns[c]);
	csv += "\n";
	for (size_t r = 0; r < rows.size(); ++r)
	{
		if (!labelColumn.empty())
			csv += labels[r] + ",";
		for (size_t c = 0; c < columns.size(); ++c)
			csv += (c > 0 ? "," : "") + number("%.9g", rows[r][c]);
		csv += "\n";
	}
	return csv;
}

std::string Table::toText() const
{
	std::vector<std::vector<std::string>> cells(rows.size() + 1);
	if (!labelColumn.empty())
	{
		cells[0].push_back(labelColumn);
		for (size_t r = 0; r < rows.size(); ++r)
			cells[r + 1].push_back(labels[r]);
	}
	for (size_t c = 0; c < columns.size(); ++c)
	{
		cells[0].push_back(columns[c]);
		for (size_t r = 0; r < rows.size(); ++r)
			cells[r + 1].push_back(std::isfinite(rows[r][c]) ? number("%.5g", rows[r][c]) : "-");
	}
	std::string all = title + "\n";
	for (const auto& line : cells)
	{
		for (size_t c = 0; c < line.size(); ++c)
		{
			size_t width = 0;
			for (const auto& other : cells)
				width = std::max(width, other[c].size());
			all += "  " + padded(line[c], width);
		}
		all += "\n";
	}
	return all;
}

std::string Table::toSvg() const
{
	if (series.empty() || rows.empty())
		return std::string();
	Plot plot;
	plot.m_title = title;
	plot.m_xLabel = columns[0];
	plot.m_yLabel = yTitle;
	plot.m_logX = logarithmic;
	plot.m_fromZero = true;
	for (const Series& s : series)
	{
		Plot::Curve curve{columns[s.column], {}, s.line ? Plot::SOLID : Plot::MARKS};
		for (const auto& row : rows)
			if (std::isfinite(row[s.column]))
				curve.m_points.emplace_back(row[0], row[s.column]);
		plot.m_curves.push_back(curve);
	}
	return plot.svg();
}
}  // namespace ep::charpy
