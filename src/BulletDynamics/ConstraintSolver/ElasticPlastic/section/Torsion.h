// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_TORSION_H
#define BT_ELASTIC_PLASTIC_TORSION_H

#include "Region.h"

namespace btElasticPlastic
{
struct Torsion
{
	double m_constant;        ///< J [m^4]
	double m_plasticModulus;  ///< [m^3]
};

/// Torsion of a figure by the roof of unit slope on it, which is level over holes.
///
/// Plastic torsion is twice the volume under the roof (Nadai's sand heap, with holes: Sadowsky 1941). For elastic torsion Prandtl's stress function is
/// taken as a function of the roof's height d alone: with the area V(d) within the line of height d and that line's length L(d) the best
/// of these gives
///
///     J = integral of 4 V^2 / L over d,
///
/// which is never more than J. It is exact for circles, for tubes of even wall, and for thin walls, open or closed; 11 % low for a square, which is the
/// worst of rectangles, 17 % for a triangle of equal sides. Where that is much less than by elastic slips (Slips.h), a bound from above that is next to exact
/// for compact figures, these are taken.
Torsion torsionOf(const Region& region);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_TORSION_H
