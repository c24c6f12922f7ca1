// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SECTION_STRENGTH_H
#define EP_SECTION_STRENGTH_H

#include <utility>
#include <vector>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticJoint.h"

namespace ep
{
/// What a joint's fibres bear of axial force and of one moment together: the corners of a closed, convex line of (N, M) [N], [N m]. None without fibres.
/// \param isAboutZ  the moment about z, else y
/// \param isNow     without fibres that have gone, and without the tension of those that have cracked
std::vector<std::pair<double, double>> sectionStrength(const btElasticPlasticJoint& joint, bool isAboutZ, bool isNow);
}  // namespace ep

#endif  // EP_SECTION_STRENGTH_H
