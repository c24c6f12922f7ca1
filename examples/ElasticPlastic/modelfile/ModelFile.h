// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_MODEL_FILE_H
#define EP_MODEL_FILE_H

#include <map>
#include <string>
#include <vector>

#include "LinearMath/btVector3.h"

namespace ep
{
/// A node of a model that has a mesh.
struct ModelNode
{
	std::string name;
	std::string surface;                            ///< name of the first material of its mesh; empty: none
	std::map<std::string, std::string> properties;  ///< custom ones that are texts or numbers, as JSON
	std::vector<btVector3> triangles;               ///< three corners each, in the model's frame
	std::string fault;                              ///< what is wrong with its mesh; empty: nothing
};

/// Reads a glTF file, .glb or .gltf. Throws a std::runtime_error where that cannot be.
std::vector<ModelNode> readModelFile(const std::string& file);
}  // namespace ep

#endif  // EP_MODEL_FILE_H
