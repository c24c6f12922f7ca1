#include "CharpyTable.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ep
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

std::string padded(const std::string& text, size_t width)
{
	return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

/// From values to places in the picture, with round numbers beside it.
class Axis
{
public:
	Axis(double low, double high, double from, double to, bool logarithmic)
		: m_from(from), m_to(to), m_logarithmic(logarithmic)
	{
		if (logarithmic)
		{
			m_low = std::log10(low);
			m_high = std::log10(high);
			for (int power = int(std::floor(m_low)); power <= int(std::ceil(m_high)); ++power)
				for (double factor : {1., 2., 5.})
				{
					const double tick = factor * std::pow(10., power);
					if (tick >= low * 0.999 && tick <= high * 1.001)
						m_ticks.push_back(tick);
				}
			return;
		}
		const double raw = std::max(high - low, 1e-12) / 5, unit = std::pow(10., std::floor(std::log10(raw)));
		const double factor = raw / unit, distance = unit * (factor > 5 ? 10 : factor > 2 ? 5 : factor > 1 ? 2 : 1);
		m_low = std::floor(low / distance + 1e-9) * distance;
		m_high = std::ceil(high / distance - 1e-9) * distance;
		if (m_high <= m_low)
			m_high = m_low + distance;
		for (int i = 0; m_low + i * distance <= m_high + distance / 2; ++i)
			m_ticks.push_back(m_low + i * distance);
	}
	double operator()(double value) const
	{
		const double v = m_logarithmic ? std::log10(value) : value;
		return m_from + (m_to - m_from) * (v - m_low) / (m_high - m_low);
	}
	const std::vector<double>& ticks() const { return m_ticks; }

private:
	double m_from, m_to, m_low = 0, m_high = 1;
	bool m_logarithmic;
	std::vector<double> m_ticks;
};

std::string text(double x, double y, const char* more, const std::string& words)
{
	char head[160];
	std::snprintf(head, sizeof head, "<text x=\"%.1f\" y=\"%.1f\" %s>", x, y, more);
	return head + words + "</text>\n";
}

std::string segment(double x1, double y1, double x2, double y2, const char* colour, double width)
{
	char line[200];
	std::snprintf(line, sizeof line,
				  "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"%g\"/>\n", x1, y1,
				  x2, y2, colour, width);
	return line;
}
}  // namespace

void CharpyTable::add(const std::vector<double>& row, const std::string& label)
{
	rows.push_back(row);
	labels.push_back(label);
}

std::string CharpyTable::toCsv() const
{
	std::string csv = labelColumn.empty() ? "" : labelColumn + ",";
	for (size_t c = 0; c < columns.size(); ++c)
		csv += (c > 0 ? "," : "") + columns[c];
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

std::string CharpyTable::toText() const
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

std::string CharpyTable::toSvg() const
{
	if (series.empty() || rows.empty())
		return std::string();
	double xLow = HUGE_VAL, xHigh = -HUGE_VAL, yLow = 0, yHigh = -HUGE_VAL;
	for (const auto& row : rows)
	{
		xLow = std::min(xLow, row[0]);
		xHigh = std::max(xHigh, row[0]);
		for (const Series& s : series)
			if (std::isfinite(row[s.column]))
			{
				yLow = std::min(yLow, row[s.column]);
				yHigh = std::max(yHigh, row[s.column]);
			}
	}
	// What is below zero by a hair's breadth needs no room.
	if (yLow > -0.02 * yHigh)
		yLow = 0;
	const double left = 70, right = 520, top = 50, bottom = 370, legend = 535;
	const Axis x(xLow, xHigh, left, right, logarithmic), y(yLow, yHigh, bottom, top, false);
	std::string svg =
		"<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"780\" height=\"430\" font-family=\"sans-serif\" "
		"font-size=\"12\">\n"
		"<rect width=\"780\" height=\"430\" fill=\"white\"/>\n";
	svg += text(left, 28, "font-size=\"15\"", title);
	for (double tick : x.ticks())
		svg += segment(x(tick), top, x(tick), bottom, "#dddddd", 1) +
			   text(x(tick), bottom + 18, "text-anchor=\"middle\"", number("%g", tick));
	for (double tick : y.ticks())
		svg += segment(left, y(tick), right, y(tick), "#dddddd", 1) +
			   text(left - 8, y(tick) + 4, "text-anchor=\"end\"", number("%g", tick));
	svg += text((left + right) / 2, bottom + 40, "text-anchor=\"middle\"", columns[0]);
	svg += text(18, (top + bottom) / 2, "text-anchor=\"middle\" transform=\"rotate(-90 18 210)\"", yTitle);

	// Distinct for the colour-blind, after Okabe and Ito.
	const char* const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
	for (size_t i = 0; i < series.size(); ++i)
	{
		const char* const colour = colours[i % (sizeof colours / sizeof *colours)];
		const double keyY = top + 20 * double(i) + 8;
		std::string points;
		for (const auto& row : rows)
		{
			const double value = row[series[i].column];
			if (!std::isfinite(value))
				continue;
			char place[100];
			std::snprintf(place, sizeof place,
						  series[i].line ? "%.1f,%.1f " : "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\"/>\n", x(row[0]),
						  y(value));
			points += place;
		}
		if (series[i].line)
			svg += "<polyline points=\"" + points + "\" fill=\"none\" stroke=\"" + colour +
				   "\" stroke-width=\"2\"/>\n" + segment(legend, keyY, legend + 18, keyY, colour, 2);
		else
			svg += "<g fill=\"" + std::string(colour) + "\">\n" + points + "<circle cx=\"" +
				   number("%.1f", legend + 9) + "\" cy=\"" + number("%.1f", keyY) + "\" r=\"3\"/>\n</g>\n";
		svg += text(legend + 24, keyY + 4, "", columns[series[i].column]);
	}
	return svg + "</svg>\n";
}
}  // namespace ep
