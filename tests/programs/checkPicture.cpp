// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Is there a picture in the file, and something to see in it, and of the vehicle at least so many per cent? Prints what it finds; fails if
// there is not.

#include <png.h>

#include <cstdio>
#include <cstdlib>
#include <set>
#include <vector>

int main(int argc, char** argv)
{
	if (argc != 3)
		return std::fprintf(stderr, "usage: checkPicture FILE PERCENT\n"), 2;
	png_image image = {};
	image.version = PNG_IMAGE_VERSION;
	if (!png_image_begin_read_from_file(&image, argv[1]))
		return std::fprintf(stderr, "%s: %s\n", argv[1], image.message), 1;
	image.format = PNG_FORMAT_RGB;
	std::vector<unsigned char> pixels(PNG_IMAGE_SIZE(image));
	if (!png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr))
		return std::fprintf(stderr, "%s: %s\n", argv[1], image.message), 1;

	std::set<unsigned> colours;
	size_t yellow = 0;
	for (size_t i = 0; i < pixels.size(); i += 3)
	{
		const unsigned r = pixels[i], g = pixels[i + 1], b = pixels[i + 2];
		colours.insert(r << 16 | g << 8 | b);
		yellow += r > 150 && g > 100 && b < 70 ? 1 : 0;
	}
	const double share = 3. * double(yellow) / double(pixels.size());
	std::printf("%u x %u pixels, %zu colours, %.1f %% of it the vehicle's\n", image.width, image.height, colours.size(),
				100 * share);
	// Sky, grass and light make thousands of colours.
	return image.width >= 640 && image.height >= 480 && colours.size() > 1000 && 100 * share >= std::atof(argv[2]) ? 0
																												   : 1;
}
