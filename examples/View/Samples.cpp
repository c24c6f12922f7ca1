// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Samples.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "problems/Catalogue.h"
#include "replay/ReplayScene.h"
#include "scenes/destruction/Catalogue.h"
#include "text/Format.h"
#include "text/OutputFiles.h"
#include "trials/Catalogue.h"
#include "view/DemolisherScene.h"
#include "view/Scene.h"
#ifdef EP_WITH_PICTURES
#include "picture/ScenePicture.h"
#endif
#ifdef EP_WITH_SCENE_FILES
#include "scenefile/SceneFile.h"
#include "sceneview/LiveScene.h"
#endif

namespace ep
{
namespace
{
#ifdef EP_WITH_PICTURES
const int PICTURE_WIDTH = 96, PICTURE_HEIGHT = 54;  // [pixels]
#endif

std::string solve(const Problem& problem, const Method& method, Stepping stepping, const Watch& watch)
{
	stepping.watch = watch;
	const Outcome outcome = problem.solve(method, stepping);
	const Quantity& quantity = outcome.quantities.front();
	return format("%s: %.6g, exact %.6g", quantity.name.c_str(), quantity.value, quantity.exact);
}

std::string tryOut(const Trial& trial, const Method& method, const Watch& watch)
{
	const Verdict verdict = trial.run(method, watch);
	return verdict.isGreen() ? "all is well" : verdict.complaint();
}

std::unique_ptr<ViewedScene> replay(const std::string& title, const std::function<std::string(const Watch&)>& run)
{
	return std::make_unique<ReplayScene>(title, run);
}

Method methodOf(const SampleMethod& m) { return Method(m.solver, m.joints, 10); }

SampleGroup problemSamples(const SampleMethod& m)
{
	SampleGroup group = {"Problems with known answers", {}};
	for (const Problem& problem : problems())
		group.samples.push_back({problem.name, problem.what,
								 [&problem, m]
								 {
									 return replay(std::string(problem.name) + ": " + problem.what,
												   [&](const Watch& watch)
												   { return solve(problem, methodOf(m), m.stepping, watch); });
								 }});
	return group;
}

SampleGroup destructionSamples(const SampleMethod& m)
{
	SampleGroup group = {"Scenes of destruction", {}};
	for (const DestructionScene& scene : destructionScenes())
		group.samples.push_back(
			{scene.name, std::string(scene.what) + (scene.isLarge ? " (takes minutes)" : ""),
			 [&scene, m]
			 {
				 return replay(
					 std::string(scene.name) + ": " + scene.what, [&](const Watch& watch)
					 { return format("%d joints broken", playDestruction(scene, m.solver == Solver::Stock, watch)); });
			 },
			 -1, scene.isLarge});
	return group;
}

SampleGroup trialSamples(const SampleMethod& m)
{
	SampleGroup group = {"Hard cases", {}};
	for (const Trial& trial : stabilityTrials())
		group.samples.push_back({trial.fullName(), "", [&trial, m] {
									 return replay(trial.fullName(), [&](const Watch& watch)
												   { return tryOut(trial, methodOf(m), watch); });
								 }});
	return group;
}

/// Those that only others include have no title.
SampleGroup sceneFileSamples(const std::string& folder)
{
	SampleGroup group = {"Scene files", {}};
#ifdef EP_WITH_SCENE_FILES
	if (!std::filesystem::is_directory(folder))
		return group;
	for (const auto& entry : std::filesystem::directory_iterator(folder))
	{
		const std::string file = entry.path().string();
		if (entry.path().extension() != ".json")
			continue;
		const SceneText text = SceneText::read(file);
		if (!text.root.find("title"))
			continue;
		const SceneDescription scene = describeScene(text);
		group.samples.push_back({entry.path().filename().string(), scene.title, [file] { return openSceneFile(file); },
								 scene.pictureTime < 0 ? scene.end.time : scene.pictureTime});
	}
	std::sort(group.samples.begin(), group.samples.end(),
			  [](const Sample& a, const Sample& b) { return a.name < b.name; });
#else
	(void)folder;
#endif
	return group;
}

Sample demolisherSample(const std::string& name, const std::string& what, const std::vector<Scene>& scenes)
{
	return {"demolisher/" + name, what,
			[scenes]
			{
				DemolisherSettings settings;
				settings.scenes = scenes;
				auto scene = std::make_unique<DemolisherScene>(settings);
				scene->setAutopilot(true);
				scene->setRemembers(true);
				return std::unique_ptr<ViewedScene>(std::move(scene));
			},
			// When the first one is being run into, or crossed.
			scenes.front() == Scene::Bridge ? 9.6 : 6.5};
}

SampleGroup demolisherSamples()
{
	SampleGroup group = {"Demolisher", {}};
	for (const Named<Scene>& scene : scenes())
		group.samples.push_back(demolisherSample(scene.name, scene.help, {scene.value}));
	group.samples.push_back(
		demolisherSample("all", "gate, bridge, fence and rod, one after the other", DemolisherSettings().scenes));
	return group;
}

SampleGroup charpySamples()
{
	const auto sample = [](const char* name, const char* what, const charpy::Settings& settings) -> Sample
	{
		return {std::string("charpy/") + name, what,
				[settings] { return std::unique_ptr<ViewedScene>(std::make_unique<charpy::Scene>(settings)); }, .01};
	};
	return {"Charpy impact test",
			{sample("repeatable", "hammer and anvils whose contacts are the same in each test", charpy::Settings()),
			 sample("paper", "hammer and anvils as in the paper", charpy::Settings::paper())}};
}
}  // namespace

std::vector<SampleGroup> allSamples(const SampleMethod& method, const std::string& folder)
{
	std::vector<SampleGroup> groups = {demolisherSamples(),    sceneFileSamples(folder),   charpySamples(),
									   problemSamples(method), destructionSamples(method), trialSamples(method)};
	groups.erase(
		std::remove_if(groups.begin(), groups.end(), [](const SampleGroup& group) { return group.samples.empty(); }),
		groups.end());
	return groups;
}

/// Names of trials have blanks and slashes.
std::string Sample::picture() const
{
	std::string file = name;
	for (char& c : file)
		if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-')
			c = '_';
	return file + ".png";
}

void makePictures(const std::vector<SampleGroup>& groups, const std::string& folder)
{
#ifdef EP_WITH_PICTURES
	makeDirectory(folder);
	for (const SampleGroup& group : groups)
		for (const Sample& sample : group.samples)
		{
			const std::string file = (std::filesystem::path(folder) / sample.picture()).string();
			if (sample.isLarge || std::filesystem::exists(file))
				continue;
			const std::unique_ptr<ViewedScene> scene = sample.open();
			if (auto* const replay = dynamic_cast<ReplayScene*>(scene.get()))
				replay->goToFurthest();
			for (double time = 0; time < sample.pictureTime; time += double(scene->stepTime()))
				scene->step(Controls());
			writePng(file, takePicture(*scene, PICTURE_WIDTH, PICTURE_HEIGHT));
		}
#else
	(void)groups;
	throw std::runtime_error("there are no pictures for '" + folder + "': built without OpenGL and libpng");
#endif
}

const Sample* findSample(const std::vector<SampleGroup>& groups, const std::string& name)
{
	for (const SampleGroup& group : groups)
		for (const Sample& sample : group.samples)
			if (sample.name == name)
				return &sample;
	return nullptr;
}

std::string listOf(const std::vector<SampleGroup>& groups)
{
	std::string text;
	for (const SampleGroup& group : groups)
	{
		text += group.title + "\n";
		for (const Sample& sample : group.samples)
			text += "  " + sample.name + (sample.what.empty() ? "" : ": " + sample.what) + "\n";
	}
	return text;
}

std::unique_ptr<ViewedScene> openSceneFile(const std::string& file)
{
#ifdef EP_WITH_SCENE_FILES
	return std::make_unique<LiveScene>(file);
#else
	throw std::runtime_error("'" + file + "' cannot be read: built without muParser");
#endif
}
}  // namespace ep
