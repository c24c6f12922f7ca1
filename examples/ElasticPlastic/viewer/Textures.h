// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_TEXTURES_H
#define EP_VIEWER_TEXTURES_H

#include <string>

namespace ep
{
struct Texture
{
	unsigned name = 0;  ///< OpenGL's
	int width = 0, height = 0;
};

/// Of a PNG file, read when it is asked for first; it lives as long as the window. \return null if it cannot be read
const Texture* textureOf(const std::string& file);
}  // namespace ep

#endif  // EP_VIEWER_TEXTURES_H
