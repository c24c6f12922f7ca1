// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CAMERAS_H
#define EP_CAMERAS_H

#include "drawing/Bounds.h"
#include "drawing/Drawing.h"

namespace ep
{
/// What covers a picture at its edges: shares of its width and height.
struct Margins
{
	float left = 0, right = 0, bottom = 0, top = 0;
};

/// Looks along a direction, from as near as the bounds are still whole in what the margins leave of the picture.
/// \param aspect  the picture's width over its height
Camera framingCamera(const Bounds& bounds, const btVector3& direction, float aspect, const Margins& margins = {});

/// Behind the subject, above it and a little to the side; beside it where it is close to what it drives at, which it would hide.
/// \param closeness  from 0, far away, to 1
Camera chaseCamera(const btTransform& subject, btScalar closeness = 0);

/// Moved aside until its target is in the middle between the left and the right margin, and back if that is narrow.
Camera movedAside(Camera camera, float aspect, const Margins& margins);
}  // namespace ep

#endif  // EP_CAMERAS_H
