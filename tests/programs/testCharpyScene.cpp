// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What the Charpy test's window shows and lets change, without a window.

#include <gtest/gtest.h>

#include <cmath>

#include "support/SilentPanel.h"
#include "view/Scene.h"

namespace testCharpyScene
{
using namespace ep;
using namespace ep::charpy;

TEST(Charpy, WindowShowsThreeViewsAndEnergiesAsTheyGo)
{
	Scene scene{Settings()};
	for (int i = 0; i < 1000 && scene.draw().chart.x.size() < 10; ++i)
		scene.step(Controls());
	const Drawing drawing = scene.draw();
	EXPECT_EQ(3u, drawing.views.size());
	ASSERT_EQ(10u, drawing.chart.x.size());
	// What is stacked is what the hammer has lost, and what it is made of has a name.
	float sum = 0;
	for (const Chart::Series& band : drawing.chart.bands)
		sum += band.values.back();
	const Result r = scene.charpy().result();
	EXPECT_NEAR(r.loss(), sum, 0.005 * r.loss());  // as the audit closes
	EXPECT_EQ(drawing.chart.bands.size(), drawing.legend.size());
}

TEST(Charpy, WindowsKeysChangeTheTest)
{
	Scene scene{Settings()};
	const auto settings = [&scene]() -> const Settings& { return scene.charpy().settings(); };
	for (int i = 0; i < 10; ++i)
	{
		scene.key(char('0' + i));
		EXPECT_EQ(joints()[size_t(i)].value, settings().way);
	}
	scene.key('+');
	EXPECT_DOUBLE_EQ(0.2e-3, settings().step);
	scene.key('-');
	EXPECT_DOUBLE_EQ(0.1e-3, settings().step);
	scene.key('g');
	EXPECT_EQ(Geometry::Paper, settings().geometry);

	// The paper's hammer is too thick for these anvils.
	Settings narrow;
	narrow.gap = 0.018;
	Scene tight{narrow};
	tight.key('g');
	EXPECT_EQ(Geometry::Repeatable, tight.charpy().settings().geometry);

	// Slower: a picture shows half the time.
	const auto inImpact = [](char key)
	{
		Scene slow{Settings()};
		slow.key(key);
		while (!slow.charpy().hasStruck())
			slow.step(Controls());
		const double before = slow.charpy().time();
		slow.step(Controls());
		return slow.charpy().time() - before;
	};
	EXPECT_NEAR(inImpact(','), inImpact(' ') / 2, 1e-9);
	EXPECT_NEAR(inImpact('.'), inImpact(' ') * 2, 1e-9);
}

/// A person who moves one slider and lets go, or presses a button.
struct OneHand : SilentPanel
{
	std::string label, said;
	double to = 0;

	void text(const std::string& line) override { said += line + "\n"; }
	bool button(const char* l) override { return l == label; }
	bool slider(const char* l, double& value, double, double, const char*) override
	{
		if (l != label)
			return false;
		value = to;
		return true;
	}
	using SilentPanel::slider;
};

TEST(Charpy, WindowsPanelChangesTheTest)
{
	Settings low;
	low.height = 0.005;
	Scene scene{low};
	OneHand hand;
	hand.label = "friction";
	hand.to = 0.3;
	scene.panel(0, hand);
	EXPECT_DOUBLE_EQ(0.3, scene.charpy().settings().friction);
	// What does not go is said, and all stays as it was.
	hand.label = "notch [mm]";
	hand.to = 6;
	scene.panel(0, hand);
	EXPECT_NE(std::string::npos, hand.said.find("--notch is 6"));
	EXPECT_EQ(low.notch, scene.charpy().settings().notch);
	hand.label = "As given";
	scene.panel(0, hand);
	EXPECT_EQ(low.friction, scene.charpy().settings().friction);
}
}  // namespace testCharpyScene
