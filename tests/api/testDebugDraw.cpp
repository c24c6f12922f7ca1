// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What the action draws.

#include <math.h>

#include <vector>

#include <gtest/gtest.h>

#include "LinearMath/btIDebugDraw.h"
#include "support/Row.h"

namespace testDebugDraw
{
using namespace ep;

/// Counts what is drawn.
struct Canvas : btIDebugDraw
{
	int m_lines = 0;
	int m_mode = DBG_DrawWireframe;
	std::vector<btVector3> m_colours;
	std::vector<btScalar> m_lengths;
	std::vector<btTransform> m_frames;

	void drawLine(const btVector3& from, const btVector3& to, const btVector3& colour) override
	{
		++m_lines;
		m_colours.push_back(colour);
		m_lengths.push_back((to - from).length());
	}
	void drawTransform(const btTransform& frame, btScalar) override { m_frames.push_back(frame); }
	void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override {}
	void reportErrorWarning(const char*) override {}
	void draw3dText(const btVector3&, const char*) override {}
	void setDebugMode(int mode) override { m_mode = mode; }
	int getDebugMode() const override { return m_mode; }
};

TEST(DebugDraw, ColoursJointsByUse)
{
	Row row(1);
	Canvas unknown, fresh, broken;
	// Before its first step an action knows no world, and cannot tell whether the bodies are still there.
	row.m_world.action().debugDraw(&unknown);
	EXPECT_EQ(0, unknown.m_lines);
	row.run(1);
	row.m_world.action().debugDraw(&fresh);
	ASSERT_GT(fresh.m_lines, 0);
	// Its first step has loaded it: between green and yellow.
	EXPECT_GT(fresh.m_colours[0].y(), fresh.m_colours[0].x());
	EXPECT_GT(fresh.m_colours[0].y(), 0.9);
	row.run(240);
	row.m_world.bullet().setDebugDrawer(&broken);
	row.m_world.action().debugDraw(&broken);
	ASSERT_GT(broken.m_lines, 0);
	// Red, dark.
	EXPECT_GT(broken.m_colours[0].x(), 5 * broken.m_colours[0].y());
	EXPECT_LT(broken.m_colours[0].x(), 0.3);
	// Bullet draws its actions itself.
	const int lines = broken.m_lines;
	row.m_world.bullet().debugDrawWorld();
	EXPECT_GT(broken.m_lines, lines);
	row.m_world.bullet().setDebugDrawer(nullptr);
}

TEST(DebugDraw, WhatIsBrokenOnPurposeIsDarkToo)
{
	Row row(1);
	row.run(1);
	ASSERT_TRUE(row.m_world.action().breakJoint(row.m_world.bullet(), row.m_joints[0]));
	ASSERT_LT(row.m_joints[0]->getDamage(), btScalar(0.5));
	Canvas canvas;
	row.m_world.action().debugDraw(&canvas);
	ASSERT_GT(canvas.m_lines, 0);
	EXPECT_LT(canvas.m_colours[0].length(), 0.3);
}

TEST(DebugDraw, BulletDrawsFramesUnderConstraintsAlone)
{
	for (bool fallsAsleep : {false, true})
		for (Solver solver : {Solver::Direct, Solver::Stock})
		{
			Row row(1, solver, 1);
			Canvas canvas;
			canvas.setDebugMode(btIDebugDraw::DBG_DrawConstraints);
			row.m_world.bullet().setDebugDrawer(&canvas);
			row.run(48);
			btElasticPlasticJoint& joint = *row.m_joints[0];
			if (fallsAsleep)
			{
				joint.getConstraint().getRigidBodyB().forceActivationState(ISLAND_SLEEPING);
				row.run(1);
			}
			row.m_world.bullet().debugDrawWorld();
			// 10 of 100 kg hang on 800 N: the block has fallen, and its frame with it.
			ASSERT_EQ(2u, canvas.m_frames.size());
			EXPECT_LT(canvas.m_frames[1].getOrigin().y(), canvas.m_frames[0].getOrigin().y() - btScalar(0.01));
			EXPECT_EQ(joint.getFrameA().getOrigin(), canvas.m_frames[0].getOrigin());
			EXPECT_EQ(joint.getFrameB().getOrigin(), canvas.m_frames[1].getOrigin());
			row.m_world.bullet().setDebugDrawer(nullptr);
		}
}

TEST(DebugDraw, ColoursWithoutWireframes)
{
	Row row(1);
	Canvas canvas;
	canvas.setDebugMode(btIDebugDraw::DBG_DrawConstraints | btIDebugDraw::DBG_DrawNormals);
	row.run(1);
	row.m_world.bullet().setDebugDrawer(&canvas);
	row.m_world.bullet().debugDrawWorld();
	// A cross of three, and a line to the block's centre; the two frames besides.
	EXPECT_EQ(4, canvas.m_lines);
	EXPECT_EQ(2u, canvas.m_frames.size());
	row.m_world.bullet().setDebugDrawer(nullptr);
}

TEST(DebugDraw, SizeAndColoursAreTheUsers)
{
	Row row(1);
	btElasticPlasticDrawing drawing;
	drawing.m_size = 3;
	drawing.m_unloaded.setValue(0, 0, 1);
	drawing.m_half.setValue(0, 0, 0);
	drawing.m_yielding.setValue(1, 1, 1);
	drawing.m_spent = 0;
	ASSERT_TRUE(row.m_world.action().setDrawing(drawing));
	Canvas canvas;
	row.run(1);
	row.m_world.action().debugDraw(&canvas);
	ASSERT_EQ(4, canvas.m_lines);
	const btElasticPlasticJoint& joint = *row.m_world.joints()[0];
	EXPECT_EQ(btElasticPlasticColour(joint.getUtilisation(), joint.getDamage(), drawing), canvas.m_colours[0]);
	EXPECT_EQ(btVector3(0, 0, 1), btElasticPlasticColour(0, 0, drawing));
	EXPECT_NEAR(6, canvas.m_lengths[0], 1e-5);
	EXPECT_EQ(btVector3(0, 0, btScalar(0.5)), btElasticPlasticColour(btScalar(0.25), 0, drawing));
	EXPECT_EQ(btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)),
			  btElasticPlasticColour(1, btScalar(0.5), drawing));
	drawing.m_size = -1;
	EXPECT_FALSE(row.m_world.action().setDrawing(drawing));
	drawing.m_size = 0;
	drawing.m_half.setX(btScalar(NAN));
	EXPECT_FALSE(row.m_world.action().setDrawing(drawing));
	EXPECT_EQ(3, row.m_world.action().getDrawing().m_size);
}
}  // namespace testDebugDraw
