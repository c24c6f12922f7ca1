// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_ROD_H
#define EP_ROD_H

#include "structures/Structure.h"

namespace ep
{
struct RodSettings
{
	int blocks = 16;
	btScalar height = 8;                  ///< above the ground [m]
	btScalar radius = btScalar(.06);      ///< [m]
	btScalar hingeLength = btScalar(.3);  ///< over which plastic bending spreads [m]
};

/// A round steel rod that stands upright in the middle of the lane, rooted in the ground: it sways, bends, and stays bent.
class Rod : public Structure
{
public:
	Rod(World& world, const Materials& materials, const RodSettings& settings, const btVector3& origin);
};
}  // namespace ep

#endif  // EP_ROD_H
