// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PICTURE_TILE_H
#define EP_PICTURE_TILE_H

namespace ep
{
/// A part of a picture: pixels from its bottom left corner.
struct Tile
{
	int x, y, width, height;

	float aspect() const { return float(width) / float(height); }
};
}  // namespace ep

#endif  // EP_PICTURE_TILE_H
