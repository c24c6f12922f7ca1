// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BEAM_SKIN_H
#define EP_BEAM_SKIN_H

#include "structures/Beam.h"

namespace ep
{
/// Poses along a beam, x along it, close enough for a smooth look: one list for each length of it that hangs together.
/// Through each node runs a smooth curve: cubic between the nodes, along the mid frame of the joint at each.
std::vector<std::vector<btTransform>> skinStations(const World& world, const Beam& beam);
}  // namespace ep

#endif  // EP_BEAM_SKIN_H
