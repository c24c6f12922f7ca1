// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/DrawFigure.h"

#include <algorithm>

#include "viewer/Brush.h"

namespace ep
{
namespace
{
struct Range
{
	float low = 0, high = 0;
	bool isEmpty = true;

	void add(float value)
	{
		low = isEmpty ? value : std::min(low, value);
		high = isEmpty ? value : std::max(high, value);
		isEmpty = false;
	}
	float length() const { return std::max(high - low, 1e-12f); }
};
}  // namespace

void drawFigure(const Figure& figure, const Tile& tile)
{
	const int margin = brush::scaled(8), leastSide = brush::scaled(5);
	brush::rectangle(tile.x, tile.y, tile.width, tile.height, brush::shown({.01f, .03f, .08f}, .6f));
	Range xs, ys;
	for (const Figure::Line& line : figure.lines)
		for (const auto& [x, y] : line.points)
		{
			xs.add(x);
			ys.add(y);
		}
	for (const Figure::Square& square : figure.squares)
		for (const float way : {-.5f, .5f})
		{
			xs.add(square.x + way * square.side);
			ys.add(square.y + way * square.side);
		}
	const int width = tile.width - 2 * margin, height = tile.height - 2 * margin;
	if (xs.isEmpty || width < 1 || height < 1)
		return;
	float alongX = float(width) / xs.length(), alongY = float(height) / ys.length();
	if (figure.isTrue)
		alongX = alongY = std::min(alongX, alongY);
	const float middleX = float(tile.x) + float(tile.width) / 2, middleY = float(tile.y) + float(tile.height) / 2;
	const auto px = [&](float x) { return middleX + alongX * (x - (xs.low + xs.high) / 2); };
	const auto py = [&](float y) { return middleY - alongY * (y - (ys.low + ys.high) / 2); };

	const unsigned axis = brush::shown({1, 1, 1}, .2f);
	if (!figure.xName.empty())
	{
		brush::rectangle(tile.x + margin, int(py(0)), width, 1, axis);
		brush::write(tile.x + tile.width - margin - brush::textWidth(figure.xName), int(py(0)) - brush::scaled(4),
					 figure.xName);
	}
	if (!figure.yName.empty())
	{
		brush::rectangle(int(px(0)), tile.y + margin, 1, height, axis);
		brush::write(int(px(0)) + brush::scaled(4), tile.y + margin + brush::scaled(12), figure.yName);
	}
	for (const Figure::Square& square : figure.squares)
	{
		const int side = std::max(leastSide, int(alongX * square.side) - 1);
		brush::rectangle(int(px(square.x)) - side / 2, int(py(square.y)) - side / 2, side, side,
						 brush::shown(square.colour, 1));
	}
	for (const Figure::Line& line : figure.lines)
	{
		std::vector<std::pair<float, float>> points;
		for (const auto& [x, y] : line.points)
			points.emplace_back(px(x), py(y));
		brush::line(points, brush::shown(line.colour, 1));
	}
}
}  // namespace ep
