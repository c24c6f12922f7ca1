// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_CLOSE_H
#define EP_TEST_CLOSE_H

#include <math.h>

#include <gtest/gtest.h>

#include "support/Precision.h"

/// Relative; the default is for what is computed in double and rounded once or twice.
inline void expectClose(double expected, double actual, double relative = byPrecision(1e-12, 1e-6))
{
	EXPECT_NEAR(expected, actual, relative * fabs(expected));
}

#endif  // EP_TEST_CLOSE_H
