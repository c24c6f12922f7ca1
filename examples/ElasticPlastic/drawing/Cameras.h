// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CAMERAS_H
#define EP_CAMERAS_H

#include "drawing/Drawing.h"

namespace ep
{
/// Behind the subject and above it, and from a little to the side.
Camera chaseCamera(const btTransform& subject);

/// From the side, so that the extent along x fits into a picture of the given width over height.
Camera sideCamera(const btVector3& centre, btScalar extent, float aspect);
}  // namespace ep

#endif  // EP_CAMERAS_H
