// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_FIGURE_H
#define EP_FIGURE_H

#include <string>
#include <utility>
#include <vector>

#include "drawing/Drawing.h"

namespace ep
{
/// A flat picture in units of its own: lines, and squares upon them.
struct Figure
{
	struct Line
	{
		std::vector<std::pair<float, float>> points;
		Colour colour;
	};
	struct Square
	{
		float x, y, side;  ///< side 0: as small as can be seen
		Colour colour;
	};

	std::string title, xName, yName;  ///< of axes through zero; empty: none
	bool isTrue = false;              ///< as large along x as along y
	std::vector<Line> lines;
	std::vector<Square> squares;
};
}  // namespace ep

#endif  // EP_FIGURE_H
