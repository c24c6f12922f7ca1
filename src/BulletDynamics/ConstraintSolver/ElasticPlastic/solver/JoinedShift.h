// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_JOINED_SHIFT_H
#define BT_ELASTIC_PLASTIC_JOINED_SHIFT_H

#include "../joint/Kinematics.h"
#include "Islands.h"

namespace btElasticPlastic
{
/// What the velocities of joined bodies get where steps become shorter.
///
/// A velocity belongs to a time half a step before that of the place. With a shorter step that time comes closer to the place's, and
/// in between joints' forces and loads act on: a swing that yields would otherwise lose or gain up to half a step of its forces,
/// a tenth of its energy and more. It is taken of the forces in the middle of that time, and of the loads that were there in the
/// last step and still are. Where steps become longer again nothing is taken back: forces that only the short ones resolve would
/// be velocities of their own. There the first long step damps (Law.h).
class JoinedShift
{
public:
	/// Whether any joint's last step was longer than h [s].
	static bool isWanted(const SolverGroup& island, btScalar h);

	/// Looks the forces up. A body that is also held by what is no spring of ours is left out.
	/// \param numBodies  of the island, which have their numbers as companion ids; others have none
	/// \param h          length of the coming steps [s]
	void collect(const SolverGroup& island, int numBodies, btScalar h);

	/// Has a body keep its velocity: what else acts on it is not known.
	void leaveOut(int number) { m_bodies[size_t(number)].m_isLeftOut = true; }

	/// Whether anybody keeps its velocity, so that the joints' impulses do not add up to zero.
	bool isAnyLeftOut() const;

	/// Whether a joint's other end stands on what is not of the island.
	bool hasSupport() const;

	/// Gives a body its share. \return what its loads have given to it [J]
	double apply(int number, btRigidBody& body);

	/// Books what the joints have given to those that have got theirs, as work of the joints.
	void bookWork();

private:
	struct Body
	{
		const btRigidBody* m_body = nullptr;  ///< null: it keeps its velocity
		bool m_isLeftOut = false;
		btScalar m_time = 0;                                            ///< between the two times [s]
		btVector3 m_impulse = btVector3(0, 0, 0), m_twist = m_impulse;  ///< of joints [N s], [N m s]
		btVector3 m_force = m_impulse, m_torque = m_impulse;  ///< loads of the last step beside its weight [N], [N m]
		btVector3 m_meanLinear = m_impulse, m_meanAngular = m_impulse;  ///< of before and after [m/s], [rad/s]
	};
	struct Joint
	{
		JointWorks* m_works;
		int m_bodies[2];  ///< -1: none of the island's
		Kinematics m_kinematics;
		btVector3 m_impulse, m_twist;  ///< about the common point, on body A [N s], [N m s]
	};

	void addJoint(JointWorks& works, const int bodies[2], btScalar h);

	std::vector<Body> m_bodies;
	std::vector<Joint> m_joints;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_JOINED_SHIFT_H
