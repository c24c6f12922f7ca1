// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_OVERLAY_H
#define EP_VIEWER_OVERLAY_H

#include "drawing/Drawing.h"
#include "viewer/Layout.h"

namespace ep
{
/// What is written over a picture.
struct Overlay
{
	const Drawing& drawing;  ///< its text, legend and chart
	std::vector<std::string> help;
	std::string note;  ///< in the middle

	/// From the lower edge to what is above the legend, and from the upper edge to what is below the text [pixels].
	static int legendHeight();
	static int textHeight(size_t lines);
};

void drawOverlay(const Overlay& overlay, const Layout& layout, int width, int height);
}  // namespace ep

#endif  // EP_VIEWER_OVERLAY_H
