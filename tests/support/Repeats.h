// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_REPEATS_H
#define EP_TEST_REPEATS_H

#include <stdlib.h>

/// How often a test does the same with other numbers: where EP_LONG_TESTS is in the environment all that was asked for, else as many as
/// would have found what has ever been found.
inline int repeats(int all, int some) { return getenv("EP_LONG_TESTS") ? all : some; }

#endif  // EP_TEST_REPEATS_H
