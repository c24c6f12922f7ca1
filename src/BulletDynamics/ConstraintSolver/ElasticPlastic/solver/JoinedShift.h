// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_JOINED_SHIFT_H
#define BT_ELASTIC_PLASTIC_JOINED_SHIFT_H

#include <vector>

#include "../joint/Kinematics.h"
#include "Islands.h"
#include "LinearMath/btAlignedObjectArray.h"

class btRigidBody;

namespace btElasticPlastic
{
/// What the velocities of joined bodies get where steps become shorter, and give back where they become longer.
///
/// A velocity belongs to a time half a step before that of the place. With a shorter step that time comes closer to the place's, and
/// in between joints' forces and loads act on: a swing that yields would otherwise lose or gain up to half a step of its forces,
/// a tenth of its energy and more. It is taken of the forces in the middle of that time, and of the loads that were there in the
/// last step and still are.
///
/// Forces that a long step has not resolved would be a blow: all shares are less by one factor where else the joints would give
/// energy to the bodies, where something flows they and the loads together, too.
class JoinedShift
{
public:
	/// Whether any joint's last step was not h [s].
	static bool isWanted(const SolverGroup& island, btScalar h);

	/// Looks the forces up. A body that is also held by what is no spring of ours is left out.
	/// \param bodies  of the island that may move
	/// \param h       length of the coming steps [s]
	void collect(const SolverGroup& island, const std::vector<btRigidBody*>& bodies, btScalar h);

	/// Has a body keep its velocity: what else acts on it is not known.
	void leaveOut(int body) { m_bodies[body].m_isLeftOut = true; }

	/// Whether any does, so that the joints' impulses do not add up to zero.
	bool isAnyLeftOut() const;

	/// Finds what all bodies get, after the last leaveOut().
	/// \param withLoads  otherwise what joints give alone: the bodies fall, and have got their weight's share
	void find(bool withLoads);

	/// The kinetic energy of what was found, alone [J].
	double getEnergy() const;

	/// Gives it to the bodies, or a share of it, and books what the joints have given as their work.
	/// \param isResolved  steps have been chosen that resolve the joints' forces: all of it, and the joints' steps count as even
	void apply(bool isResolved);

	/// What a body's loads have given to it [J].
	double getLoadWork(int body) const;
	/// Of that what its weight has given to it [J].
	double getWeightWork(int body) const;

private:
	struct Body
	{
		btRigidBody* m_body;
		bool m_isLeftOut;
		btScalar m_time;                        ///< between the two times, below 0 where steps become longer [s]
		btVector3 m_impulse, m_twist;           ///< of joints [N s], [N m s]
		btVector3 m_force, m_torque;            ///< loads of the last step beside its weight [N], [N m]
		btVector3 m_weight;                     ///< its part of what loads give [N s]
		btVector3 m_linear, m_angular;          ///< velocity that it gets [m/s], [rad/s]
		btVector3 m_meanLinear, m_meanAngular;  ///< of before and after
	};
	struct Joint
	{
		JointWorks* m_works;
		int m_bodies[2];  ///< -1: none of the island's
		Kinematics m_kinematics;
		btVector3 m_impulse, m_twist;  ///< about the common point, on body A [N s], [N m s]
	};

	static double givenTo(const Joint& joint, int side, const btVector3& velocity, const btVector3& spin);
	static double givenToSupport(const Joint& joint, int side);
	void addJoint(JointWorks& works, const int bodies[2], btScalar h);
	btScalar findShare(bool isResolved) const;
	bool isLeftOut(int body) const { return body >= 0 && m_bodies[body].m_isLeftOut; }
	void bookWork(btScalar share);

	btAlignedObjectArray<Body> m_bodies;
	btAlignedObjectArray<Joint> m_joints;
	bool m_isAnyAtBound = false;  ///< of the joints' rows
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_JOINED_SHIFT_H
