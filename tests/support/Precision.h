// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_PRECISION_H
#define EP_TEST_PRECISION_H

#include "LinearMath/btScalar.h"

/// A tolerance per precision of Bullet.
inline double byPrecision(double inDouble, double inFloat)
{
	return sizeof(btScalar) == sizeof(double) ? inDouble : inFloat;
}

#endif  // EP_TEST_PRECISION_H
