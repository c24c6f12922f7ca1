// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include <gtest/gtest.h>

#include <cmath>

#include "drawing/Cameras.h"
#include "view/DemolisherScene.h"
#include "programs/OneScene.h"

namespace testDemolisherCameras
{
using namespace ep;

/// Where points come to lie in a picture: from 0 on its left and lower edge to 1 on the others.
class Picture
{
public:
	Picture(const Camera& camera, double aspect)
		: m_camera(camera), m_half(std::tan(double(camera.fieldOfView) / 2)), m_aspect(aspect)
	{
		m_forward = (camera.target - camera.eye).normalized();
		m_right = m_forward.cross(btVector3(0, 1, 0)).normalized();
		m_up = m_right.cross(m_forward);
	}

	double x(const btVector3& point) const { return place(point, m_right, m_half * m_aspect); }
	double y(const btVector3& point) const { return place(point, m_up, m_half); }

	/// The least and the most that a box reaches to.
	Bounds of(const Bounds& box) const
	{
		Bounds bounds;
		for (int i = 0; i < 8; ++i)
		{
			const btVector3 corner(i & 1 ? box.high.x() : box.low.x(), i & 2 ? box.high.y() : box.low.y(),
								   i & 4 ? box.high.z() : box.low.z());
			bounds.add(btVector3(btScalar(x(corner)), btScalar(y(corner)), 0));
		}
		return bounds;
	}

private:
	double place(const btVector3& point, const btVector3& axis, double half) const
	{
		const btVector3 sight = point - m_camera.eye;
		return .5 + .5 * double(sight.dot(axis)) / (half * double(sight.dot(m_forward)));
	}

	Camera m_camera;
	double m_half, m_aspect;
	btVector3 m_right, m_up, m_forward;
};

Bounds box(const btVector3& low, const btVector3& high)
{
	Bounds bounds;
	bounds.add(low);
	bounds.add(high);
	return bounds;
}

const double ROUNDING = 1e-4;  // of a picture's width, in float

TEST(Cameras, FrameAllOfTheBoundsInWhatPanelsLeave)
{
	const Margins margins = {.25f, .3f, .1f, .04f};
	for (const Bounds& bounds :
		 {box({-16, 0, -3}, {16, 8, 3}), box({-1, 0, -2}, {1, 30, 2}), box({5, 2, 7}, {6, 3, 90})})
		for (const btVector3& direction : {btVector3(.2f, -.2f, -1), btVector3(-1, -1, .3f), btVector3(0, 0, 1)})
			for (float aspect : {.8f, 1.78f})
			{
				const Bounds seen =
					Picture(framingCamera(bounds, direction, aspect, margins), double(aspect)).of(bounds);
				EXPECT_GT(double(seen.low.x()), .25 - ROUNDING);
				EXPECT_LT(double(seen.high.x()), .7 + ROUNDING);
				EXPECT_GT(double(seen.low.y()), .1 - ROUNDING);
				EXPECT_LT(double(seen.high.y()), .96 + ROUNDING);
				// No nearer would do: they reach from edge to edge, one way or the other.
				EXPECT_TRUE(seen.size().x() > .45 - ROUNDING || seen.size().y() > .86 - ROUNDING);
			}
}

TEST(Cameras, WhatIsFollowedStandsInTheMiddleOfWhatPanelsLeave)
{
	const Margins margins = {.25f, .35f, 0, 0};
	const Camera camera = movedAside(chaseCamera(btTransform::getIdentity()), 1.78f, margins);
	// Where the camera looked at before is now between the panels.
	const btVector3 target(5, 0, 0);
	EXPECT_NEAR(Picture(camera, 1.78).x(target), .45, ROUNDING);
	EXPECT_NEAR(Picture(camera, 1.78).y(target), .5, ROUNDING);
}

TEST(Demolisher, CameraThatFollowsSeesWhatTheVehicleStrikes)
{
	for (Scene which : {Scene::Gate, Scene::Fence, Scene::Rod, Scene::House})
	{
		DemolisherScene scene(only(which));
		EXPECT_EQ(scene.closeness(), 0) << "from behind at first";
		scene.setAutopilot(true);
		const double place = double(scene.demolisher().settings().placeOf(which));
		const auto nose = [&scene]
		{ return scene.demolisher().vehicle().pose() * btVector3(btScalar(3.9), btScalar(-.5), 0); };
		while (double(nose().x()) < place)
			scene.step(Controls());
		EXPECT_EQ(scene.closeness(), 1);
		// A ray from the eye meets the structure or nothing before it comes to the blade, but no vehicle.
		const Camera camera = chaseCamera(scene.demolisher().vehicle().pose(), scene.closeness());
		const RayHit hit = castRay(scene.demolisher().world(), camera.eye, nose() - camera.eye);
		EXPECT_TRUE(hit.hasHit);
		EXPECT_NE(hit.body, &scene.demolisher().vehicle().chassis());
		const Camera behind = chaseCamera(scene.demolisher().vehicle().pose());
		EXPECT_EQ(castRay(scene.demolisher().world(), behind.eye, nose() - behind.eye).body,
				  &scene.demolisher().vehicle().chassis())
			<< "which would hide it";
	}
}

TEST(Demolisher, CameraThatStandsSeesEachStructureAndTheVehicleThatStrikesIt)
{
	for (size_t i = 0; i < scenes().size(); ++i)
	{
		DemolisherScene scene(only(scenes()[i].value));
		const Scene which = scenes()[i].value;
		const float aspect = 16.f / 9;
		const Picture picture(framingCamera(scene.bounds(), scene.sight(), aspect), double(aspect));
		for (const Beam& beam : scene.demolisher().structure(which)->beams())
			for (const btRigidBody* part : beam.m_parts)
			{
				Bounds own;
				part->getAabb(own.low, own.high);
				const Bounds seen = picture.of(own);
				EXPECT_TRUE(seen.low.x() > 0 && seen.high.x() < 1 && seen.low.y() > 0 && seen.high.y() < 1)
					<< scenes()[i].name;
			}
		// The bridge's ends, and the vehicle on its middle.
		const BridgeSettings& bridge = scene.demolisher().settings().bridge;
		for (double x : {-.5, .5})
			if (which == Scene::Bridge)
			{
				EXPECT_NEAR(picture.x(btVector3(btScalar(x) * bridge.span, bridge.height, 0)), .5, .45);
			}
		const btVector3 roof(scene.demolisher().settings().placeOf(which), 0, 0);
		EXPECT_LT(picture.y(roof + btVector3(0, which == Scene::Bridge ? bridge.height + 3 : btScalar(3), 0)), 1);
	}
}

TEST(Demolisher, WreckIsWhereItWasBuilt)
{
	DemolisherScene scene(only(Scene::Rod));
	scene.setAutopilot(true);
	const double place = double(scene.demolisher().settings().placeOf(Scene::Rod));
	const double height = double(scene.wreckOf(Scene::Rod).high.y());
	while (!scene.demolisher().autopilot().hasArrived())
		scene.step(Controls());
	const Bounds wreck = scene.wreckOf(Scene::Rod);
	EXPECT_EQ(scene.mostDamaged(), Scene::Rod);
	EXPECT_LT(double(wreck.high.y()), height / 2);  // it lies
	EXPECT_NEAR(double(wreck.centre().x()), place, 40);
	EXPECT_GT(double(wreck.size().length()), 4) << "there is something to see";
}
}  // namespace testDemolisherCameras
