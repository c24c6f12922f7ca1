// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// ep-gallery: pictures of scene files, and the page that shows them.

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "cli/CommandLine.h"
#include "picture/Picture.h"
#include "scenedrawing/SceneDrawing.h"
#include "scenefile/SceneFile.h"
#include "text/Format.h"
#include "text/OutputFiles.h"

namespace
{
namespace fs = std::filesystem;

const int WIDTH = 640, HEIGHT = 360;  // [pixels]

/// Scenes in a folder, by name; files that only others include have no title.
std::vector<fs::path> scenesIn(const std::string& folder)
{
	std::vector<fs::path> files;
	for (const auto& entry : fs::directory_iterator(folder))
		if (entry.path().extension() == ".json" && ep::SceneText::read(entry.path().string()).root.find("title"))
			files.push_back(entry.path());
	std::sort(files.begin(), files.end());
	return files;
}

void takePicture(const ep::SceneDescription& scene, const std::string& file)
{
	ep::Simulation simulation(scene);
	const double time = scene.pictureTime < 0 ? scene.end.time : scene.pictureTime;
	while (simulation.ending() == ep::Ending::None && simulation.time() < time)
		simulation.step();
	const ep::Drawing drawing = ep::drawSimulation(simulation);
	ep::writePng(
		file, ep::drawPicture({drawing.parts, ep::cameraOf(simulation), drawing.skins, drawing.puffs}, WIDTH, HEIGHT));
}

void make(const std::string& scenes, const std::string& docs)
{
	const fs::path pictures = fs::path(docs) / "gallery";
	ep::makeDirectory(pictures.string());
	std::string page =
		"# Gallery\n\nScenes without C++: each is a file of one screen in [examples/scenes](../examples/scenes), "
		"computed by `build/bin/ep-run FILE`\n(see [scenes.md](scenes.md)). Bands show how near joints are to yield, "
		"from green to red. This page and its pictures are made by\n`build/bin/ep-gallery examples/scenes docs`.\n";
	for (const fs::path& file : scenesIn(scenes))
	{
		const ep::SceneDescription scene = ep::describeScene(ep::SceneText::read(file.string()));
		const std::string name = file.stem().string();
		takePicture(scene, (pictures / (name + ".png")).string());
		page += "\n## " + scene.title + "\n\n" + scene.about + "\n[" + name + ".json](../examples/scenes/" + name +
				".json), " + std::to_string(scene.bodies.size()) + " bodies, " + std::to_string(scene.joints.size()) +
				" joints.\n\n![" + scene.title + "](gallery/" + name + ".png)\n";
		std::cout << name << "\n";
	}
	ep::writeText((fs::path(docs) / "gallery.md").string(), page);
}
}  // namespace

int main(int argc, char** argv)
{
	std::string scenes, docs;
	ep::CommandLine line("Pictures of scene files, and the page gallery.md that shows them");
	line.add("scenes", scenes, "Folder of scene files").required().existingFolder();
	line.add("docs", docs, "Folder for the page, and gallery in it for pictures").required();
	if (const std::optional<int> status = line.parse(argc, argv))
		return *status;
	try
	{
		make(scenes, docs);
	}
	catch (const std::exception& error)
	{
		std::cerr << error.what() << "\n";
		return 1;
	}
	return 0;
}
