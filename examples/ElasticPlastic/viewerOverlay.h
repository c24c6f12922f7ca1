#ifndef EP_VIEWER_OVERLAY_H
#define EP_VIEWER_OVERLAY_H

#include "Drawing.h"

namespace ep
{
/// Writes over the picture: the drawing's text and legend, the help, and a note in the middle.
void drawOverlay(const Drawing& drawing, const std::vector<std::string>& help, const std::string& note, int width,
				 int height);
}  // namespace ep

#endif  // EP_VIEWER_OVERLAY_H
