// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Tells what is where in pictures: the share of pixels of a kind, in per cent, within a part of a picture.

#include <png.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace
{
struct Picture
{
	png_image image = {};
	std::vector<unsigned char> pixels;

	explicit Picture(const char* file)
	{
		image.version = PNG_IMAGE_VERSION;
		image.format = PNG_FORMAT_RGB;
		if (!png_image_begin_read_from_file(&image, file))
			fail(file);
		image.format = PNG_FORMAT_RGB;
		pixels.resize(PNG_IMAGE_SIZE(image));
		if (!png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr))
			fail(file);
	}
	const unsigned char* at(unsigned x, unsigned y) const { return &pixels[3 * (size_t(y) * image.width + x)]; }

private:
	[[noreturn]] void fail(const char* file) const
	{
		std::fprintf(stderr, "%s: %s\n", file, image.message);
		std::exit(2);
	}
};

struct Kind
{
	const char* name;
	bool (*is)(int r, int g, int b);
};

const Kind KINDS[] = {
	{"sky", [](int r, int g, int b) { return b > 140 && b > g && g > r; }},
	{"grass", [](int r, int g, int b) { return g > 100 && g > r && r > b + 15 && g - b < 110; }},
	{"vehicle", [](int r, int g, int b) { return r > 150 && g > 100 && g < r - 15 && b < 70; }},
	{"dark", [](int r, int g, int b) { return r + g + b < 240; }},
	{"white", [](int r, int g, int b) { return r > 225 && g > 225 && b > 225; }},
	// Joints' marks, on the side away from the sun as well; grass is yellower.
	{"green", [](int r, int g, int b) { return g > 80 && g > r + 40 && g > b + 20; }},
	{"red", [](int r, int g, int b) { return r > 150 && g < 110 && b < 90 && r > g + 80; }},
	{"broken", [](int r, int g, int b) { return r > 130 && b > 70 && g < 80 && r > g + 80; }},
};
}  // namespace

int main(int argc, char** argv)
{
	if (argc != 3 && argc != 7)
		return std::fprintf(stderr,
							"usage: pictureShare FILE KIND|OTHER-FILE|size [LEFT TOP RIGHT BOTTOM (per cent)]\n"),
			   2;
	const Picture picture(argv[1]);
	const unsigned width = picture.image.width, height = picture.image.height;
	if (std::strcmp(argv[2], "size") == 0)
		return std::printf("%ux%u\n", width, height), 0;
	unsigned part[4] = {0, 0, width, height};
	for (int i = 0; argc == 7 && i < 4; ++i)
		part[i] = unsigned(std::atof(argv[3 + i]) / 100 * (i % 2 ? height : width));

	const Kind* kind = nullptr;
	for (const Kind& k : KINDS)
		if (std::strcmp(k.name, argv[2]) == 0)
			kind = &k;
	// Not a kind: where it differs from another picture, more than rounding does.
	const Picture other(kind ? argv[1] : argv[2]);
	if (other.image.width != width || other.image.height != height)
		return std::fprintf(stderr, "%s and %s differ in size\n", argv[1], argv[2]), 2;
	size_t count = 0, all = 0;
	for (unsigned y = part[1]; y < part[3]; ++y)
		for (unsigned x = part[0]; x < part[2]; ++x, ++all)
		{
			const unsigned char *p = picture.at(x, y), *q = other.at(x, y);
			if (kind)
				count += kind->is(p[0], p[1], p[2]);
			else
				count += std::abs(p[0] - q[0]) + std::abs(p[1] - q[1]) + std::abs(p[2] - q[2]) > 48;
		}
	std::printf("%.3f\n", 100. * double(count) / double(all ? all : 1));
}
