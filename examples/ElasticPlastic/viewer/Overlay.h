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
};

void drawOverlay(const Overlay& overlay, const Layout& layout, int width, int height);
}  // namespace ep

#endif  // EP_VIEWER_OVERLAY_H
