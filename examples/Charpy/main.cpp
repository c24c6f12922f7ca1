// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "CharpyOptions.h"
#include "view/CharpyPictures.h"
#include "studies/CharpyReport.h"
#include "view/CharpyScene.h"
#include "studies/CharpyStudies.h"
#include "cli/OptionRange.h"
#include "cli/OutputFiles.h"
#ifdef EP_WITH_VIEWER
#include "viewer/Viewer.h"
#endif

namespace
{
struct Options
{
	explicit Options(CLI::App& app) : scene(app)
	{
		app.add_flag("--headless", headless,
					 "No window: one line on the terminal, summary.json, energy.csv and energy.svg");
		app.add_flag("--pictures", pictures, "Leave pictures of the test, and no more");
		app.add_option("--screenshot", screenshot, "Open the window, save a PNG there, and end");
		app.add_option("--after", after, "Time in the window before the screenshot [s]")
			->capture_default_str()
			->check(ep::optionRange(0.0, 60.0));
		app.add_option("--out", out, "Directory for what is left")->capture_default_str();
		std::vector<std::string> names = {"all"};
		std::string help = "Many tests with these settings, their results as a table, CSV and SVG: all";
		for (const ep::CharpyStudy& s : ep::charpyStudies())
		{
			names.push_back(s.name);
			help += std::string("; ") + s.name + ": " + s.help;
		}
		app.add_option("--study", study, help)->check(CLI::IsMember(names));
	}

	ep::CharpyOptions scene;
	bool headless = false, pictures = false;
	std::string screenshot;
	double after = 3;
	std::string out = "charpy-output";
	std::string study;
};

void runStudies(const Options& o)
{
	const ep::CharpySettings settings = o.scene.settings();
	ep::makeDirectory(o.out);
	for (const ep::CharpyStudy& study : ep::charpyStudies())
		if (o.study == "all" || o.study == study.name)
		{
			const ep::CharpyTable table = study.run(settings);
			std::printf("%s", table.toText().c_str());
			std::printf("  in %s\n\n", ep::writeTable(table, o.out).c_str());
			std::fflush(stdout);
		}
}
bool hasDisplay()
{
#if !defined(EP_WITH_VIEWER)
	return false;
#elif defined(__unix__) && !defined(__APPLE__)
	const char* const display = std::getenv("DISPLAY");
	return display && *display;
#else
	return true;
#endif
}

void runWindow(const Options& o)
{
#ifdef EP_WITH_VIEWER
	ep::CharpyScene scene(o.scene.settings());
	ep::ViewerOptions viewer;
	viewer.screenshot = o.screenshot;
	viewer.screenshotTime = o.after;
	ep::runViewer(scene, viewer);
#else
	(void)o;
#endif
}

void run(const Options& o)
{
	if (!o.study.empty())
		return runStudies(o);
	if (o.pictures)
	{
		ep::makeDirectory(o.out);
		return ep::takeCharpyPictures(o.scene.settings(), o.out);
	}
	if (!o.headless && hasDisplay())
		return runWindow(o);
	if (!o.screenshot.empty())
		throw std::runtime_error(
			"no screenshot of the window: there is no display, or it was built without the viewer");
	std::printf("%s\n", toLine(ep::runAndReport(o.scene.settings(), o.out)).c_str());
}
}  // namespace

int main(int argc, char** argv)
{
	CLI::App app("Charpy: a pendulum hammer strikes a notched specimen that bends, or breaks");
	Options options(app);
	CLI11_PARSE(app, argc, argv);
	try
	{
		run(options);
	}
	catch (const std::exception& error)
	{
		std::cerr << "charpy: " << error.what() << "\n";
		return 1;
	}
}
