// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "cli/WindowOptions.h"

#include "cli/NamedOption.h"
#include "cli/OptionRange.h"

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

void addWindowOptions(CLI::App& app, WindowOptions& o)
{
	app.add_option("--screenshot", o.screenshot, "Open the window, save a PNG of it, and end");
	app.add_option("--after", o.screenshotTime, "Simulated time of the screenshot [s]")
		->capture_default_str()
		->check(optionRange(0, 3600));
	app.add_option("--record", o.record, "Open the window, make a film (MP4) of it, --seconds long, and end");
	app.add_option("--seconds", o.recordTime, "Length of the film [s]")
		->capture_default_str()
		->check(optionRange(0.1, 36000));
	addNamedOption(app, "--camera", o.camera,
				   "Camera that the window begins with; own: the scene's, else chase of what is driven, else side",
				   windowCameras());
	app.add_option_function<std::vector<int>>(
		   "--size",
		   [&o](const std::vector<int>& size)
		   {
			   o.width = size[0];
			   o.height = size[1];
		   },
		   "Of the window, width and height [pixels]")
		->default_str(std::to_string(o.width) + " " + std::to_string(o.height))
		->expected(2)
		->allow_extra_args(false)
		->check(optionRange<int>(100, 16384));
	app.add_option("--text-size", o.textSize, "Height of the window's text [pixels], 0: by the screen's resolution")
		->capture_default_str()
		->check(optionRange(0, 100));
	app.add_flag("--film-panel", o.filmPanel, "A film made by --record shows the panels");
	app.add_flag("--no-sound", o.isSilent, "The window begins without sound");
	app.add_flag("--no-panel", o.noPanel, "The window begins without its panel");
}
}  // namespace ep
