// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_NOT_FINITE_H
#define EP_TEST_NOT_FINITE_H

#include <limits>

#include "LinearMath/btScalar.h"

// Numbers that are not finite, as games have them: from memory, at run time. With -ffast-math a compiler that sees such a constant
// may take whatever it likes for what is computed with it.

inline btScalar notANumber()
{
	const volatile btScalar inMemory = std::numeric_limits<btScalar>::quiet_NaN();
	return inMemory;
}

inline btScalar infinite()
{
	const volatile btScalar inMemory = std::numeric_limits<btScalar>::infinity();
	return inMemory;
}

#endif  // EP_TEST_NOT_FINITE_H
