// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <set>

#include "Browser.h"
#include "support/SilentPanel.h"

namespace testSamples
{
using namespace ep;

std::vector<SampleGroup> samples() { return allSamples({}, EP_SCENES); }

/// Clicks on a line of a list.
struct Click : SilentPanel
{
	std::string group;
	int row = -1, rows = 0;
	std::string said;

	void text(const std::string& line) override { said += line + "\n"; }
	int table(const char* name, const std::vector<std::string>&, const std::vector<Row>& lines, int) override
	{
		rows += int(lines.size());
		return name == group ? row : -1;
	}
};

SampleGroup broken()
{
	return {"Broken",
			{{"broken", "", []() -> std::unique_ptr<ViewedScene> { throw std::runtime_error("it is not there"); }}}};
}

TEST(Samples, AreAllKindsWithALineAndANameOfTheirOwn)
{
	std::set<std::string> names, titles;
	size_t count = 0;
	const std::vector<SampleGroup> groups = samples();
	for (const SampleGroup& group : groups)
	{
		titles.insert(group.title);
		for (const Sample& sample : group.samples)
		{
			++count;
			names.insert(sample.name);
			EXPECT_EQ(findSample(groups, sample.name), &sample);
			EXPECT_TRUE(group.title == "Hard cases" || !sample.what.empty()) << sample.name;
		}
	}
	EXPECT_EQ(names.size(), count);
	EXPECT_EQ(titles.size(), groups.size());
	for (const char* name : {"dropped-mass", "weak-frame", "all at once/all yield", "demolisher/gate", "charpy/paper"})
		EXPECT_TRUE(names.count(name)) << name;
#ifdef EP_WITH_SCENE_FILES
	EXPECT_TRUE(names.count("column-loss.json"));
#endif
}

TEST(Samples, HavePicturesOfTheirOwn)
{
	std::set<std::string> wanted, there;
	for (const SampleGroup& group : samples())
		for (const Sample& sample : group.samples)
		{
			if (sample.isLarge)
				continue;
			EXPECT_TRUE(wanted.insert(sample.picture()).second) << sample.name;
		}
	for (const auto& file : std::filesystem::directory_iterator(EP_SAMPLE_PICTURES))
		there.insert(file.path().filename().string());
#ifdef EP_WITH_SCENE_FILES
	// ep-view --make-pictures docs/samples draws those that are missing.
	EXPECT_EQ(wanted, there);
#endif
#ifdef EP_WITH_PICTURES
	const std::filesystem::path folder =
		std::filesystem::temp_directory_path() / ("ep-samples-" + std::to_string(::getpid()));
	makePictures({{"One", {*findSample(samples(), "charpy/paper")}}}, folder.string());
	EXPECT_GT(std::filesystem::file_size(folder / "charpy_paper.png"), 1000u);
	std::filesystem::remove_all(folder);
#endif
}

TEST(Samples, WhatIsClickedInTheListOpens)
{
	std::vector<SampleGroup> groups = samples();
	groups.push_back(broken());
	Browser browser(groups);
	EXPECT_TRUE(browser.draw().parts.empty());

	Click click;
	click.group = "Demolisher";
	click.row = 0;
	browser.panel(0, click);
	EXPECT_NE(click.said.find("Computing demolisher/gate"), std::string::npos);
	EXPECT_FALSE(browser.isDriven());
	Click nothing;
	browser.panel(0, nothing);
	EXPECT_TRUE(browser.isDriven());
	browser.step(Controls());
	EXPECT_FALSE(browser.draw().parts.empty());
	EXPECT_EQ(browser.panels().size(), 2u);
	// What is open takes the mouse.
	const size_t parts = browser.draw().parts.size();
	browser.throwBall({btVector3(0, 5, 20), btVector3(0, 0, -1)});
	browser.blowCharge({btVector3(0, 5, 20), btVector3(0, -1, 0)});
	browser.step(Controls());
	EXPECT_GT(browser.draw().parts.size(), parts);
	EXPECT_FALSE(browser.bursts().empty());
	const btVector3 gate = browser.bounds().centre();
	EXPECT_FALSE(browser.grab({gate, btVector3(0, 1, 0)})) << "the sky";
	EXPECT_TRUE(browser.goBack());

	// What cannot be opened is told, and what was open stays.
	click.group = "Broken";
	browser.panel(0, click);
	browser.panel(0, nothing);
	EXPECT_NE(nothing.said.find("broken: it is not there"), std::string::npos);
	EXPECT_TRUE(browser.isDriven());

	// A replay has no panel of its own: its text stands below the list.
	click.group = "Problems with known answers";
	browser.panel(0, click);
	browser.panel(0, nothing);
	EXPECT_FALSE(browser.isDriven());
	EXPECT_EQ(browser.panels().size(), 1u);
	EXPECT_NE(nothing.said.find("exact"), std::string::npos);
}

TEST(Samples, ProblemsShowTheRightAnswer)
{
	// One of each kind; what the step control leaves of dropped-mass is 4 %, and its plain steps at 1/60 s 19 %.
	const std::vector<SampleGroup> groups = samples();
	for (const char* name : {"dropped-mass", "sudden-load-1", "parkes-heavy", "cantilever-at-rest"})
	{
		const std::string text = findSample(groups, name)->open()->draw().text.at(1);
		double value = 0, exact = 0;
		ASSERT_EQ(std::sscanf(text.substr(text.rfind(": ")).c_str(), ": %lf, exact %lf", &value, &exact), 2) << text;
		EXPECT_NEAR(value / exact, 1, .05) << name << ": " << text;
	}
}

TEST(Samples, BoundsAreTheStructuresWithoutTheGround)
{
	// By what their files say: a house of 8 m x 9 m, and a beam in a problem.
	const std::vector<SampleGroup> groups = samples();
	for (const char* name : {"column-loss.json", "dropped-mass", "weak-frame", "block-released"})
	{
		const Sample* const sample = findSample(groups, name);
		if (!sample)
			continue;  // a build without scene files
		const std::unique_ptr<ViewedScene> scene = sample->open();
		const Bounds bounds = scene->bounds();
		EXPECT_GT(bounds.size().length(), 1) << name;
		EXPECT_LT(bounds.size().length(), 60) << name;
		EXPECT_GT(bounds.low.y(), -.5) << name;
	}
}
}  // namespace testSamples
