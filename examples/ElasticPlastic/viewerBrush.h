#ifndef EP_VIEWER_BRUSH_H
#define EP_VIEWER_BRUSH_H

#include <string>

#include "Drawing.h"

namespace ep
{
/// Flat things over a picture. Pixels from the window's top left corner.
namespace brush
{
void begin(int width, int height);

void colour(const Colour& linearLight);
void rectangle(int x, int y, int width, int height);
/// Darkens what is behind writing.
void panel(int x, int y, int width, int height);
void write(int x, int y, const std::string& text);
int textWidth(const std::string& text);
}  // namespace brush
}  // namespace ep

#endif  // EP_VIEWER_BRUSH_H
