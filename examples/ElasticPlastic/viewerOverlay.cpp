#include "viewerOverlay.h"

#include <algorithm>

#include "viewerBrush.h"
#include "viewerChart.h"

namespace ep
{
namespace
{
const int LINE = 23, MARGIN = 12, SWATCH = 16;

int widest(const std::vector<std::string>& lines)
{
	int width = 0;
	for (const std::string& line : lines)
		width = std::max(width, brush::textWidth(line));
	return width;
}

void writeLines(int x, int y, const std::vector<std::string>& lines)
{
	brush::panel(x, y, widest(lines) + 2 * MARGIN, int(lines.size()) * LINE + MARGIN);
	for (size_t i = 0; i < lines.size(); ++i)
		brush::write(x + MARGIN, y + int(i + 1) * LINE, lines[i]);
}

void writeLegend(const std::vector<Drawing::Key>& legend, int height)
{
	int width = MARGIN;
	for (const Drawing::Key& key : legend)
		width += SWATCH + 6 + brush::textWidth(key.text) + 18;
	const int y = height - LINE - 2 * MARGIN;
	brush::panel(MARGIN, y, width, LINE + MARGIN);
	int x = 2 * MARGIN;
	for (const Drawing::Key& key : legend)
	{
		brush::colour(key.colour);
		brush::rectangle(x, y + (LINE + MARGIN - SWATCH) / 2, SWATCH, SWATCH);
		brush::write(x + SWATCH + 6, y + LINE, key.text);
		x += SWATCH + 6 + brush::textWidth(key.text) + 18;
	}
}
}  // namespace

void drawOverlay(const Overlay& overlay, const ViewerLayout& layout, int width, int height)
{
	brush::begin(width, height);
	const Drawing& drawing = overlay.drawing;
	writeLines(MARGIN, MARGIN, drawing.text);
	if (!drawing.legend.empty())
		writeLegend(drawing.legend, height);
	if (!drawing.chart.bands.empty())
	{
		const Tile& c = layout.chart;
		drawChart(drawing.chart, {c.x, height - c.y - c.height, c.width, c.height});
	}
	if (!overlay.help.empty())
		writeLines(width - widest(overlay.help) - 3 * MARGIN, MARGIN, overlay.help);
	if (!overlay.note.empty())
		writeLines((width - brush::textWidth(overlay.note)) / 2 - MARGIN, MARGIN, {overlay.note});
}
}  // namespace ep
