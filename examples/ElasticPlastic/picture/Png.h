// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PICTURE_PNG_H
#define EP_PICTURE_PNG_H

#include <string>
#include <vector>

namespace ep
{
/// Three bytes a pixel, red, green, blue, row by row from the top.
struct Image
{
	int width = 0, height = 0;
	std::vector<unsigned char> pixels;
};

/// Throws std::runtime_error, with the file's name, if it cannot be written.
void writePng(const std::string& file, const Image& image);
}  // namespace ep

#endif  // EP_PICTURE_PNG_H
