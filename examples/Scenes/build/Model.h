// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_MODEL_H
#define EP_MODEL_H

#include <map>
#include <string>
#include <vector>

#include "LinearMath/btVector3.h"

namespace ep
{
/// A convex piece of a model, a node with a mesh.
struct ModelPiece
{
	std::string name;                               ///< of the node, as scenes allow it, and no other piece's
	std::string surface;                            ///< name of the first material of its mesh; empty: none
	std::vector<btVector3> corners;                 ///< of its hull, in the world
	std::map<std::string, std::string> properties;  ///< custom ones, as JSON
};

/// Reads a glTF file, .glb or .gltf. Throws a SceneError with all nodes that are no convex pieces.
std::vector<ModelPiece> readModel(const std::string& file);
}  // namespace ep

#endif  // EP_MODEL_H
