#include "viewerBrush.h"

#include <algorithm>
#include <cmath>

#include "viewerGl.h"

namespace ep
{
namespace brush
{
namespace
{
void* const FONT = GLUT_BITMAP_HELVETICA_18;
}

void begin(int width, int height)
{
	glViewport(0, 0, width, height);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glOrtho(0, width, height, 0, -1, 1);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

void colour(const Colour& linearLight)
{
	const auto shown = [](float light) { return std::pow(std::min(1.f, light * 1.3f), 1 / 2.2f); };
	glColor3f(shown(linearLight.r), shown(linearLight.g), shown(linearLight.b));
}

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

int textWidth(const std::string& text)
{
	return glutBitmapLength(FONT, reinterpret_cast<const unsigned char*>(text.c_str()));
}
}  // namespace brush
}  // namespace ep
