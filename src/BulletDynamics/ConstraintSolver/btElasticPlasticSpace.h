/*
Bullet Elastic-Plastic: joints for Bullet Physics that bend before they break
Copyright (c) 2026 Bullet Elastic-Plastic contributors

This software is provided 'as-is', without any express or implied warranty.
In no event will the authors be held liable for any damages arising from the use of this software.
Permission is granted to anyone to use this software for any purpose,
including commercial applications, and to alter it and redistribute it freely,
subject to the following restrictions:

1. The origin of this software must not be misrepresented; you must not claim that you wrote the original software. If you use this software in a product, an acknowledgment in the product documentation would be appreciated but is not required.
2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the original software.
3. This notice may not be removed or altered from any source distribution.
*/

#ifndef BT_ELASTIC_PLASTIC_SPACE_H
#define BT_ELASTIC_PLASTIC_SPACE_H

// Vectors in space, in double whatever Bullet's precision.

inline double btElasticPlasticDot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// to = a x b
inline void btElasticPlasticCross(const double* a, const double* b, double* to)
{
	to[0] = a[1] * b[2] - a[2] * b[1];
	to[1] = a[2] * b[0] - a[0] * b[2];
	to[2] = a[0] * b[1] - a[1] * b[0];
}

#endif  // BT_ELASTIC_PLASTIC_SPACE_H
