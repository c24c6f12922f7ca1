#include <CLI/CLI.hpp>
#include <cstdlib>
#include <iostream>

#include "DemolisherScene.h"
#include "Headless.h"
#ifdef EP_WITH_VIEWER
#include "viewer.h"
#endif

namespace
{
struct Options
{
	ep::DemolisherSettings scene;
	ep::HeadlessSettings headless;
	bool isHeadless = false;
	std::string screenshot;
	double after = 9;
	std::string camera = "chase";
};

void addOptions(CLI::App& app, Options& o)
{
	app.add_flag("--headless", o.isHeadless, "No window: the autopilot drives, pictures and a summary are left");
	app.add_option("--out", o.headless.out, "Directory for what a headless run leaves")->capture_default_str();
	app.add_option("--seconds", o.headless.seconds, "Longest simulated time of a headless run [s]")
		->capture_default_str()
		->check(CLI::Range(0.1, 3600.0));
	app.add_option("--substeps", o.scene.substeps, "Solver steps in each step of 1/60 s")
		->capture_default_str()
		->check(CLI::Range(1, 1000));
	app.add_option("--iterations", o.scene.iterations, "Solver iterations in each substep")
		->capture_default_str()
		->check(CLI::Range(1, 100000));
	app.add_option("--steel-share", o.scene.bridge.steelShare, "Share of steel in the deck's section")
		->capture_default_str()
		->check(CLI::Range(0.0001, 1.0));
	app.add_option("--speed", o.scene.autopilot.speed, "Speed of the autopilot [m/s]")
		->capture_default_str()
		->check(CLI::Range(1.0, 26.0));
	app.add_option("--screenshot", o.screenshot, "Open the window, let the autopilot drive, save a PNG there, and end");
	app.add_option("--camera", o.camera, "Camera that the window begins with")
		->capture_default_str()
		->check(CLI::IsMember({"chase", "free", "side"}));
	app.add_option("--after", o.after, "Simulated time of the screenshot [s]")
		->capture_default_str()
		->check(CLI::Range(0.0, 3600.0));
}

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
		ep::DemolisherScene scene(o.scene);
		ep::ViewerOptions viewer;
		viewer.screenshot = o.screenshot;
		viewer.screenshotTime = o.after;
		viewer.camera = o.camera;
		scene.setAutopilot(!o.screenshot.empty());
		ep::runViewer(scene, viewer);
		return 0;
	}
	const char* const why = "there is no display";
#else
	const char* const why = "built without the viewer";
#endif
	if (!o.screenshot.empty())
		throw std::runtime_error(std::string("no screenshot of the window: ") + why);
	std::cout << "No window: " << why << ". Running headless" << std::endl;
	ep::runHeadless(o.scene, o.headless);
	return 0;
}
}  // namespace

int main(int argc, char** argv)
{
	Options options;
	CLI::App app("Demolisher: a heavy vehicle and a bridge whose steel joints yield before they break");
	addOptions(app, options);
	CLI11_PARSE(app, argc, argv);
	try
	{
		if (!options.isHeadless)
			return runWindow(options);
		ep::runHeadless(options.scene, options.headless);
	}
	catch (const std::exception& error)
	{
		std::cerr << "demolisher: " << error.what() << "\n";
		return 1;
	}
}
