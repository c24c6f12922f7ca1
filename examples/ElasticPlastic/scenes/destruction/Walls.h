// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_WALLS_H
#define EP_WALLS_H

#include "scenes/destruction/Stage.h"

namespace ep
{
/// A wall of blocks, each joined to its neighbours, that heavy balls hit; the rubble falls and lies.
struct Wall
{
	int columns = 25, rows = 20;
	int balls = 2;            ///< the second one comes lower, on the left, when the first one has done
	double ballMass = 10000;  ///< [kg]

	void build(Stage& stage) const;
};

/// A hollow square tower of blocks that shots take to pieces, one after another.
struct Tower
{
	int side = 4;  ///< blocks, of which the outer ones are there
	int rows = 24;
	int shots = 16;

	void build(Stage& stage) const;
};

/// Cubes in a cube, each joined to its neighbours, the lowest to the ground, that a ball hits.
struct Lattice
{
	int side = 8;
	bool stands = true;  ///< else it floats above the ground

	void build(Stage& stage) const;
};
}  // namespace ep

#endif  // EP_WALLS_H
