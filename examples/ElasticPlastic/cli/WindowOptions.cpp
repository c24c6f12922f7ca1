// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "cli/WindowOptions.h"

#include "cli/CommandLine.h"

namespace ep
{
namespace
{
const std::vector<Named<WindowCamera>>& windowCameras()
{
	static const std::vector<Named<WindowCamera>> all = {{"own", WindowCamera::Own},
														 {"chase", WindowCamera::Chase},
														 {"free", WindowCamera::Free},
														 {"side", WindowCamera::Side}};
	return all;
}
}  // namespace

void addWindowOptions(CommandLine& line, WindowOptions& o)
{
	line.add("--screenshot", o.screenshot, "Open the window, save a PNG of it, and end");
	line.add("--after", o.screenshotTime, "Simulated time of the screenshot [s]").within(0, 3600).showDefault();
	line.add("--record", o.record, "Open the window, make a film (MP4) of it, --seconds long, and end");
	line.add("--seconds", o.recordTime, "Length of the film [s]").within(0.1, 36000).showDefault();
	line.addNamed("--camera", o.camera,
				  "Camera that the window begins with; own: the scene's, else chase of what is driven, else side",
				  windowCameras());
	line.addPair("--size", o.width, o.height, "Of the window, width and height [pixels]")
		.within(100, 16384)
		.showDefault(std::to_string(o.width) + " " + std::to_string(o.height));
	line.add("--text-size", o.textSize, "Height of the window's text [pixels], 0: by the screen's resolution")
		.within(0, 100)
		.showDefault();
	line.addFlag("--film-panel", o.filmPanel, "A film made by --record shows the panels");
	line.addFlag("--no-sound", o.isSilent, "The window begins without sound");
	line.addFlag("--no-panel", o.noPanel, "The window begins without its panel");
}
}  // namespace ep
