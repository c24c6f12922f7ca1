// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_H
#define EP_VIEWER_H

#include <string>

#include "drawing/ViewedScene.h"

namespace ep
{
struct ViewerOptions
{
	int width = 1280, height = 720;
	std::string camera;         ///< to begin with: chase, free or side; empty: the scene's own, or chase
	std::string screenshot;     ///< a PNG to save and then end; empty: run until the window is closed
	double screenshotTime = 9;  ///< simulated time to run before [s]
	std::string record;         ///< a film to make and then end, a picture every sixtieth of a second; empty: none
	double recordTime = 20;     ///< its length [s]
	float textSize = 0;         ///< of a line [pixels]; 0: by the screen's resolution
	bool panel = true;          ///< shown from the beginning, where the scene has one
};

/// Shows a scene in a window and lets a person drive, until the window is closed. Throws std::runtime_error.
void runViewer(ViewedScene& scene, const ViewerOptions& options);
}  // namespace ep

#endif  // EP_VIEWER_H
