// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SCENE_FILE_H
#define EP_SCENE_FILE_H

#include "scenefile/SceneDescription.h"
#include "scenefile/SceneText.h"

namespace ep
{
/// The version of the format that this program reads: the key version of each file.
const int SCENE_VERSION = 1;

/// Throws a SceneError with all that is wrong.
SceneDescription describeScene(const SceneText& text);

/// Its materials alone, by their names. Throws a SceneError with all that is wrong with them.
std::map<std::string, SceneDescription::Material> describeMaterials(const SceneText& text);

/// JSON Schema of scene files, as docs/scene.schema.json holds it.
std::string sceneSchema();
}  // namespace ep

#endif  // EP_SCENE_FILE_H
