// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// ep-view: a reference problem, a trial of stability or a scene of destruction in a window.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/NamedOption.h"
#include "cli/OptionRange.h"
#include "cli/WindowOptions.h"
#include "problems/Catalogue.h"
#include "scenes/destruction/Catalogue.h"
#include "text/Format.h"
#include "trials/Catalogue.h"
#include "view/ReplayScene.h"
#include "viewer/Viewer.h"
#ifdef EP_WITH_SCENE_FILES
#include "sceneview/LiveScene.h"
#endif

namespace
{
struct Options
{
	explicit Options(CLI::App& app)
	{
		const auto rate = [this](int perSecond) { stepping.step = 1. / perSecond; };
		app.add_option("name", name,
					   "Of a problem, of a scene of destruction, of a trial: group/name, or a scene's file");
		app.add_flag("--list", list, "Name problems, scenes and trials, and end");
		addNamedOption(app, "--solver", solver, "How it is solved", ep::solvers());
		addNamedOption(app, "--joint", joints, "What holds bodies together", ep::jointKinds());
		app.add_option_function<int>("--rate", rate, "Steps per second of a problem; a trial has steps of its own")
			->check(ep::optionRange<int>(1, 1000000))
			->default_str("60");
		app.add_option("--substeps", stepping.substeps, "Of each step")
			->check(ep::optionRange<int>(1, 10000))
			->capture_default_str();
		app.add_option("--error", stepping.error, "Substeps as this error asks for, 0.01 is 1 %; 0: as given")
			->check(ep::optionRange(0, 1))
			->capture_default_str();
		window.camera = ep::WindowCamera::Side;
		ep::addWindowOptions(app, window);
	}

	std::string name;
	bool list = false;
	ep::Solver solver = ep::Solver::Direct;
	ep::JointKind joints = ep::kinds::Ep2;
	ep::Stepping stepping;
	ep::WindowOptions window;
};

std::string list()
{
	std::string text = "problems\n";
	for (const ep::Problem& problem : ep::problems())
		text += std::string("  ") + problem.name + ": " + problem.what + "\n";
	text += "scenes of destruction (--solver stock: in Bullet's own way)\n";
	for (const ep::DestructionScene& scene : ep::destructionScenes())
		text += std::string("  ") + scene.name + ": " + scene.what + "\n";
	text += "trials\n";
	for (const ep::Trial& trial : ep::stabilityTrials())
		text += "  " + trial.fullName() + "\n";
	return text;
}

std::string solve(const ep::Problem& problem, const ep::Method& method, ep::Stepping stepping, const ep::Watch& watch)
{
	stepping.watch = watch;
	const ep::Outcome outcome = problem.solve(method, stepping);
	const ep::Quantity& quantity = outcome.quantities.front();
	return ep::format("%s: %.6g, exact %.6g", quantity.name.c_str(), quantity.value, quantity.exact);
}

std::string tryOut(const ep::Trial& trial, const ep::Method& method, const ep::Watch& watch)
{
	const ep::Verdict verdict = trial.run(method, watch);
	return verdict.isGreen() ? "all is well" : verdict.complaint();
}

std::string destroy(const ep::DestructionScene& scene, bool isBulletsWay, const ep::Watch& watch)
{
	return ep::format("%d joints broken", ep::playDestruction(scene, isBulletsWay, watch));
}

/// Is it a file, and no name?
bool isFile(const std::string& name) { return std::filesystem::path(name).extension() == ".json"; }

std::unique_ptr<ep::ViewedScene> liveScene(const std::string& file)
{
#ifdef EP_WITH_SCENE_FILES
	return std::make_unique<ep::LiveScene>(file);
#else
	throw std::runtime_error("'" + file + "' cannot be read: built without muParser");
#endif
}

ep::ReplayScene replayOf(const Options& o)
{
	const ep::Method method(o.solver, o.joints, 10);
	if (const ep::Problem* const problem = ep::findProblem(o.name))
		return {std::string(problem->name) + ": " + problem->what,
				[&](const ep::Watch& watch) { return solve(*problem, method, o.stepping, watch); }};
	if (const ep::DestructionScene* const scene = ep::findDestructionScene(o.name))
		return {std::string(scene->name) + ": " + scene->what,
				[&](const ep::Watch& watch) { return destroy(*scene, o.solver == ep::Solver::Stock, watch); }};
	if (const ep::Trial* const trial = ep::findTrial(o.name))
		return {trial->fullName(), [&](const ep::Watch& watch) { return tryOut(*trial, method, watch); }};
	throw std::runtime_error("there is no problem, scene or trial '" + o.name + "'; --list names them");
}

std::unique_ptr<ep::ViewedScene> sceneOf(const Options& o)
{
	return isFile(o.name) ? liveScene(o.name) : std::make_unique<ep::ReplayScene>(replayOf(o));
}
}  // namespace

int main(int argc, char** argv)
{
	CLI::App app(
		"A reference problem, a trial of stability or a scene of destruction in a window: computed first, then played "
		"again and again. Or a scene's file: computed as it is looked at, and anew when the file changes");
	Options options(app);
	CLI11_PARSE(app, argc, argv);
	try
	{
		if (options.list)
		{
			std::cout << list();
			return 0;
		}
		const std::unique_ptr<ep::ViewedScene> scene = sceneOf(options);
		ep::runViewer(*scene, options.window);
	}
	catch (const std::exception& error)
	{
		std::cerr << "ep-view: " << error.what() << "\n";
		return 1;
	}
	return 0;
}
