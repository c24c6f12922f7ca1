// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/Overlay.h"

#include <algorithm>

#include "viewer/Brush.h"
#include "viewer/Chart.h"

namespace ep
{
namespace
{
int line() { return brush::scaled(23); }
int margin() { return brush::scaled(12); }
int swatch() { return brush::scaled(16); }

int widest(const std::vector<std::string>& lines)
{
	int width = 0;
	for (const std::string& line : lines)
		width = std::max(width, brush::textWidth(line));
	return width;
}

void writeLines(int x, int y, const std::vector<std::string>& lines)
{
	brush::panel(x, y, widest(lines) + 2 * margin(), int(lines.size()) * line() + margin());
	for (size_t i = 0; i < lines.size(); ++i)
		brush::write(x + margin(), y + int(i + 1) * line(), lines[i]);
}

void writeLegend(const std::vector<Drawing::Key>& legend, int height)
{
	int width = margin();
	for (const Drawing::Key& key : legend)
		width += swatch() + 6 + brush::textWidth(key.text) + 18;
	const int y = height - Overlay::legendHeight();
	brush::panel(margin(), y, width, line() + margin());
	int x = 2 * margin();
	for (const Drawing::Key& key : legend)
	{
		brush::rectangle(x, y + (line() + margin() - swatch()) / 2, swatch(), swatch(), brush::shown(key.colour, 1));
		brush::write(x + swatch() + 6, y + line(), key.text);
		x += swatch() + 6 + brush::textWidth(key.text) + 18;
	}
}
}  // namespace

int Overlay::legendHeight() { return line() + 2 * margin(); }
int Overlay::textHeight(size_t lines) { return lines > 0 ? int(lines) * line() + 2 * margin() : 0; }

void drawOverlay(const Overlay& overlay, const Layout& layout, int width, int height)
{
	const Drawing& drawing = overlay.drawing;
	if (!drawing.text.empty())
		writeLines(margin(), margin(), drawing.text);
	if (!drawing.legend.empty())
		writeLegend(drawing.legend, height);
	if (!drawing.chart.bands.empty())
	{
		const Tile& c = layout.chart;
		drawChart(drawing.chart, {c.x, height - c.y - c.height, c.width, c.height});
	}
	if (!overlay.help.empty())
		writeLines(width - widest(overlay.help) - 3 * margin(), margin(), overlay.help);
	if (!overlay.note.empty())
		writeLines((width - brush::textWidth(overlay.note)) / 2 - margin(), margin(), {overlay.note});
}
}  // namespace ep
