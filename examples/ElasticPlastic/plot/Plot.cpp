// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "plot/Plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "text/Markup.h"

namespace ep
{
namespace
{
/// Told apart by people with any colour vision (Okabe and Ito).
const char* const COLORS[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#666666",
							  "#000000", "#8c564b", "#b5bd00", "#9467bd", "#004d40", "#a50026"};
const int NUM_COLORS = int(sizeof COLORS / sizeof *COLORS);

const double WIDTH = 900, HEIGHT = 420, LEFT = 74, RIGHT = 290, TOP = 44, BOTTOM = 58;

std::string number(double value)
{
	char text[32];
	snprintf(text, sizeof text, value >= 1e4 && value < 1e7 ? "%.0f" : "%.4g", value);
	return text;
}

/// The next of 1, 2, 5 times a power of ten that is not greater.
double roundDown(double value)
{
	const double power = std::pow(10, std::floor(std::log10(value) + 1e-9));
	for (const double digit : {5., 2.})
		if (digit * power < value * (1 + 1e-9))
			return digit * power;
	return power;
}

/// From values to pixels, with ticks where people expect them.
class Axis
{
public:
	Axis(bool isLog, double begin, double end) : m_isLog(isLog), m_begin(begin), m_end(end) {}

	/// Values below zero by a hair's breadth need no room.
	void beginAtZero()
	{
		include(0);
		if (m_low > -0.02 * m_high)
			m_low = 0;
	}

	void include(double value)
	{
		if (!accepts(value))
			return;
		m_low = m_isEmpty ? value : std::min(m_low, value);
		m_high = m_isEmpty ? value : std::max(m_high, value);
		m_isEmpty = false;
	}
	bool accepts(double value) const { return std::isfinite(value) && (!m_isLog || value > 0); }

	/// Widens the range to whole ticks.
	void settle()
	{
		if (m_isLog)
		{
			m_low = roundDown(m_low);
			m_high = std::max(roundUp(m_high), roundUp(m_low * 1.1));
			const bool isFine = m_high < 500 * m_low;
			for (double t = m_low; t < m_high * 1.001; t = roundUp(t * 1.1))
				if (isFine || std::fabs(std::log10(t) - std::round(std::log10(t))) < 1e-6)
					m_ticks.push_back(t);
			return;
		}
		if (m_high <= m_low)
			m_high = m_low + 1;
		const double raw = (m_high - m_low) / 6, power = std::pow(10, std::floor(std::log10(raw)));
		const double step = power * (raw / power > 5 ? 10 : raw / power > 2 ? 5 : raw / power > 1 ? 2 : 1);
		m_low = step * std::floor(m_low / step + 1e-9);
		m_high = step * std::ceil(m_high / step - 1e-9);
		for (int i = 0; m_low + i * step < m_high + step / 2; ++i)
			m_ticks.push_back(std::fabs(m_low + i * step) < step * 1e-9 ? 0 : m_low + i * step);
	}

