#include "viewerOverlay.h"

#include <algorithm>
#include <cmath>

#include "viewerGl.h"

namespace ep
{
namespace
{
const int LINE = 23, MARGIN = 12, SWATCH = 16;
void* const FONT = GLUT_BITMAP_HELVETICA_18;

int textWidth(const std::string& text)
{
	return glutBitmapLength(FONT, reinterpret_cast<const unsigned char*>(text.c_str()));
}

int textWidth(const std::vector<std::string>& lines)
{
	int width = 0;
	for (const std::string& line : lines)
		width = std::max(width, textWidth(line));
	return width;
}

/// Pixels from the window's top left corner.
void rectangle(int x, int y, int width, int height)
{
	glBegin(GL_QUADS);
	glVertex2i(x, y);
	glVertex2i(x, y + height);
	glVertex2i(x + width, y + height);
	glVertex2i(x + width, y);
	glEnd();
}

void panel(int x, int y, int width, int height)
{
	glColor4f(.04f, .06f, .09f, .62f);
	rectangle(x, y, width, height);
}

void write(int x, int y, const std::string& text)
{
	glColor3f(.96f, .97f, .98f);
	glRasterPos2i(x, y);
	glutBitmapString(FONT, reinterpret_cast<const unsigned char*>(text.c_str()));
}

void writeLines(int x, int y, const std::vector<std::string>& lines)
{
	panel(x, y, textWidth(lines) + 2 * MARGIN, int(lines.size()) * LINE + MARGIN);
	for (size_t i = 0; i < lines.size(); ++i)
		write(x + MARGIN, y + int(i + 1) * LINE, lines[i]);
}

void writeLegend(const std::vector<Drawing::Key>& legend, int height)
{
	int width = MARGIN;
	for (const Drawing::Key& key : legend)
		width += SWATCH + 6 + textWidth(key.text) + 18;
	const int y = height - LINE - 2 * MARGIN;
	panel(MARGIN, y, width, LINE + MARGIN);
	int x = 2 * MARGIN;
	for (const Drawing::Key& key : legend)
	{
		const auto shown = [](float light) { return std::pow(std::min(1.f, light * 1.3f), 1 / 2.2f); };
		glColor3f(shown(key.colour.r), shown(key.colour.g), shown(key.colour.b));
		rectangle(x, y + (LINE + MARGIN - SWATCH) / 2, SWATCH, SWATCH);
		write(x + SWATCH + 6, y + LINE, key.text);
		x += SWATCH + 6 + textWidth(key.text) + 18;
	}
}
}  // namespace

void drawOverlay(const Drawing& drawing, const std::vector<std::string>& help, const std::string& note, int width,
				 int height)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glOrtho(0, width, height, 0, -1, 1);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);

	writeLines(MARGIN, MARGIN, drawing.text);
	if (!drawing.legend.empty())
		writeLegend(drawing.legend, height);
	if (!help.empty())
		writeLines(width - textWidth(help) - 3 * MARGIN, MARGIN, help);
	if (!note.empty())
		writeLines((width - textWidth(note)) / 2 - MARGIN, MARGIN, {note});
}
}  // namespace ep
