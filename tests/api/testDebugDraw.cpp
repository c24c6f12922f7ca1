// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What the action draws.

#include <vector>

#include <gtest/gtest.h>

#include "LinearMath/btIDebugDraw.h"
#include "support/Row.h"

namespace
{
using namespace ep;

/// Counts what is drawn.
struct Canvas : btIDebugDraw
{
	int m_lines = 0;
	std::vector<btVector3> m_colours;

	void drawLine(const btVector3&, const btVector3&, const btVector3& colour) override
	{
		++m_lines;
		m_colours.push_back(colour);
	}
	void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override {}
	void reportErrorWarning(const char*) override {}
	void draw3dText(const btVector3&, const char*) override {}
	void setDebugMode(int) override {}
	int getDebugMode() const override { return DBG_DrawWireframe; }
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
}  // namespace
