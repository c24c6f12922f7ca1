// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <gtest/gtest.h>

#include <algorithm>

#include "view/BeamSkin.h"
#include "view/DemolisherScene.h"
#include "programs/OneScene.h"

namespace testDemolisherScene
{
using namespace ep;

/// Does one thing in a panel: presses or changes what has a label.
class Finger : public Panel
{
public:
	Finger(std::string label, double value) : m_label(std::move(label)), m_value(value) {}

	bool section(const char*, bool) override { return true; }
	void text(const std::string& line) override { m_lines.push_back(line); }
	bool button(const char* label) override { return touches(label); }
	void beside() override {}
	bool check(const char* label, bool& value) override
	{
		if (touches(label))
			value = m_value != 0;
		return m_label == label;
	}
	bool choice(const char* label, size_t& index, const std::vector<std::string>&) override
	{
		if (touches(label))
			index = size_t(m_value);
		return m_label == label;
	}
	bool slider(const char* label, double& value, double low, double high, const char*) override
	{
		EXPECT_GE(value, low) << label;
		EXPECT_LE(value, high) << label;
		if (touches(label))
			value = m_value;
		return m_label == label;
	}
	bool slider(const char* label, int& value, int, int) override
	{
		if (touches(label))
			value = int(m_value);
		return m_label == label;
	}
	void shares(const std::vector<Share>& shares, const char*) override { EXPECT_EQ(shares.size(), 4u); }
	int table(const char*, const std::vector<std::string>& titles, const std::vector<Row>& rows, int) override
	{
		for (const Row& row : rows)
			EXPECT_EQ(row.cells.size(), titles.size());
		return touches("table") ? int(m_value) : -1;
	}
	void plot(const char*, const Curve& curve) override { m_plotted = curve.values.size(); }
	void figure(const Figure&) override {}

	int m_touched = 0;
	size_t m_plotted = 0;
	std::vector<std::string> m_lines;

private:
	bool touches(const std::string& label)
	{
		m_touched += label == m_label ? 1 : 0;
		return label == m_label;
	}

