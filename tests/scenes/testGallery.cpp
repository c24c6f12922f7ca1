// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The scenes of the gallery: all of them run, make no energy, and do what they are meant to do.

#include <algorithm>

#include "scenes/ExpectedRun.h"
#include "scenes/Scenes.h"

namespace testGallery
{
using namespace ep;

namespace fs = std::filesystem;

const fs::path FOLDER = fs::path(EP_SOURCE_DIR) / "examples" / "scenes";

/// Files that only others include have no title.
std::vector<std::string> galleryScenes()
{
	std::vector<std::string> names;
	for (const auto& entry : fs::directory_iterator(FOLDER))
		if (entry.path().extension() == ".json" && SceneText::read(entry.path().string()).root.find("title"))
			names.push_back(entry.path().stem().string());
	std::sort(names.begin(), names.end());
	return names;
}

class Gallery : public testing::TestWithParam<std::string>
{
};

TEST_P(Gallery, RunsAsExpectedAndMakesNoEnergy)
{
	const std::string file = (FOLDER / (GetParam() + ".json")).string();
	Simulation simulation(describeScene(SceneText::read(file)));
	runAsExpected(simulation);
	const SceneEnergies& energies = simulation.energies();
	EXPECT_TRUE(energies.isAudited);
	// What blocks give back that have been pressed into each other by a blow, in the steps of a game.
	EXPECT_LE(energies.gained, .03 * energies.turnover);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Gallery, testing::ValuesIn(galleryScenes()),
						 [](const auto& info)
						 {
							 std::string name = info.param;
							 std::replace(name.begin(), name.end(), '-', '_');
							 return name;
						 });

TEST(ScenesPage, ShowsScenesThatAreRead)
{
	std::ifstream stream(std::string(EP_SOURCE_DIR) + "/docs/scenes.md");
	const std::string page((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
	int scenes = 0;
	const std::string begin = "```json\n";
	for (size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1))
	{
		const size_t from = at + begin.size();
		std::string text = page.substr(from, page.find("```", from) - from);
		// Some show one key only.
		if (text[0] != '{')
			text = "{\"version\": 1, \"bodies\": [{\"name\": \"box\", \"box\": [1, 1, 1]}], " + text + "}";
		SCOPED_TRACE(text);
		EXPECT_EQ(complaintOf([&] { Simulation simulation(describeScene(SceneText::parse(text, "page.json"))); }), "");
		++scenes;
	}
	EXPECT_GE(scenes, 3);
}

TEST(GalleryPage, ShowsAllScenesEachOfOneScreen)
{
	std::ifstream stream(std::string(EP_SOURCE_DIR) + "/docs/gallery.md");
	const std::string page((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
	const size_t screen = 50;  // lines
	EXPECT_GE(galleryScenes().size(), 14u);
	for (const std::string& name : galleryScenes())
	{
		EXPECT_NE(page.find("(gallery/" + name + ".png)"), std::string::npos)
			<< name << ": ep-gallery makes the page anew";
		EXPECT_TRUE(fs::exists(std::string(EP_SOURCE_DIR) + "/docs/gallery/" + name + ".png")) << name;
		std::ifstream scene(FOLDER / (name + ".json"));
		EXPECT_LE(size_t(std::count(std::istreambuf_iterator<char>(scene), std::istreambuf_iterator<char>(), '\n')),
				  screen)
			<< name;
	}
}
}  // namespace testGallery
