// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PLOT_H
#define EP_PLOT_H

#include <string>
#include <utility>
#include <vector>

namespace ep
{
/// Curves over an axis, drawn as SVG: stands in a page as it is, and needs nothing to be seen.
struct Plot
{
	enum Style
	{
		SOLID,  ///< with a mark at each point if they are few
		DASHED,
		DOTTED,
		JOINED,  ///< marks, and a thin line from each to the next
		MARKS,   ///< no line
		RINGS    ///< the same, larger and open
	};
	struct Curve
	{
		std::string m_name;  ///< without one the legend leaves it out
		std::vector<std::pair<double, double>> m_points;
		Style m_style = SOLID;
		int m_color = -1;                      ///< of the palette, -1: the next one
		std::vector<std::string> m_tips = {};  ///< per point, shown under the mouse; may be empty
	};

	std::string m_title, m_xLabel, m_yLabel;
	bool m_logX = false, m_logY = false;  ///< then points that are not greater than 0 are left out
	bool m_fromZero = false;              ///< y begins at 0, unless it goes far below
	std::vector<Curve> m_curves;

	std::string svg() const;
};

/// The next of 1, 2, 5 times a power of ten that is not smaller: a distance of ticks.
double roundUp(double value);
}  // namespace ep

#endif  // EP_PLOT_H
