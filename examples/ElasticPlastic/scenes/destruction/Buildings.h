// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BUILDINGS_H
#define EP_BUILDINGS_H

#include "scenes/destruction/Stage.h"

namespace ep
{
/// A building of columns, beams in two directions and slabs.
struct Building
{
	int bays = 4;  ///< columns in each of the two directions
	int storeys = 4;
	btVector3 corner = btVector3(0, 0, 0);

	/// \return the parts of the ground floor's columns of the front row, two a column, from left to right
	std::vector<btRigidBody*> build(Stage& stage) const;
};

/// A building that loses the columns of its front, all but one.
struct Frame
{
	int bays = 4, storeys = 4;

	void build(Stage& stage) const;
};

/// Small buildings that have fallen asleep, of which one is destroyed.
struct City
{
	int buildings = 50;

	void build(Stage& stage) const;
};
}  // namespace ep

#endif  // EP_BUILDINGS_H
