// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BONDED_SCENE_H
#define EP_BONDED_SCENE_H

#include "build/Model.h"
#include "scenefile/SceneDescription.h"

namespace ep
{
struct BondSettings
{
	std::string material = "steel";  ///< of pieces that name none, and of joints between different ones
	std::string materials;           ///< a scene's file that holds materials; empty: there is steel
	std::vector<std::string> fixed;  ///< names or patterns of pieces that do not move
	double gap = 1e-3;               ///< the largest that counts as touching, and how deep pieces may overlap [m]
	bool ground = false;
};

/// A scene's file made of a model's pieces, and what a person should know of it.
struct BondedScene
{
	std::string text;
	SceneDescription scene;            ///< the same
	std::vector<std::string> remarks;  ///< pieces that nearly touch, overlap, or touch without a face
};

/// \param file  that the scene is for: it includes others by paths from there
/// Throws a SceneError with all that is wrong with the pieces' materials and properties, as a scene's file is told of.
BondedScene bondPieces(const std::vector<ModelPiece>& pieces, const BondSettings& settings, const std::string& file);
}  // namespace ep

#endif  // EP_BONDED_SCENE_H
