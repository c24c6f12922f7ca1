// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CURVES_H
#define EP_CURVES_H

#include "problems/Problem.h"

namespace ep
{
/// Curves of stress that fibres follow: hardening, softening, rate, heat.
std::vector<Problem> problemsOfCurves();
}  // namespace ep

#endif  // EP_CURVES_H
