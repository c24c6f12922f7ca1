// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_TENSION_DAMPING_H
#define BT_ELASTIC_PLASTIC_TENSION_DAMPING_H

#include "JointModel.h"

namespace btElasticPlastic
{
/// What keeps a taut joint's arms from making energy: rows about the line of centres and across it, each of which asks for
/// lambda = -g (relative spin at the end of the step).
///
/// **Across the line.** When a body turns, the force at its joint keeps its direction and the arm does not: with the tension N along
/// the line of centres and arms rA, rB along it, the pair has the geometric stiffness
///
///     k = N rA rB / (rA + rB)
///
/// against turning relative to each other at a right angle to the line (for a straight row of equal blocks that is the whole of the
/// highest mode's stiffness; compared with turns of the bodies by themselves it leaves alone what turns as a whole). Bullet's step
/// takes the arms as they are at its beginning: the stiffness is explicit, and unstable once it turns the lighter body through more
/// than 2 radians of its period in a step. So the step's end is brought in: lambda is the change of the torque over the step, with
/// g = k dt^2.
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
///
/// **About the line.** A body that turns with w and spins about its own axis with p moves the end r of its arm straight on in a step,
/// and thereby out of the plane in which the arm turns by dt^2 p |w x r| / 2. The joint's force F acts in the middle of the gap that this
/// leaves, with a torque about the axis of up to F dt^2 p |w x r| / 4 if it is not along the arm. That drives the spin that has made it,
/// and a slender body has next to no inertia about its axis: of rounding it makes hundreds of radians a second in ten steps. Hence
///
///     g = dt^3 F (|wA x rA| + |wB x rB|) / 4,
///
/// also towards what does not move. It vanishes where nothing turns, and is left out where the joint bears torsion that is stiffer.
struct TensionDamping
{
	struct Row
	{
		btVector3 m_axis;   ///< unit length
		btScalar m_factor;  ///< g [N m s / (rad/s)], > 0
	};

	int m_numRows = 0;
	Row m_row[3];

	/// \param k      the joint's axes and arms
	/// \param force  along these axes [N]
	/// \param dt     of the step [s]
	static TensionDamping of(const JointModel& model, const Kinematics& k, const btScalar force[3], btScalar dt);

	/// Of all rows [N m s / (rad/s)].
	btScalar getSum() const
	{
		btScalar sum = 0;
		for (int i = 0; i < m_numRows; ++i)
			sum += m_row[i].m_factor;
		return sum;
	}

private:
	void add(const btVector3& axis, btScalar factor);
	void addAcross(const JointModel& model, const Kinematics& k, const btVector3& force, btScalar dt);
	void addAlong(const JointModel& model, const Kinematics& k, const btVector3& force, btScalar dt);
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_TENSION_DAMPING_H