	std::string m_label;
	double m_value;
};

Finger touch(DemolisherScene& scene, const char* label, double value)
{
	Finger finger(label, value);
	for (size_t i = 0; i < scene.panels().size(); ++i)
		scene.panel(i, finger);
	EXPECT_EQ(finger.m_touched, 1) << label;
	return finger;
}

TEST(Demolisher, PanelChangesWhatItSays)
{
	DemolisherScene scene{DemolisherSettings()};
	const auto settings = [&scene]() -> const DemolisherSettings& { return scene.demolisher().settings(); };
	for (size_t i = 0; i < jointKinds().size(); ++i)
	{
		touch(scene, "joints", double(i));
		EXPECT_TRUE(settings().method.kind() == jointKinds()[i].value) << jointKinds()[i].name;
		for (int k = 0; k < 10; ++k)
			scene.step(Controls());
		EXPECT_FALSE(scene.draw().parts.empty());
	}
	touch(scene, "solver", 1);
	EXPECT_EQ(settings().method.solver, Solver::Iterative);
	touch(scene, "bridge steel [%]", 5);
	EXPECT_NEAR(double(settings().bridge.steelShare), .05, 1e-6);
	touch(scene, "vehicle [t]", 20);
	EXPECT_NEAR(1 / double(scene.demolisher().vehicle().chassis().getInvMass()), 20000, 1);
	// Nothing begins anew for how it is solved.
	const Demolisher* const before = &scene.demolisher();
	touch(scene, "substeps", 2);
	EXPECT_EQ(settings().substeps, 2);
	touch(scene, "iterations", 70);
	EXPECT_EQ(settings().method.iterations, 70);
	EXPECT_EQ(before, &scene.demolisher());
	touch(scene, "Reset all", 0);
	EXPECT_EQ(settings().substeps, DemolisherSettings().substeps);
	EXPECT_EQ(settings().bridge.steelShare, DemolisherSettings().bridge.steelShare);
	EXPECT_TRUE(settings().method.kind() == kinds::Ep2);
}

TEST(Demolisher, PanelPlotsTheChosenJoint)
{
	DemolisherScene scene{DemolisherSettings()};
	for (int i = 0; i < 60; ++i)
		scene.step(Controls());
	EXPECT_EQ(touch(scene, "autopilot", 1).m_plotted, 60u);
	// Another one begins anew.
	touch(scene, "table", 3);
	scene.step(Controls());
	EXPECT_EQ(touch(scene, "joints marked", 1).m_plotted, 1u);
}

TEST(Demolisher, JumpsToEachScene)
{
	DemolisherScene scene{DemolisherSettings()};
	for (int i = 0; i < 4; ++i)
	{
		scene.jump(i);
		EXPECT_EQ(scene.demolisher().vehicle().pose().getOrigin().x(),
				  scene.demolisher().settings().startOf(scenes()[size_t(i)].value));
		EXPECT_EQ(scene.bounds().centre().x(), scene.demolisher().settings().placeOf(scenes()[size_t(i)].value));
	}
}

TEST(Demolisher, SkinIsSmoothAndEndsWhereItIsTorn)
{
	Demolisher demolisher(only(Scene::Bridge));
	for (int i = 0; i < 60 * 30 && !demolisher.autopilot().hasArrived(); ++i)
		demolisher.stepByAutopilot();
	const Beam& deck = demolisher.bridge()->deck();
	const auto whole = skinStations(demolisher.world(), deck);
	ASSERT_EQ(whole.size(), 1u);
	// Through both supports, and through each block's middle within what bending moves it off its axis.
	EXPECT_NEAR(double((whole[0].front().getOrigin() - deck.startPoint()).length()), 0, 1e-4);
	EXPECT_NEAR(double((whole[0].back().getOrigin() - deck.endPoint()).length()), 0, 1e-4);
	double turn = 0;
	for (size_t i = 1; i < whole[0].size(); ++i)
		turn = std::max(turn, double(whole[0][i - 1].getRotation().angleShortestPath(whole[0][i].getRotation())));
	double bend = 0;
	for (size_t i = 1; i < deck.m_parts.size(); ++i)
		bend = std::max(
			bend, double(deck.m_parts[i - 1]->getOrientation().angleShortestPath(deck.m_parts[i]->getOrientation())));
	// The blocks' sharpest bend is spread over the stations of two half blocks.
	EXPECT_GT(bend, .02);
	EXPECT_LT(turn, bend / 2);

	DemolisherSettings settings = only(Scene::Bridge);
	settings.method = Method(Solver::Stock, kinds::None, 10);
	Demolisher loose(settings);
	EXPECT_EQ(skinStations(loose.world(), loose.bridge()->deck()).size(), 12u);
}

TEST(Demolisher, RestartIsAsNew)
{
	DemolisherScene scene(only(Scene::Bridge));
	scene.setAutopilot(true);
	const auto run = [&scene]
	{
		for (int i = 0; i < 60 * 4; ++i)
			scene.step(Controls());
		return scene.demolisher().summary();
	};
	const DemolisherSummary first = run();
	scene.restart();
	const DemolisherSummary second = run();
	EXPECT_EQ(first.vehicle.x(), second.vehicle.x());
	EXPECT_EQ(first.sag, second.sag);
}

TEST(Demolisher, GoesBackToBeforeTheCrashWithTheSameBits)
{
	DemolisherScene scene(only(Scene::Rod));
	scene.setAutopilot(true);
	scene.setRemembers(true);
	while (scene.demolisher().summary().broken == 0)
		scene.step(Controls());
	EXPECT_TRUE(scene.isBreaking());
	const double crash = scene.demolisher().time();
	ASSERT_TRUE(scene.goBack());
	EXPECT_FALSE(scene.isBreaking());
	const DemolisherSummary before = scene.demolisher().summary();
	EXPECT_EQ(before.broken, 0);
	EXPECT_NEAR(before.time, crash - 1, .3);
	// Once more it breaks at the same step.
	while (scene.demolisher().summary().broken == 0)
		scene.step(Controls());
	EXPECT_EQ(scene.demolisher().time(), crash);

	// A ball that has come since is gone, and comes again when it is thrown again.
	scene.throwBall({btVector3(0, 5, 20), btVector3(0, 0, -1)});
	scene.step(Controls());
	EXPECT_EQ(scene.demolisher().balls().size(), 1u);
	ASSERT_TRUE(scene.goBack());
	EXPECT_EQ(scene.demolisher().balls().size(), 0u);
}

TEST(Demolisher, WhatBreaksIsSeenAndHeard)
{
	for (Scene which : {Scene::Rod, Scene::Fence})
	{
		DemolisherScene scene(only(which));
		scene.setAutopilot(true);
		std::vector<Burst> breaks;
		bool struck = false;
		while (breaks.empty() && scene.demolisher().time() < 20)
		{
			scene.step(Controls());
			for (const Burst& burst : scene.bursts())
			{
				struck = struck || burst.kind == Burst::Kind::Blow;
				if (burst.kind == Burst::Kind::Break)
					breaks.push_back(burst);
			}
		}
		ASSERT_FALSE(breaks.empty());
		EXPECT_TRUE(struck) << "by the vehicle, before";
		EXPECT_EQ(int(breaks.size()), scene.demolisher().summary().broken);
		EXPECT_EQ(breaks[0].isSteel, which == Scene::Rod);
		EXPECT_GT(breaks[0].energy, 100);
		EXPECT_FALSE(scene.draw().puffs.empty());
		scene.restart();
		EXPECT_TRUE(scene.draw().puffs.empty());
	}
}

TEST(Demolisher, ChargeGoesOffWhereTheMousePoints)
{
	DemolisherScene scene(only(Scene::House));
	scene.blowCharge({btVector3(0, 5, 0), btVector3(0, 1, 0)});  // the sky
	scene.step(Controls());
	EXPECT_TRUE(scene.bursts().empty());
	const Beam& column = scene.demolisher().structure(Scene::House)->beams().front();
	const btVector3 eye(column.m_parts.front()->getCenterOfMassPosition() + btVector3(0, 0, -20));
	scene.blowCharge({eye, btVector3(0, 0, 1)});
	scene.step(Controls());
	ASSERT_FALSE(scene.bursts().empty());
	EXPECT_EQ(scene.bursts()[0].kind, Burst::Kind::Charge);
	for (int i = 0; i < 60; ++i)
		scene.step(Controls());
	EXPECT_GT(scene.demolisher().summary().broken, 0);
	EXPECT_TRUE(scene.demolisher().summary().isFinite());
}

TEST(Demolisher, HandPullsWhatItMeetsAndChoosesItsJoint)
{
	DemolisherScene scene(only(Scene::Rod));
	const Beam& rod = scene.demolisher().structure(Scene::Rod)->beams().front();
	const btVector3 top = rod.m_parts.back()->getCenterOfMassPosition(), eye = top + btVector3(0, 0, 20);
	EXPECT_FALSE(scene.grab({eye, btVector3(0, 1, -1)}));  // the sky
	EXPECT_FALSE(scene.grab({eye, btVector3(0, -1, 0)}));  // the ground
	ASSERT_TRUE(scene.grab({eye, btVector3(0, 0, -1)}));
	for (int i = 0; i < 60; ++i)
	{
		scene.drag({eye, btVector3(btScalar(.1), 0, -1)});
		scene.step(Controls());
	}
	// By a tenth of the eye's distance.
	EXPECT_NEAR(double(rod.m_parts.back()->getCenterOfMassPosition().x() - top.x()), 2, .5);
	scene.release();
	Finger finger("nothing", 0);
	scene.panel(1, finger);
	const std::string name = rod.joints().back()->getName();
	EXPECT_TRUE(std::any_of(finger.m_lines.begin(), finger.m_lines.end(),
							[&](const std::string& line) { return line.find(name) != std::string::npos; }));
}
}  // namespace testDemolisherScene
