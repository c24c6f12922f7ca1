// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_PRECISION_H
#define EP_TEST_PRECISION_H

#include "LinearMath/btScalar.h"

/// With -ffast-math compilers take float's roots and quotients from estimates of 12 bits, improved once: two bits less than 24.
#ifdef __FAST_MATH__
const double FLOAT_ROUNDING = 4;
#else
const double FLOAT_ROUNDING = 1;
#endif

/// A value per precision of Bullet that is no tolerance of rounding: a setting of a test, or a bound of what is not rounding.
inline double inPrecision(double inDouble, double inFloat)
{
	return sizeof(btScalar) == sizeof(double) ? inDouble : inFloat;
}

/// A tolerance per precision of Bullet, where rounding decides.
inline double byPrecision(double inDouble, double inFloat) { return inPrecision(inDouble, inFloat * FLOAT_ROUNDING); }

#endif  // EP_TEST_PRECISION_H
