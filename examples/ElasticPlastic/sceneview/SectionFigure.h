// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SECTION_FIGURE_H
#define EP_SECTION_FIGURE_H

#include "BulletDynamics/ConstraintSolver/btElasticPlasticJoint.h"
#include "drawing/Figure.h"

namespace ep
{
/// Axial force and bending moment of a joint at a time [N], [N m].
struct SectionForces
{
	float axial, moment[2];  ///< about y and about z

	static SectionForces of(const btElasticPlasticJoint& joint);
};

/// A section with its fibres: red when pulled, blue when pressed, full at their strength; darker as they are worn, black when they have gone.
Figure drawSection(const btElasticPlasticJoint& joint);

/// What a section bears of axial force and the larger of its moments, as it was and as it is now, and the way of the joint's forces in it.
Figure drawForces(const btElasticPlasticJoint& joint, const std::vector<SectionForces>& way);

/// Which fibre rules, in a line.
std::string describeRulingFibre(const btElasticPlasticJoint& joint);
}  // namespace ep

#endif  // EP_SECTION_FIGURE_H
