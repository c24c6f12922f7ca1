// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_MESH_FILE_H
#define EP_MESH_FILE_H

#include <string>
#include <vector>

#include "LinearMath/btVector3.h"

namespace ep
{
/// Corners of all triangles of a glTF file, three each. \return what is wrong, empty: nothing
std::string readMeshFile(const std::string& file, std::vector<btVector3>& triangles);
}  // namespace ep

#endif  // EP_MESH_FILE_H
