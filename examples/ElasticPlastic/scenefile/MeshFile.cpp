// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenefile/MeshFile.h"

#ifdef EP_WITH_GLTF
#include <stdexcept>

#include "modelfile/ModelFile.h"
#endif

namespace ep
{
#ifdef EP_WITH_GLTF
std::string readMeshFile(const std::string& file, std::vector<btVector3>& triangles)
{
	try
	{
		for (const ModelNode& node : readModelFile(file))
		{
			if (!node.fault.empty())
				return "has the mesh \"" + node.name + "\", which " + node.fault;
			triangles.insert(triangles.end(), node.triangles.begin(),
							 node.triangles.begin() + long(node.triangles.size() / 3 * 3));
		}
	}
	catch (const std::runtime_error& error)
	{
		return error.what();
	}
	return triangles.empty() ? "has no meshes" : "";
}
#else
std::string readMeshFile(const std::string&, std::vector<btVector3>&)
{
	return "cannot be read: built without tinygltf";
}
#endif
}  // namespace ep
