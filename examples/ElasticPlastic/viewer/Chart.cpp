// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/Chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plot/Plot.h"
#include "viewer/Brush.h"

namespace ep
{
namespace
{
/// Between round numbers, with a handful of ticks.
struct Axis
{
	Axis(float least, float most, int ticks)
		: step(float(roundUp(std::max(double(most) - double(least), 1e-6) / ticks))),
		  low(step * std::floor(least / step + 1e-3f)),
		  high(std::max(step * std::ceil(most / step - 1e-3f), low + step))
	{
	}

	int ticks() const { return int((high - low) / step + 1.5f); }
	float tick(int i) const { return low + float(i) * step; }
	float share(float value) const { return (value - low) / (high - low); }

	std::string text(int i) const
	{
		char text[32];
		std::snprintf(text, sizeof text, "%g", std::round(double(tick(i)) / double(step)) * double(step));
		return text;
	}

	float step, low, high;
};

/// Sums from below: the first is 0, each further one the upper edge of a band.
std::vector<std::vector<float>> edges(const Chart& chart)
{
	std::vector<std::vector<float>> all(1, std::vector<float>(chart.x.size(), 0));
	for (const Chart::Series& band : chart.bands)
	{
		all.push_back(all.back());
		for (size_t i = 0; i < chart.x.size(); ++i)
			all.back()[i] += std::max(0.f, band.values[i]);
	}
	return all;
}

Axis upright(const Chart& chart, const std::vector<float>& top)
{
	float low = 0, high = 0;
	const auto add = [&](float value)
	{
		if (!std::isfinite(value))
			return;
		low = std::min(low, value);
		high = std::max(high, value);
	};
	for (float value : top)
		add(value);
	for (const Chart::Series& line : chart.lines)
		for (float value : line.values)
			add(value);
	for (float side : {-1.f, 1.f})
		if ((side < 0 ? -low : high) > chart.limit / 2)
			add(side * 1.05f * chart.limit);
	return Axis(low, low == high ? 1 : high, chart.bands.empty() ? 3 : 4);
}

/// The part of a tile in which lines are, between the axes.
struct Field
{
	Axis xs, ys;
	int left, top, width, height;

	float px(float x) const { return float(left) + xs.share(x) * float(width); }
	float py(float y) const { return float(top) + (1 - ys.share(y)) * float(height); }
};

void drawGrid(const Field& f, const std::string& unit, const Tile& tile)
{
	const unsigned grid = brush::shown({1, 1, 1}, .2f);
	const int gap = brush::scaled(6);
	for (int i = 0; i < f.ys.ticks(); ++i)
	{
		const int y = int(f.py(f.ys.tick(i)));
		brush::rectangle(f.left, y, f.width, 1, grid);
		brush::write(f.left - gap - brush::textWidth(f.ys.text(i)), y + gap, f.ys.text(i));
	}
	for (int i = 0; i < f.xs.ticks(); ++i)
	{
		const std::string text = f.xs.text(i) + (i + 1 == f.xs.ticks() ? " " + unit : "");
		const int x = int(f.px(f.xs.tick(i))), width = brush::textWidth(text);
		brush::rectangle(x, f.top, 1, f.height, grid);
		brush::write(std::max(tile.x, std::min(x - width / 2, tile.x + tile.width - width)),
					 f.top + f.height + brush::scaled(16), text);
	}
}
}  // namespace

void drawChart(const Chart& chart, const Tile& tile)
{
	brush::rectangle(tile.x, tile.y, tile.width, tile.height, brush::shown({.01f, .03f, .08f}, .6f));
	const int gap = brush::scaled(8), bottom = brush::scaled(22), title = chart.title.empty() ? 0 : brush::scaled(24);
	brush::write(tile.x + gap, tile.y + brush::scaled(20), chart.title);
	if (chart.x.empty())
		return;
	const std::vector<std::vector<float>> sums = edges(chart);
	const Axis xs(std::min(0.f, chart.x.front()), std::max(0.f, chart.x.back()), 4), ys = upright(chart, sums.back());
	int left = 0;
	for (int i = 0; i < ys.ticks(); ++i)
		left = std::max(left, brush::textWidth(ys.text(i)) + 2 * gap);
	const Field f = {
		xs, ys, tile.x + left, tile.y + title + gap, tile.width - left - 2 * gap, tile.height - title - gap - bottom};
	if (f.width < 1 || f.height < 1)
		return;

	for (size_t band = 0; band < chart.bands.size(); ++band)
	{
		const unsigned colour = brush::shown(chart.bands[band].colour, 1);
		for (size_t i = 0; i + 1 < chart.x.size(); ++i)
			brush::strip(f.px(chart.x[i]), f.py(sums[band + 1][i]), f.py(sums[band][i]), f.px(chart.x[i + 1]),
						 f.py(sums[band + 1][i + 1]), f.py(sums[band][i + 1]), colour);
	}
	drawGrid(f, chart.xUnit, tile);
	for (float side : {-1.f, 1.f})
		if (chart.limit > 0 && side * chart.limit > ys.low && side * chart.limit < ys.high)
			brush::rectangle(f.left, int(f.py(side * chart.limit)), f.width, std::max(1, brush::scaled(2)),
							 brush::shown({.8f, .02f, .02f}, .8f));
	for (const Chart::Series& line : chart.lines)
	{
		std::vector<std::pair<float, float>> points;
		for (size_t i = 0; i < chart.x.size(); ++i)
			if (std::isfinite(line.values[i]))
				points.emplace_back(f.px(chart.x[i]), f.py(line.values[i]));
		brush::line(points, brush::shown(line.colour, 1));
	}
}
}  // namespace ep
