// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "page/Grid.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "text/Markup.h"

namespace ep
{
std::string percent(double share)
{
	char text[32];
	if (!std::isfinite(share))
		return "–";
	snprintf(text, sizeof text, share < 1e-5 ? "%.0e %%" : share < 0.0995 ? "%.2g %%" : "%.0f %%", 100 * share);
	return text;
}

namespace
{
const char* shadeOf(double error)
{
	return std::isnan(error) ? "#f4f4f4"
		   : error <= 0.001  ? "#4fb56a"
		   : error <= 0.01   ? "#a6d96a"
		   : error <= 0.1    ? "#fee08b"
		   : error <= 1      ? "#fc8d59"
							 : "#e0503f";
}

/// Lines of some letters each, a word at least.
std::vector<std::string> wrapped(const std::string& text, size_t letters)
{
	std::vector<std::string> lines(1);
	std::istringstream words(text);
	for (std::string word; words >> word;)
		if (lines.back().empty() || lines.back().size() + word.size() < letters)
			lines.back() += (lines.back().empty() ? "" : " ") + word;
		else
			lines.push_back(word);
	return lines;
}

const int LEFT = 170, TOP = 40, LINE = 15, ROW = 24, LETTER = 7, GAP = 14;
}  // namespace

std::string Grid::html() const
{
	std::ostringstream out;
	out << "<h2>" << escaped(title) << "</h2><p>" << escaped(what) << "</p>\n<table><tr><th>Problem</th>";
	for (const std::string& column : columns)
		out << "<th>" << escaped(column) << "</th>";
	out << "</tr>\n";
	for (const Row& row : rows)
	{
		out << "<tr><td>";
		if (!row.name.empty())
			out << "<a href=\"#" << escaped(row.name) << "\">" << escaped(row.name) << "</a>";
		out << "</td>";
		for (const Cell& cell : row.cells)
			out << "<td style=\"background:" << shadeOf(cell.error) << "\""
				<< (cell.tip.empty() ? "" : " title=\"" + escaped(cell.tip) + "\"") << ">" << escaped(cell.text)
				<< "</td>";
		out << "</tr>\n";
	}
	out << "</table>\n";
	return out.str();
}

std::string Grid::svg() const
{
	std::vector<int> widths;
	size_t headLines = 1;
	int width = LEFT + 8;
	for (size_t c = 0; c < columns.size(); ++c)
	{
		size_t letters = 12;
		for (const Row& row : rows)
			letters = std::max(letters, row.cells[c].text.size());
		widths.push_back(int(letters) * LETTER + GAP);
		width += widths.back();
		headLines = std::max(headLines, wrapped(columns[c], letters + 3).size());
	}
	const int top = TOP + LINE * int(headLines) + 6, height = top + ROW * int(rows.size()) + 8;
	std::ostringstream out;
	out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << " " << height << "\" width=\""
		<< width << "\" height=\"" << height << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\""
		<< width << "\" height=\"" << height
		<< "\" fill=\"#fff\"/>\n<text x=\"8\" y=\"22\" font-size=\"16\" font-weight=\"bold\">" << escaped(title)
		<< "</text>\n";
	const auto text = [&](int x, int y, const std::string& words, const char* anchor)
	{
		out << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\">" << escaped(words)
			<< "</text>\n";
	};
	int x = LEFT;
	for (size_t c = 0; c < columns.size(); ++c)
	{
		int y = TOP + LINE - 4;
		for (const std::string& line : wrapped(columns[c], size_t(widths[c] - GAP) / LETTER + 3))
		{
			text(x + widths[c] / 2, y, line, "middle");
			y += LINE;
		}
		x += widths[c];
	}
	int y = top;
	for (const Row& row : rows)
	{
		text(8, y + 16, row.name, "start");
		x = LEFT;
		for (size_t c = 0; c < columns.size(); ++c)
		{
			out << "<rect x=\"" << x + 1 << "\" y=\"" << y + 1 << "\" width=\"" << widths[c] - 2 << "\" height=\""
				<< ROW - 2 << "\" fill=\"" << shadeOf(row.cells[c].error) << "\">"
				<< (row.cells[c].tip.empty() ? "" : "<title>" + escaped(row.cells[c].tip) + "</title>") << "</rect>\n";
			text(x + widths[c] / 2, y + 16, row.cells[c].text, "middle");
			x += widths[c];
		}
		y += ROW;
	}
	out << "</svg>\n";
	return out.str();
}
}  // namespace ep
