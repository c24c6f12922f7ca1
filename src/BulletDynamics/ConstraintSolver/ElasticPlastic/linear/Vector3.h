// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_VECTOR3_H
#define BT_ELASTIC_PLASTIC_VECTOR3_H

namespace btElasticPlastic
{
// Operations on vectors in space, in double whatever Bullet's precision.

inline double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// to = a x b
inline void cross(const double* a, const double* b, double* to)
{
	to[0] = a[1] * b[2] - a[2] * b[1];
	to[1] = a[2] * b[0] - a[0] * b[2];
	to[2] = a[0] * b[1] - a[1] * b[0];
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_VECTOR3_H
