// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "problems/Problem.h"

#include <cmath>

namespace ep
{
double Quantity::error() const { return std::isfinite(value) ? std::fabs(value / exact - 1) : HUGE_VAL; }
}  // namespace ep
