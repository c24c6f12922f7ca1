// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PICTURE_PROJECTION_H
#define EP_PICTURE_PROJECTION_H

#include "picture/Mesh.h"

namespace ep
{
/// Column by column, as OpenGL has it; clip coordinates from world coordinates.
struct Matrix
{
	float m[16];

	std::array<float, 4> operator*(const Vector& point) const;
};

/// A camera's axes of unit length, the x and y axes scaled to half the picture's size at distance 1.
struct CameraAxes
{
	Vector right, up, forward;
};

CameraAxes cameraAxes(const Camera& camera, float aspect);
Matrix cameraMatrix(const Camera& camera, float aspect);

/// Towards the sun, unit length.
Vector sunDirection();

/// For the shadow map: sees, from the sun and without perspective, the surroundings of a point. Depth -1 to 1.
Matrix sunMatrix(const btVector3& centre);
}  // namespace ep

#endif  // EP_PICTURE_PROJECTION_H
