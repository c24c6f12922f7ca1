// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARGE_H
#define EP_CHARGE_H

#include "world/World.h"

namespace ep
{
/// A charge of TNT goes off in the open, between two steps. Each body that is free to move gets the impulse of the wave that it throws back, on
/// the area that it shows, as if nothing stood between: twice Sadovsky's 200 Pa s m^(2/3) W^(2/3) / R of W kg at R m, not nearer than half a
/// metre.
void blowCharge(World& world, const btVector3& place, double mass);
}  // namespace ep

#endif  // EP_CHARGE_H
