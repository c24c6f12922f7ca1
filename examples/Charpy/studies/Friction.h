// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_FRICTION_H
#define EP_CHARPY_FRICTION_H

#include "test/Settings.h"

namespace ep::charpy
{
/// What friction takes of a specimen in two halves that passes, if inertia is nothing; infinite if friction holds it. [J]
double quasiStaticFriction(const Settings& settings);
}  // namespace ep::charpy

#endif  // EP_CHARPY_FRICTION_H