	double at(double value) const
	{
		const double share =
			m_isLog ? std::log(value / m_low) / std::log(m_high / m_low) : (value - m_low) / (m_high - m_low);
		return m_begin + share * (m_end - m_begin);
	}
	const std::vector<double>& ticks() const { return m_ticks; }

private:
	bool m_isLog, m_isEmpty = true;
	double m_begin, m_end, m_low = 1, m_high = 10;
	std::vector<double> m_ticks;
};

void text(std::ostream& out, double x, double y, const char* anchor, const std::string& what, const char* more = "")
{
	out << "<text x=\"" << number(x) << "\" y=\"" << number(y) << "\" text-anchor=\"" << anchor << "\"" << more << ">"
		<< escaped(what) << "</text>\n";
}

void line(std::ostream& out, double x0, double y0, double x1, double y1, const char* color)
{
	out << "<line x1=\"" << number(x0) << "\" y1=\"" << number(y0) << "\" x2=\"" << number(x1) << "\" y2=\""
		<< number(y1) << "\" stroke=\"" << color << "\"/>\n";
}
}  // namespace

double roundUp(double value)
{
	const double power = std::pow(10, std::floor(std::log10(value) + 1e-9));
	for (const double digit : {1., 2., 5.})
		if (digit * power > value * (1 - 1e-9))
			return digit * power;
	return 10 * power;
}

std::string Plot::svg() const
{
	Axis x(m_logX, LEFT, WIDTH - RIGHT), y(m_logY, HEIGHT - BOTTOM, TOP);
	for (const Curve& curve : m_curves)
		for (const auto& point : curve.m_points)
			if (x.accepts(point.first) && y.accepts(point.second))
			{
				x.include(point.first);
				y.include(point.second);
			}
	if (m_fromZero)
		y.beginAtZero();
	x.settle();
	y.settle();

	std::ostringstream out;
	out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << WIDTH << " " << HEIGHT
		<< "\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">\n"
		<< "<rect width=\"" << WIDTH << "\" height=\"" << HEIGHT << "\" fill=\"#fff\"/>\n";
	text(out, LEFT, 24, "start", m_title, " font-size=\"16\" font-weight=\"bold\"");
	for (const double tick : x.ticks())
	{
		line(out, x.at(tick), TOP, x.at(tick), HEIGHT - BOTTOM, "#e4e4e4");
		text(out, x.at(tick), HEIGHT - BOTTOM + 19, "middle", number(tick));
	}
	for (const double tick : y.ticks())
	{
		line(out, LEFT, y.at(tick), WIDTH - RIGHT, y.at(tick), "#e4e4e4");
		text(out, LEFT - 8, y.at(tick) + 4, "end", number(tick));
	}
	line(out, LEFT, HEIGHT - BOTTOM, WIDTH - RIGHT, HEIGHT - BOTTOM, "#222");
	line(out, LEFT, TOP, LEFT, HEIGHT - BOTTOM, "#222");
	text(out, (LEFT + WIDTH - RIGHT) / 2, HEIGHT - 14, "middle", m_xLabel);
	const std::string turn = " transform=\"rotate(-90 18 " + number((TOP + HEIGHT - BOTTOM) / 2) + ")\"";
	text(out, 18, (TOP + HEIGHT - BOTTOM) / 2, "middle", m_yLabel, turn.c_str());

	int next = 0;
	double legend = TOP + 10;
	for (const Curve& curve : m_curves)
	{
		const char* const color = COLORS[(curve.m_color < 0 ? next++ : curve.m_color) % NUM_COLORS];
		const char* const dash = curve.m_style == DASHED   ? " stroke-dasharray=\"7 4\""
								 : curve.m_style == DOTTED ? " stroke-dasharray=\"2 3\""
														   : "";
		const bool isJoined = curve.m_style == JOINED;
		const bool hasLine = curve.m_style != MARKS && curve.m_style != RINGS;
		if (hasLine)
		{
			out << "<polyline fill=\"none\" stroke=\"" << color << "\" stroke-width=\"" << (isJoined ? 1 : 2) << "\""
				<< (isJoined ? " stroke-opacity=\".5\"" : dash) << " points=\"";
			for (const auto& point : curve.m_points)
				if (x.accepts(point.first) && y.accepts(point.second))
					out << number(x.at(point.first)) << "," << number(y.at(point.second)) << " ";
			out << "\"/>\n";
		}
		const bool hasMarks = !hasLine || isJoined || (curve.m_style == SOLID && curve.m_points.size() < 40);
		for (size_t i = 0; hasMarks && i < curve.m_points.size(); ++i)
		{
			const auto& point = curve.m_points[i];
			if (!x.accepts(point.first) || !y.accepts(point.second))
				continue;
			out << "<circle cx=\"" << number(x.at(point.first)) << "\" cy=\"" << number(y.at(point.second)) << "\"";
			if (curve.m_style == RINGS)
				out << " r=\"6\" fill=\"none\" stroke=\"" << color << "\" stroke-width=\"1.5\"";
			else
				out << " r=\"3\" fill=\"" << color << "\"";
			if (i < curve.m_tips.size())
				out << "><title>" << escaped(curve.m_tips[i]) << "</title></circle>\n";
			else
				out << "/>\n";
		}
		if (curve.m_name.empty())
			continue;
		if (!hasLine || isJoined)
			out << "<circle cx=\"" << WIDTH - RIGHT + 28 << "\" cy=\"" << legend - 4
				<< (curve.m_style == RINGS ? "\" r=\"6\" fill=\"none\" stroke=\"" : "\" r=\"4\" fill=\"") << color
				<< "\"/>\n";
		else
			out << "<line x1=\"" << WIDTH - RIGHT + 14 << "\" y1=\"" << legend - 4 << "\" x2=\"" << WIDTH - RIGHT + 42
				<< "\" y2=\"" << legend - 4 << "\" stroke=\"" << color << "\" stroke-width=\"2\"" << dash << "/>\n";
		text(out, WIDTH - RIGHT + 50, legend, "start", curve.m_name);
		legend += 19;
	}
	out << "</svg>\n";
	return out.str();
}
}  // namespace ep
