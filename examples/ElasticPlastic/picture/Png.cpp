// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "picture/Png.h"

#include <png.h>

#include <stdexcept>

namespace ep
{
void writePng(const std::string& file, const Image& image)
{
	png_image png = {};
	png.version = PNG_IMAGE_VERSION;
	png.width = png_uint_32(image.width);
	png.height = png_uint_32(image.height);
	png.format = PNG_FORMAT_RGB;
	if (!png_image_write_to_file(&png, file.c_str(), 0, image.pixels.data(), 0, nullptr))
		throw std::runtime_error("cannot write the picture '" + file + "': " + png.message);
}
}  // namespace ep
