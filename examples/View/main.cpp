// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// ep-view: all that there is to see in a window, or one of it.

#include <filesystem>
#include <iostream>

#include "Browser.h"
#include "cli/CommandLine.h"
#include "cli/WindowOptions.h"
#include "viewer/Viewer.h"

namespace
{
struct Options
{
	explicit Options(ep::CommandLine& line)
	{
		const auto rate = [this](int perSecond) { method.stepping.step = 1. / perSecond; };
		line.add("name", name, "What to open, as --list names it, or a scene's file; without it all is offered");
		line.addFlag("--list", list, "Name all that there is, and end");
		line.add("--make-pictures", pictures, "Draw pictures that the list lacks into this folder, and end");
		line.add("--scenes", scenes, "Folder of scene files that are offered").showDefault();
		line.addNamed("--solver", method.solver, "How it is solved; stock: scenes of destruction in Bullet's own way",
					  ep::solvers());
		line.addNamed("--joint", method.joints, "What holds bodies together", ep::jointKinds());
		line.addFunction<int>("--rate", rate, "Steps per second of a problem; a trial has steps of its own")
			.within(1, 1000000)
			.showDefault("60");
		const auto substeps = [this](int count)
		{
			method.stepping.substeps = count;
			method.stepping.error = 0;
		};
		const ep::CommandOption error =
			line.add("--error", method.stepping.error, "Substeps as this error asks for, 0.01 is 1 %; 0: none")
				.within(0, 1)
				.showDefault();
		line.addFunction<int>("--substeps", substeps, "Of each step, whatever error they leave")
			.within(1, 10000)
			.excludes(error);
		ep::addWindowOptions(line, window);
	}

	std::string name, pictures, scenes = EP_SCENES;
	bool list = false;
	ep::SampleMethod method;
	ep::WindowOptions window;
};

/// Is it a file, and no name?
bool isFile(const std::string& name) { return std::filesystem::path(name).extension() == ".json"; }

std::unique_ptr<ep::ViewedScene> sceneOf(const Options& o, const std::vector<ep::SampleGroup>& samples)
{
	if (o.name.empty())
		return std::make_unique<ep::Browser>(samples);
	const ep::Sample* const sample = ep::findSample(samples, o.name);
	if (!sample && !isFile(o.name))
		throw std::runtime_error("there is no problem, scene or trial '" + o.name + "'; --list names them");
	return sample ? sample->open() : ep::openSceneFile(o.name);
}

void run(const Options& o)
{
	const std::vector<ep::SampleGroup> samples = ep::allSamples(o.method, o.scenes);
	if (!o.pictures.empty())
		return ep::makePictures(samples, o.pictures);
	// Without a display there is the list at least.
	if (o.list || (o.name.empty() && !ep::hasDisplay()))
		std::cout << ep::listOf(samples);
	else
		ep::runViewer(*sceneOf(o, samples), o.window);
}
}  // namespace

int main(int argc, char** argv)
{
	ep::CommandLine line(
		"Problems with known answers, scenes of destruction, scene files, hard cases, Demolisher and Charpy test in "
		"a window. Problems, scenes of destruction and hard cases are computed first, then played again and again; "
		"a scene's file is computed as it is looked at, and anew when it changes");
	Options options(line);
	if (const std::optional<int> status = line.parse(argc, argv))
		return *status;
	try
	{
		run(options);
	}
	catch (const std::exception& error)
	{
		std::cerr << "ep-view: " << error.what() << "\n";
		return 1;
	}
	return 0;
}
