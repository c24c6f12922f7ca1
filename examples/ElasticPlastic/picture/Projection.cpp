// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "picture/Projection.h"

#include <cmath>

namespace ep
{
namespace
{
const float NEAR_PLANE = 0.5f, FAR_PLANE = 2000;
const float SHADOW_RADIUS = 65;  // [m]

struct Basis
{
	btVector3 right, up, forward;
};

Basis lookAt(const btVector3& eye, const btVector3& target)
{
	Basis b;
	b.forward = (target - eye).normalized();
	b.right = b.forward.cross(btVector3(0, 1, 0)).normalized();
	b.up = b.right.cross(b.forward);
	return b;
}

/// Rows: scaled right and up, then depth, then w; each a linear form of the position less the eye.
Matrix fromRows(const btVector3 (&axes)[4], const float (&offsets)[4], const btVector3& eye)
{
	Matrix result;
	for (int row = 0; row < 4; ++row)
	{
		for (int column = 0; column < 3; ++column)
			result.m[4 * column + row] = float(axes[row][column]);
		result.m[12 + row] = offsets[row] - float(axes[row].dot(eye));
	}
	return result;
}
}  // namespace

std::array<float, 4> Matrix::operator*(const Vector& p) const
{
	std::array<float, 4> result;
	for (int row = 0; row < 4; ++row)
		result[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row];
	return result;
}

CameraAxes cameraAxes(const Camera& camera, float aspect)
{
	const Basis b = lookAt(camera.eye, camera.target);
	const btScalar half = btScalar(std::tan(camera.fieldOfView / 2));
	return {toVector(b.right * half * aspect), toVector(b.up * half), toVector(b.forward)};
}

Matrix cameraMatrix(const Camera& camera, float aspect)
{
	const Basis b = lookAt(camera.eye, camera.target);
	const btScalar half = btScalar(std::tan(camera.fieldOfView / 2));
	const float range = FAR_PLANE - NEAR_PLANE;
	const btVector3 axes[4] = {b.right / (half * aspect), b.up / half,
							   b.forward * btScalar((FAR_PLANE + NEAR_PLANE) / range), b.forward};
	return fromRows(axes, {0, 0, -2 * FAR_PLANE * NEAR_PLANE / range, 0}, camera.eye);
}

Vector sunDirection() { return toVector(btVector3(btScalar(-.42), btScalar(.72), btScalar(.55)).normalized()); }

Matrix sunMatrix(const btVector3& centre)
{
	const Vector s = sunDirection();
	const Basis b = lookAt(centre + btVector3(s[0], s[1], s[2]), centre);
	const btVector3 axes[4] = {b.right / SHADOW_RADIUS, b.up / SHADOW_RADIUS, b.forward / SHADOW_RADIUS,
							   btVector3(0, 0, 0)};
	return fromRows(axes, {0, 0, 0, 1}, centre);
}
}  // namespace ep
