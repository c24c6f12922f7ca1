// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Pictures without a window, and the sounds that a window makes.

#include <gtest/gtest.h>

#include <cstdlib>

#include "picture/Picture.h"

namespace testPicture
{
using namespace ep;

const int WIDTH = 320, HEIGHT = 180;

/// A red box before the sky.
View boxView()
{
	View view;
	view.parts.push_back(
		boxPart(btTransform(btQuaternion(0, 0, 0, 1), btVector3(0, 20, 0)), btVector3(4, 4, 4), {.6f, .02f, .02f}));
	view.camera.eye = btVector3(3, 19, 20);
	view.camera.target = btVector3(0, 20, 0);
	return view;
}

int channel(const Image& image, int x, int y, int c) { return image.pixels[size_t(3 * (y * image.width + x) + c)]; }

TEST(Picture, IsDrawnWithoutADisplayAndTheSameEachTime)
{
	::unsetenv("DISPLAY");
	const Image image = drawPicture(boxView(), WIDTH, HEIGHT), again = drawPicture(boxView(), WIDTH, HEIGHT);
	ASSERT_EQ(image.width, WIDTH);
	ASSERT_EQ(image.height, HEIGHT);
	ASSERT_EQ(image.pixels.size(), size_t(3 * WIDTH * HEIGHT));
	EXPECT_EQ(image.pixels, again.pixels);
	EXPECT_GT(channel(image, WIDTH / 2, HEIGHT / 2, 0), channel(image, WIDTH / 2, HEIGHT / 2, 2) + 60) << "the box";
	EXPECT_GT(channel(image, 5, 5, 2), channel(image, 5, 5, 0) + 30) << "the sky";
}

TEST(Picture, DustHidesInPartAndSparksGlow)
{
	View view = boxView();
	const Image clear = drawPicture(view, WIDTH, HEIGHT);
	const btVector3 before = view.camera.target.lerp(view.camera.eye, btScalar(.25));
	view.puffs = {{before, btVector3(0, 0, 0), 2, {.42f, .39f, .34f}, .5f}};
	const Image dusty = drawPicture(view, WIDTH, HEIGHT);
	const int x = WIDTH / 2, y = HEIGHT / 2;
	EXPECT_GT(channel(dusty, x, y, 1), channel(clear, x, y, 1) + 20);
	EXPECT_GT(channel(dusty, x, y, 0), channel(dusty, x, y, 1)) << "the box is still seen";
	EXPECT_EQ(channel(dusty, 5, 5, 2), channel(clear, 5, 5, 2));

	// Behind the box nothing is seen of it.
	view.puffs[0].place = view.camera.target.lerp(view.camera.eye, btScalar(-.25));
	view.puffs[0].radius = 1;
	EXPECT_EQ(channel(drawPicture(view, WIDTH, HEIGHT), x, y, 1), channel(clear, x, y, 1));

	view.puffs = {{before, btVector3(1, 0, 0), .3f, {4, 1.9f, .5f}, 1}};
	EXPECT_GT(channel(drawPicture(view, WIDTH, HEIGHT), x, y, 0), 240);
}
}  // namespace testPicture
