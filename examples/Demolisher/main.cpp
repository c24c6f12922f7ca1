// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <iostream>

#include "runs/Comparison.h"
#include "runs/DemolisherOptions.h"
#include "runs/Headless.h"
#include "cli/OptionRange.h"
#ifdef EP_WITH_VIEWER
#include "viewer/Viewer.h"
#endif

namespace
{
struct Options
{
	explicit Options(CLI::App& app) : scene(app)
	{
		app.add_flag("--list", list, "Name scenes, joints and solvers, and end");
		app.add_flag("--headless", isHeadless,
					 "No window: the autopilot drives; summary.json, joints.csv and pictures are left");
		app.add_flag("--figure-11", figure11,
					 "The paper's Figure 11, headless: three states, each a picture and a summary");
		app.add_flag(
			"--compare", compares,
			"Tables of what joints and solvers cost and get wrong on the same bridge, and how fast each scene is");
		app.add_option("--out", headless.out, "Directory for what a headless run leaves")->capture_default_str();
		app.add_option("--seconds", headless.seconds, "Longest simulated time of a headless run, length of a film [s]")
			->capture_default_str()
			->check(ep::optionRange(0.1, 36000));
		app.add_option("--screenshot", screenshot,
					   "Open the window, let the autopilot drive, save a PNG there, and end");
		app.add_option("--after", after, "Simulated time of the screenshot [s]")
			->capture_default_str()
			->check(ep::optionRange(0, 3600));
		app.add_option("--camera", camera, "Camera that the window begins with")
			->capture_default_str()
			->check(CLI::IsMember({"chase", "free", "side"}));
		app.add_option("--record", record,
					   "Open the window, let the autopilot drive for --seconds, make a film (MP4) of it, and end");
		app.add_option("--text-size", textSize, "Height of the window's text [pixels], 0: by the screen's resolution")
			->capture_default_str()
			->check(ep::optionRange(0, 100));
		app.add_option("--size", size, "Of the window, width and height [pixels]")
			->capture_default_str()
			->expected(2)
			->check(ep::optionRange(100, 16384));
		app.add_flag("--no-panel", noPanel, "The window begins without its panel");
	}

	ep::DemolisherOptions scene;
	ep::HeadlessSettings headless;
	bool list = false, isHeadless = false, figure11 = false, compares = false;
	std::string screenshot, record;
	double after = 9, textSize = 0;
	bool noPanel = false;
	std::vector<int> size = {1280, 720};
	std::string camera = "chase";
};

#ifdef EP_WITH_VIEWER
bool hasDisplay()
{
#if defined(__unix__) && !defined(__APPLE__)
	const char* const display = std::getenv("DISPLAY");
	return display && *display;
#else
	return true;
#endif
}
#endif

int runWindow(const Options& o)
{
#ifdef EP_WITH_VIEWER
	if (hasDisplay())
	{
		ep::DemolisherScene scene(o.scene.settings());
		ep::ViewerOptions viewer;
		viewer.screenshot = o.screenshot;
		viewer.screenshotTime = o.after;
		viewer.camera = o.camera;
		viewer.width = o.size[0];
		viewer.height = o.size[1];
		viewer.record = o.record;
		viewer.recordTime = o.headless.seconds;
		viewer.textSize = float(o.textSize);
		viewer.panel = !o.noPanel;
		scene.setAutopilot(!o.screenshot.empty() || !o.record.empty());
		ep::runViewer(scene, viewer);
		return 0;
	}
	const char* const why = "there is no display";
#else
	const char* const why = "built without the viewer";
#endif
	if (!o.screenshot.empty() || !o.record.empty())
		throw std::runtime_error(std::string("no picture or film of the window: ") + why);
	std::cout << "No window: " << why << ". Running headless" << std::endl;
	ep::runHeadless(o.scene.settings(), o.headless);
	return 0;
}
}  // namespace

int main(int argc, char** argv)
{
	CLI::App app("Demolisher: a heavy vehicle, and things whose steel joints yield before they break");
	Options options(app);
	CLI11_PARSE(app, argc, argv);
	try
	{
		const bool filmed = !options.screenshot.empty() || !options.record.empty();
		if (filmed && (options.isHeadless || options.figure11 || options.compares))
			throw std::runtime_error(
				"--screenshot and --record need the window, which --headless, --figure-11 and --compare do without");
		if (options.list)
			std::cout << ep::DemolisherOptions::list();
		else if (options.compares)
			std::cout << ep::comparisonTables(options.scene.settings());
		else if (options.figure11)
			ep::runFigure11(options.headless);
		else if (!options.isHeadless)
			return runWindow(options);
		else
			ep::runHeadless(options.scene.settings(), options.headless);
	}
	catch (const std::exception& error)
	{
		std::cerr << "demolisher: " << error.what() << "\n";
		return 1;
	}
}
