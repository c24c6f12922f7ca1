// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What the mouse does to a scene that is looked at, and what its panel shows of a section.

#include "scenes/Scenes.h"
#include "sceneview/LiveScene.h"
#include "support/SilentPanel.h"

namespace testLiveScene
{
using namespace ep;

/// A mast that is fixed to the ground and is removed after 2 s, and a stone beside it.
std::string mastIn(const TemporaryFolder& folder)
{
	return folder.write("scene.json", R"({"version": 1, "world": {"ground": true},
		"materials": {"soft": {"youngs_modulus": 1e8, "yield_stress": 1e7}},
		"structures": [{"beam": {"name": "mast", "material": "soft", "section": {"rectangle": [0.2, 0.2]},
			"from": [0, 0, 0], "to": [0, 4, 0], "parts": 4, "up": [1, 0, 0], "end": "free"}}],
		"bodies": [{"name": "stone", "sphere": 0.5, "at": [9, 0.5, 0], "motion": "static"}],
		"events": [{"time": 2, "remove": "mast/4"}]})");
}

/// Keeps the figures of a panel.
struct FigureReader : SilentPanel
{
	void figure(const Figure& figure) override { figures.push_back(figure); }

	std::vector<Figure> figures;
};

TEST(LiveScene, ShowsTheSectionThatYieldsFirst)
{
	// 0.01 m^2 of 200 MPa, with a bar, pulled by a force that grows by 4 MN in a second; M_pl = 200e6 * 0.1^3 / 4 without the bar, which is on the axis.
	const TemporaryFolder folder;
	LiveScene scene(folder.write("scene.json", R"({"version": 1, "world": {"gravity": [0, 0, 0]},
		"materials": {"steel": {"yield_stress": 200e6}},
		"bodies": [{"name": "box", "box": [1, 0.1, 0.1], "mass": 1e7, "at": [0.5, 0, 0]}],
		"joints": [{"name": "j", "from": "world", "to": "box", "at": [0, 0, 0], "material": "steel",
			"section": {"rectangle": [0.1, 0.1], "fibres": 16, "bars": [{"at": [0, 0], "area": 1e-4, "material": "steel"}]}}],
		"loads": [{"on": "box", "force": [4e6, 0, 0], "over": [0, 0, 10, 10]}]})"));
	FigureReader before, after;
	scene.step(Controls());
	scene.panel(1, before);
	EXPECT_TRUE(before.figures.empty());
	for (int i = 0; i < 60; ++i)
		scene.step(Controls());
	scene.panel(1, after);
	ASSERT_EQ(after.figures.size(), 2u);
	EXPECT_EQ(after.figures[0].squares.size(), 17u);
	EXPECT_GT(after.figures[0].squares[0].colour.r, 2 * after.figures[0].squares[0].colour.b) << "pulled";
	const Figure& forces = after.figures[1];
	ASSERT_EQ(forces.lines.size(), 3u);
	double most[2] = {};
	for (const auto& [axial, moment] : forces.lines[1].points)
	{
		most[0] = std::max(most[0], double(axial));
		most[1] = std::max(most[1], double(moment));
	}
	EXPECT_NEAR(most[0], 2.02e6, 2e3);
	EXPECT_NEAR(most[1], 50e3, 50);
	EXPECT_GT(forces.lines[2].points.size(), 10u);
	EXPECT_NEAR(double(forces.lines[2].points.back().first), 2.02e6, 1e4);
}

TEST(LiveScene, MousePullsBodies)
{
	const TemporaryFolder folder;
	LiveScene scene(mastIn(folder));
	const Simulation& s = scene.simulation();
	const int top = int(s.scene().bodies.size()) - 1;
	const btVector3 before = s.poseOf(top).getOrigin(), eye = before + btVector3(0, 0, 10);
	EXPECT_FALSE(scene.grab({eye, btVector3(0, 1, -1)})) << "the sky";
	EXPECT_FALSE(scene.grab({eye, btVector3(9, .5, 0) - eye})) << "what stands still";
	ASSERT_TRUE(scene.grab({eye, btVector3(0, 0, -1)}));
	for (int i = 0; i < 60; ++i)
	{
		scene.drag({eye, btVector3(btScalar(.05), 0, -1)});
		scene.step(Controls());
	}
	const double pulled = double(s.poseOf(top).getOrigin().x() - before.x());
	EXPECT_GT(pulled, .1) << "towards half a metre to the right";
	EXPECT_LT(pulled, .6);
	// It may be taken away, and the scene may begin anew, while it is held.
	for (int i = 0; i < 90; ++i)
	{
		scene.drag({eye, btVector3(btScalar(.05), 0, -1)});
		scene.step(Controls());
	}
	EXPECT_FALSE(s.isThere(top));
	scene.release();
	scene.restart();
	ASSERT_TRUE(scene.grab({eye, btVector3(0, 0, -1)}));
	scene.restart();
	scene.drag({eye, btVector3(0, 0, -1)});
	scene.release();
	scene.step(Controls());
}

TEST(LiveScene, ChargeTearsTheMastWithSparks)
{
	const TemporaryFolder folder;
	LiveScene scene(folder.write("scene.json", R"({"version": 1, "world": {"ground": true, "error": 0.01},
		"materials": {"brittle": {"yield_stress": 2e7, "ultimate_plastic_strain": 1e-4}},
		"structures": [{"beam": {"name": "mast", "material": "brittle", "section": {"rectangle": [0.2, 0.2]},
			"from": [0, 0, 0], "to": [0, 4, 0], "parts": 4, "up": [1, 0, 0], "end": "free"}}]})"));
	scene.blowCharge({btVector3(0, btScalar(.5), 10), btVector3(0, 0, -1)});
	bool breaks = false;
	for (int i = 0; i < 60 && !breaks; ++i)
	{
		scene.step(Controls());
		for (const Burst& burst : scene.bursts())
			breaks = breaks || (burst.kind == Burst::Kind::Break && burst.isSteel);
	}
	EXPECT_TRUE(breaks);
	EXPECT_TRUE(scene.isBreaking());
	EXPECT_FALSE(scene.draw().puffs.empty());
	for (int i = 0; i < 60; ++i)
		scene.step(Controls());
	EXPECT_FALSE(scene.isBreaking());
	scene.restart();
	EXPECT_TRUE(scene.draw().puffs.empty());
}

TEST(LiveScene, MouseThrowsBalls)
{
	const TemporaryFolder folder;
	LiveScene scene(mastIn(folder));
	const size_t before = scene.simulation().scene().bodies.size();
	scene.throwBall({btVector3(-5, 2, 0), btVector3(2, 0, 0)});
	scene.step(Controls());
	ASSERT_EQ(scene.simulation().scene().bodies.size(), before + 1);
	EXPECT_NEAR(double(scene.simulation().body(int(before))->getLinearVelocity().x()), 25, .1);
}
}  // namespace testLiveScene
