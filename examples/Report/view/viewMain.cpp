// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// ep-view: a reference problem in a window.

#include <CLI/CLI.hpp>
#include <iostream>

#include "view/ProblemScene.h"
#include "viewer/Viewer.h"

int main(int argc, char** argv)
{
	std::vector<std::string> names;
	for (const ep::Problem& problem : ep::problems())
		names.push_back(problem.name);
	std::string problem, solver = "direct";
	int rate = 60;
	ep::Stepping stepping;
	ep::ViewerOptions viewer;
	viewer.camera = "side";
	CLI::App app("A reference problem in a window: solved first, then played again and again");
	app.add_option("problem", problem, "Name of the problem")->required()->check(CLI::IsMember(names));
	app.add_option("--solver", solver, "How it is solved")
		->check(CLI::IsMember(namesOf(ep::solvers())))
		->capture_default_str();
	app.add_option("--rate", rate, "Steps per second")->check(CLI::Range(1, 1000000))->capture_default_str();
	app.add_option("--substeps", stepping.substeps, "Of each step")->check(CLI::Range(1, 10000))->capture_default_str();
	app.add_option("--error", stepping.error, "Substeps as this error asks for, 0.01 is 1 %; 0: as given")
		->check(CLI::Range(0., 1.))
		->capture_default_str();
	app.add_option("--screenshot", viewer.screenshot, "A PNG to save, and then end");
	app.add_option("--after", viewer.screenshotTime, "Time to play before the screenshot [s]")
		->check(CLI::Range(0., 1000.))
		->capture_default_str();
	CLI11_PARSE(app, argc, argv);
	stepping.step = 1. / rate;
	try
	{
		ep::ProblemScene scene(*ep::findProblem(problem), *findNamed(ep::solvers(), solver), stepping);
		ep::runViewer(scene, viewer);
	}
	catch (const std::exception& error)
	{
		std::cerr << "ep-view: " << error.what() << "\n";
		return 1;
	}
	return 0;
}
