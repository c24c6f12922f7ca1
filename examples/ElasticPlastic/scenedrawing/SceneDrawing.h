// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SCENE_DRAWING_H
#define EP_SCENE_DRAWING_H

#include "drawing/Drawing.h"
#include "simulation/Simulation.h"

namespace ep
{
/// What a simulation looks like now: bodies in their colours, and joints as bands in the colour of their utilisation.
Drawing drawSimulation(const Simulation& simulation);

/// A shape in the given pose.
void addShape(std::vector<Part>& parts, const SceneDescription::Shape& shape, const btTransform& pose,
			  const Colour& colour);

/// The scene's camera, or one that sees all bodies that move.
Camera cameraOf(const Simulation& simulation);
}  // namespace ep

#endif  // EP_SCENE_DRAWING_H
