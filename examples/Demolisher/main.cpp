// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <iostream>

#include "runs/Comparison.h"
#include "runs/DemolisherOptions.h"
#include "runs/Headless.h"
#include "cli/CommandLine.h"
#include "cli/WindowOptions.h"
#ifdef EP_WITH_VIEWER
#include "viewer/Viewer.h"
#endif

namespace
{
struct Options
{
	explicit Options(ep::CommandLine& line) : scene(line)
	{
		line.addFlag("--list", list, "Name scenes, joints and solvers, and end");
		line.addFlag("--headless", isHeadless,
					 "No window: the autopilot drives; summary.json, joints.csv and pictures are left");
		line.addFlag("--figure-11", figure11,
					 "The paper's Figure 11, headless: three states, each a picture and a summary");
		line.addFlag(
			"--compare", compares,
			"Tables of what joints and solvers cost and get wrong on the same bridge, and how fast each scene is");
		line.add("--out", headless.out, "Directory for what a headless run leaves").showDefault();
		window.recordTime = headless.seconds;
		ep::addWindowOptions(line, window);
		line.describe("--seconds", "Longest simulated time of a headless run, length of the film [s]");
	}

	ep::DemolisherOptions scene;
	ep::HeadlessSettings headless;
	bool list = false, isHeadless = false, figure11 = false, compares = false;
	ep::WindowOptions window;
};

void runWindow(const Options& o)
{
#ifdef EP_WITH_VIEWER
	if (ep::hasDisplay())
	{
		ep::DemolisherScene scene(o.scene.settings());
		scene.setAutopilot(o.window.isFilmed());
		scene.setRemembers(!o.window.isFilmed());
		ep::runViewer(scene, o.window);
		return;
	}
	const char* const why = "there is no display";
#else
	const char* const why = "built without the viewer";
#endif
	if (o.window.isFilmed())
		throw std::runtime_error(std::string("no picture or film of the window: ") + why);
	std::cout << "No window: " << why << ". Running headless" << std::endl;
	ep::runHeadless(o.scene.settings(), o.headless);
}
}  // namespace

int main(int argc, char** argv)
{
	ep::CommandLine line("Demolisher: a heavy vehicle, and things whose steel joints yield before they break");
	Options options(line);
	if (const std::optional<int> status = line.parse(argc, argv))
		return *status;
	try
	{
		options.headless.seconds = options.window.recordTime;
		if (options.window.isFilmed() && (options.isHeadless || options.figure11 || options.compares))
			throw std::runtime_error(
				"--screenshot and --record need the window, which --headless, --figure-11 and --compare do without");
		if (options.list)
			std::cout << ep::DemolisherOptions::list();
		else if (options.compares)
			std::cout << ep::comparisonTables(options.scene.settings());
		else if (options.figure11)
			ep::runFigure11(options.headless);
		else if (!options.isHeadless)
			runWindow(options);
		else
			ep::runHeadless(options.scene.settings(), options.headless);
	}
	catch (const std::exception& error)
	{
		std::cerr << "demolisher: " << error.what() << "\n";
		return 1;
	}
}
