// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "picture/Png.h"

#include <png.h>

#include <filesystem>
#include <stdexcept>

namespace ep
{
namespace
{
[[noreturn]] void fail(const std::string& file, const std::string& reason)
{
	throw std::runtime_error("cannot write the picture '" + file + "': " + reason);
}
}  // namespace

void writePng(const std::string& file, const Image& image)
{
	png_image png = {};
	png.version = PNG_IMAGE_VERSION;
	png.width = png_uint_32(image.width);
	png.height = png_uint_32(image.height);
	png.format = PNG_FORMAT_RGB;
	// Written aside: whoever waits for the file finds it whole or not at all.
	const std::string part = file + ".part";
	std::error_code error, ignored;
	if (!png_image_write_to_file(&png, part.c_str(), 0, image.pixels.data(), 0, nullptr))
	{
		std::filesystem::remove(part, ignored);
		fail(file, png.message);
	}
	std::filesystem::rename(part, file, error);
	if (error)
	{
		std::filesystem::remove(part, ignored);
		fail(file, error.message());
	}
}
}  // namespace ep
