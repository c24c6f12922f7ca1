#ifndef EP_VIEWER_H
#define EP_VIEWER_H

#include <string>

#include "ViewedScene.h"

namespace ep
{
struct ViewerOptions
{
	int width = 1280, height = 720;
	std::string camera;         ///< to begin with: chase, free or side; empty: the scene's own, or chase
	std::string screenshot;     ///< a PNG to save and then end; empty: run until the window is closed
	double screenshotTime = 9;  ///< simulated time to run before [s]
};

/// Shows a scene in a window and lets a person drive, until the window is closed. Throws std::runtime_error.
void runViewer(ViewedScene& scene, const ViewerOptions& options);
}  // namespace ep

#endif  // EP_VIEWER_H
