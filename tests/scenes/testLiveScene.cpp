// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What the mouse does to a scene that is looked at.

#include "scenes/Scenes.h"
#include "sceneview/LiveScene.h"

using namespace ep;

namespace
{
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
}  // namespace

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
