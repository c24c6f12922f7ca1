// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "picture/ScenePicture.h"

#include "drawing/Cameras.h"
#include "picture/Picture.h"

namespace ep
{
namespace
{
const Margins MARGINS = {.03f, .03f, .03f, .03f};  // of the picture, around what it is of
}

Image takePicture(const ViewedScene& scene, int width, int height)
{
	const Drawing drawing = scene.draw();
	if (!drawing.views.empty())
		return drawPicture(drawing.views.front(), width, height);
	const Camera camera = framingCamera(scene.bounds(), scene.sight(), float(width) / float(height), MARGINS);
	return drawPicture({drawing.parts, camera, drawing.skins, drawing.puffs}, width, height);
}
}  // namespace ep
