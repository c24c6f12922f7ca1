// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_STRUTS_H
#define EP_STRUTS_H

#include "problems/Problem.h"

namespace ep
{
/// What is pressed until it buckles.
std::vector<Problem> problemsOfStruts();
}  // namespace ep

#endif  // EP_STRUTS_H
