// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PICTURE_SCENE_PICTURE_H
#define EP_PICTURE_SCENE_PICTURE_H

#include "drawing/ViewedScene.h"
#include "picture/Png.h"

namespace ep
{
/// Of a scene as it is now, by its own camera, else by one that has all of it in the picture.
Image takePicture(const ViewedScene& scene, int width, int height);
}  // namespace ep

#endif  // EP_PICTURE_SCENE_PICTURE_H
