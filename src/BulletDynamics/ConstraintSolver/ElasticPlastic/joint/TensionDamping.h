// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_TENSION_DAMPING_H
#define BT_ELASTIC_PLASTIC_TENSION_DAMPING_H

#include "JointModel.h"

namespace btElasticPlastic
{
/// What keeps a taut joint's arms from making energy.
///
/// When a body turns, the force at its joint keeps its direction and the arm does not: with the tension N along the line of
/// centres and arms rA, rB along it, the pair has the geometric stiffness
///
///     k = N rA rB / (rA + rB)
///
/// against turning relative to each other at a right angle to the line (for a straight row of equal blocks that is the whole of the
/// highest mode's stiffness; compared with turns of the bodies by themselves it leaves alone what turns as a whole). Bullet's step
/// takes the arms as they are at its beginning: the stiffness is explicit, and unstable once it turns the lighter body through more
/// than 2 radians of its period in a step. So the step's end is brought in: a row about each of two directions across the line asks for
/// lambda = -g (relative spin at the end of the step), the change of the torque over the step, with g = k dt^2.
///
/// Longer waves of a row of blocks have only a share of their stiffness in relative turns, by the square of the sine of half
/// their wave number; a spring of which the implicit share is s is stable below (w dt)^2 = 4 / (1 - 2 s). For a row of equal
/// blocks that asks for B times as much g once the highest mode's (w dt)^2 = z is above 80 B. Taken is a quarter of that. More g
/// than k dt^2 is damping, of bending alone: what such a step cannot resolve comes to rest.
///
/// It is the less mobile body of a pair that counts: a heavy one, which the step resolves, is a support, and no more than a support may it
/// hold the turn of the light one, or a string between heavy ends would be clamped there and ring too high.
///
/// Arms reach to the joint or, if that is more, to the middle of what is elastic (btElasticPlasticCapacity::elasticMiddle()).
///
/// Compression gives a negative stiffness, which is buckling, and is left to the step as it is.
struct TensionDamping
{
	btScalar m_factor = 0;  ///< g [N m s / (rad/s)], 0: none
	btVector3 m_across[2];  ///< the two directions, unit length

	/// \param k   the joint's axes and arms
	/// \param dt  of the step [s]
	static TensionDamping of(const JointModel& model, const Kinematics& k, btScalar dt);
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_TENSION_DAMPING_H
