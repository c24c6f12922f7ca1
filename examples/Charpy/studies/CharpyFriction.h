// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_FRICTION_H
#define EP_CHARPY_FRICTION_H

#include "test/CharpySettings.h"

namespace ep
{
/// What friction takes of a specimen in two halves that passes, if inertia is nothing; infinite if friction holds it. [J]
double quasiStaticFriction(const CharpySettings& settings);
}  // namespace ep

#endif  // EP_CHARPY_FRICTION_H
