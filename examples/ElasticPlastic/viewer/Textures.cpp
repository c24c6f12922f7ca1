// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/Textures.h"

#include <png.h>

#include <map>
#include <vector>

#include "viewer/Gl.h"

namespace ep
{
namespace
{
Texture load(const std::string& file)
{
	png_image png = {};
	png.version = PNG_IMAGE_VERSION;
	if (!png_image_begin_read_from_file(&png, file.c_str()))
		return {};
	png.format = PNG_FORMAT_RGBA;
	std::vector<unsigned char> pixels(PNG_IMAGE_SIZE(png));
	if (!png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr))
		return {};
	Texture texture = {0, int(png.width), int(png.height)};
	GLint bound = 0;
	glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
	glGenTextures(1, &texture.name);
	glBindTexture(GL_TEXTURE_2D, texture.name);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, texture.width, texture.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
	glBindTexture(GL_TEXTURE_2D, GLuint(bound));
	return texture;
}
}  // namespace

const Texture* textureOf(const std::string& file)
{
	static std::map<std::string, Texture> all;
	if (file.empty())
		return nullptr;
	const auto known = all.find(file);
	const Texture& texture = known != all.end() ? known->second : all.emplace(file, load(file)).first->second;
	return texture.name ? &texture : nullptr;
}
}  // namespace ep
