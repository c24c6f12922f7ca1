// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_COURSE_H
#define EP_COURSE_H

#include "scenefile/SceneDescription.h"

namespace ep
{
/// A load's factor at a time [s].
double factorAt(const SceneDescription::Course& course, double time);

/// A place on a path at a time [s]: straight between its points, at rest before and after them.
btVector3 onPath(const std::vector<std::pair<double, btVector3>>& path, double time);

/// Mean over a step of a pulse that rises at once and falls to nothing, straight, in its duration: a step that is longer gets
/// all of its impulse.
double meanOfPulse(double begin, double duration, double time, double dt);
}  // namespace ep

#endif  // EP_COURSE_H
