// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <cstdio>
#include <iostream>

#include "test/Options.h"
#include "view/Pictures.h"
#include "studies/Report.h"
#include "view/Scene.h"
#include "studies/Studies.h"
#include "cli/CommandLine.h"
#include "cli/WindowOptions.h"
#include "text/OutputFiles.h"
#ifdef EP_WITH_VIEWER
#include "viewer/Viewer.h"
#endif

namespace
{
struct Options
{
	explicit Options(ep::CommandLine& line) : scene(line)
	{
		line.addFlag("--headless", headless,
					 "No window: one line on the terminal, summary.json, energy.csv and energy.svg");
		line.addFlag("--pictures", pictures, "Leave pictures of the test, and no more");
		window.screenshotTime = 3;
		ep::addWindowOptions(line, window);
		line.add("--out", out, "Directory for what is left").showDefault();
		std::vector<std::string> names = {"all"};
		std::string help = "Many tests with these settings, their results as a table, CSV and SVG: all";
		for (const ep::charpy::Study& s : ep::charpy::studies())
		{
			names.push_back(s.name);
			help += std::string("; ") + s.name + ": " + s.help;
		}
		line.add("--study", study, help).oneOf(names);
	}

	ep::charpy::Options scene;
	bool headless = false, pictures = false;
	ep::WindowOptions window;
	std::string out = "charpy-output";
	std::string study;
};

void runStudies(const Options& o)
{
	const ep::charpy::Settings settings = o.scene.settings();
	ep::makeDirectory(o.out);
	for (const ep::charpy::Study& study : ep::charpy::studies())
		if (o.study == "all" || o.study == study.name)
		{
			const ep::charpy::Table table = study.run(settings);
			std::printf("%s", table.toText().c_str());
			std::printf("  in %s\n\n", ep::charpy::writeTable(table, o.out).c_str());
			std::fflush(stdout);
		}
}

/// \return whether there can be a window
bool runWindow(const Options& o)
{
#ifdef EP_WITH_VIEWER
	if (ep::hasDisplay())
	{
		ep::charpy::Scene scene(o.scene.settings());
		ep::runViewer(scene, o.window);
		return true;
	}
#else
	(void)o;
#endif
	return false;
}

void run(const Options& o)
{
	if (!o.study.empty())
		return runStudies(o);
	if (o.pictures)
	{
		ep::makeDirectory(o.out);
		return ep::charpy::takePictures(o.scene.settings(), o.out);
	}
	if (!o.headless && runWindow(o))
		return;
	if (o.window.isFilmed())
		throw std::runtime_error(
			"no picture or film of the window: there is no display, or it was built without the viewer");
	std::printf("%s\n", toLine(ep::charpy::runAndReport(o.scene.settings(), o.out)).c_str());
}
}  // namespace

int main(int argc, char** argv)
{
	ep::CommandLine line("Charpy: a pendulum hammer strikes a notched specimen that bends, or breaks");
	Options options(line);
	if (const std::optional<int> status = line.parse(argc, argv))
		return *status;
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
