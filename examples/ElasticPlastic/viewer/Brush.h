// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_BRUSH_H
#define EP_VIEWER_BRUSH_H

#include <string>
#include <utility>
#include <vector>

#include "drawing/Drawing.h"

namespace ep
{
/// Flat things over a picture and under panels, within a frame of the Gui. Pixels from the window's top left corner.
namespace brush
{
/// As long as it lives, they are drawn into the panel at hand.
struct InPanel
{
	InPanel();
	~InPanel();
	InPanel(const InPanel&) = delete;
	InPanel& operator=(const InPanel&) = delete;
};

/// As it looks in the picture, 32 bits for Dear ImGui.
unsigned shown(const Colour& linearLight, float alpha);

/// A length made for text of 18 pixels, for the text that there is.
int scaled(int length);

void rectangle(int x, int y, int width, int height, unsigned colour);
/// Its left and right sides are upright: x, top and bottom of each.
void strip(float left, float leftTop, float leftBottom, float right, float rightTop, float rightBottom,
		   unsigned colour);
/// As wide as text wants it.
void line(const std::vector<std::pair<float, float>>& points, unsigned colour);
/// Darkens what is behind writing.
void panel(int x, int y, int width, int height);
/// \param y  of the line the letters stand on
void write(int x, int y, const std::string& text);
int textWidth(const std::string& text);
}  // namespace brush
}  // namespace ep

#endif  // EP_VIEWER_BRUSH_H
