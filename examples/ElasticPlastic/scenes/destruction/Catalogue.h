// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_DESTRUCTION_CATALOGUE_H
#define EP_DESTRUCTION_CATALOGUE_H

#include <functional>
#include <string>
#include <vector>

#include "scenes/destruction/Stage.h"

namespace ep
{
/// A scene of destruction under a name.
struct DestructionScene
{
	const char* name;
	const char* what;
	int frames;                               ///< until all has happened
	bool isLarge;                             ///< takes minutes
	std::function<void(Stage& stage)> build;  ///< on an empty stage
	btScalar strength = 1;                    ///< for the stage's settings
};

const std::vector<DestructionScene>& destructionScenes();

/// \return null if there is none of that name
const DestructionScene* findDestructionScene(const std::string& name);

/// Builds a scene and plays it; for looking at it. \return how many joints have broken
int playDestruction(const DestructionScene& scene, bool isBulletsWay, const Watch& watch);
}  // namespace ep

#endif  // EP_DESTRUCTION_CATALOGUE_H
