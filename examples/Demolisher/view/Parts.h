// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PARTS_H
#define EP_PARTS_H

#include "drawing/Drawing.h"
#include "structures/Bridge.h"
#include "vehicle/Vehicle.h"

namespace ep
{
/// How structures are drawn.
struct PartStyle
{
	bool skin = true;    ///< bent beams smooth, else block by block
	bool joints = true;  ///< marked, in the colour of what they bear and have borne
};

/// Adds all that a scene has built.
void addParts(Drawing& drawing, const World& world, const Structure& structure, const PartStyle& style);

/// The same, and its roads.
void addParts(Drawing& drawing, const World& world, const Bridge& bridge, const PartStyle& style);

void addParts(std::vector<Part>& parts, const Vehicle& vehicle);

/// A beam's concrete or steel, as a skin or as blocks.
void addBeam(Drawing& drawing, const World& world, const Beam& beam, const Colour& colour, float gloss, bool skin);

/// A mark of a size at each joint of a beam; at a broken one on both of its ends.
void addJoints(Drawing& drawing, const World& world, const Beam& beam, const btVector3& size);

/// Of what is torn.
extern const Colour TORN;
}  // namespace ep

#endif  // EP_PARTS_H
