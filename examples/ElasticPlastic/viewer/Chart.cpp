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
/// From 0 to a round number, with a handful of ticks.
struct Scale
{
	Scale(float most, int ticks) : step(float(roundUp(std::max(most, 1e-6f) / float(ticks))))
	{
		end = step * std::ceil(most / step + 1e-3f);
	}

	float step, end;
};

std::string number(float value)
{
	char text[32];
	std::snprintf(text, sizeof text, "%g", double(value));
	return text;
}

/// Sums from below: the first is 0, each further one the upper edge of a band.
std::vector<std::vector<float>> edges(const Chart& chart)
{
	std::vector<std::vector<float>> all(1, std::vector<float>(chart.x.size(), 0));
	for (const Chart::Band& band : chart.bands)
	{
		all.push_back(all.back());
		for (size_t i = 0; i < chart.x.size(); ++i)
			all.back()[i] += std::max(0.f, band.values[i]);
	}
	return all;
}
}  // namespace

void drawChart(const Chart& chart, const Tile& tile)
{
	const int left = brush::scaled(52), right = brush::scaled(40), top = brush::scaled(36), bottom = brush::scaled(32),
			  tickText = brush::scaled(6);
	brush::panel(tile.x, tile.y, tile.width, tile.height);
	brush::write(tile.x + left, tile.y + top - brush::scaled(12), chart.title);
	const int width = tile.width - left - right, height = tile.height - top - bottom;
	if (chart.x.empty() || width < 1 || height < 1)
		return;

	const std::vector<std::vector<float>> sums = edges(chart);
	const Scale xs(chart.x.back(), 4), ys(*std::max_element(sums.back().begin(), sums.back().end()), 4);
	const auto px = [&](float x) { return float(tile.x + left) + x / xs.end * float(width); };
	const auto py = [&](float y) { return float(tile.y + top + height) - y / ys.end * float(height); };

	for (size_t band = 0; band < chart.bands.size(); ++band)
	{
		const unsigned colour = brush::shown(chart.bands[band].colour, 1);
		for (size_t i = 0; i + 1 < chart.x.size(); ++i)
			brush::strip(px(chart.x[i]), py(sums[band + 1][i]), py(sums[band][i]), px(chart.x[i + 1]),
						 py(sums[band + 1][i + 1]), py(sums[band][i + 1]), colour);
	}
	for (float y = 0; y <= ys.end * 1.001f; y += ys.step)
	{
		brush::rectangle(int(px(0)), int(py(y)), width, 1, brush::shown({1, 1, 1}, .25f));
		brush::write(int(px(0)) - tickText - brush::textWidth(number(y)), int(py(y)) + tickText, number(y));
	}
	for (float x = 0; x <= xs.end * 1.001f; x += xs.step)
	{
		const std::string text = number(x) + (x + xs.step > xs.end * 1.001f ? " " + chart.xUnit : "");
		brush::write(int(px(x)) - brush::textWidth(text) / 2, int(py(0)) + brush::scaled(22), text);
	}
}

void drawHistory(const Panel::Curve& curve, const Tile& tile)
{
	const std::vector<float>& values = curve.values;
	const float limit = float(curve.limit);
	float low = 0, high = 0;
	for (float value : values)
		if (std::isfinite(value))
		{
			low = std::min(low, value);
			high = std::max(high, value);
		}
	// The limit is in the picture as soon as half of it is reached.
	if (limit > 0 && high > limit / 2)
		high = std::max(high, limit * 1.05f);
	if (limit > 0 && low < -limit / 2)
		low = std::min(low, -limit * 1.05f);
	if (high == low)
		high = 1;
	const float step = float(roundUp(double(high - low) / 3));
	low = step * std::floor(low / step + 1e-3f);
	high = std::max(step * std::ceil(high / step - 1e-3f), low + step);

	brush::rectangle(tile.x, tile.y, tile.width, tile.height, brush::shown({.01f, .03f, .08f}, .6f));
	const int tickText = brush::scaled(6);
	int left = 0;
	for (float y = low; y <= high + step / 2; y += step)
		left = std::max(left, brush::textWidth(number(std::fabs(y) < step / 2 ? 0 : y)) + 2 * tickText);
	const int right = tickText, top = brush::scaled(8), bottom = brush::scaled(20);
	const int width = tile.width - left - right, height = tile.height - top - bottom;
	if (width < 1 || height < 1)
		return;
	const float leastLength = 1;  // [s]
	const float length = std::max(leastLength, float(curve.step) * float(values.size()));
	const auto px = [&](float time) { return float(tile.x + left) + (1 + time / length) * float(width); };
	const auto py = [&](float y) { return float(tile.y + top) + (high - y) / (high - low) * float(height); };

	const unsigned grid = brush::shown({1, 1, 1}, .2f);
	for (float y = low; y <= high + step / 2; y += step)
	{
		const std::string text = number(std::fabs(y) < step / 2 ? 0 : y);
		brush::rectangle(tile.x + left, int(py(y)), width, 1, grid);
		brush::write(tile.x + left - tickText - brush::textWidth(text), int(py(y)) + tickText, text);
	}
	const float tick = float(roundUp(double(length) / 4));
	for (float time = 0; time >= -length * 1.001f; time -= tick)
	{
		const std::string text = time == 0 ? "now" : number(time) + " s";
		const int x = int(px(time));
		brush::rectangle(x, tile.y + top, 1, height, grid);
		const int textX = std::min(x - brush::textWidth(text) / 2, tile.x + tile.width - brush::textWidth(text));
		brush::write(std::max(tile.x, textX), tile.y + tile.height - brush::scaled(5), text);
	}
	for (float side : {-1.f, 1.f})
		if (limit > 0 && side * limit > low && side * limit < high)
			brush::rectangle(tile.x + left, int(py(side * limit)), width, std::max(1, brush::scaled(2)),
							 brush::shown({.8f, .02f, .02f}, .8f));
	std::vector<std::pair<float, float>> points;
	for (size_t i = 0; i < values.size(); ++i)
		if (std::isfinite(values[i]))
			points.emplace_back(px(float(curve.step) * (float(i) + 1 - float(values.size()))), py(values[i]));
	brush::line(points, brush::shown({.8f, .8f, .8f}, 1));
}
}  // namespace ep
