// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_LOAD_HISTORY_H
#define BT_ELASTIC_PLASTIC_LOAD_HISTORY_H

#include "LinearMath/btVector3.h"

class btRigidBody;

namespace btElasticPlastic
{
/// How the load of a body, beside its weight, has changed from step to step.
///
/// Bullet's velocities belong to half a step before its places, and a load that a game applies by where a body is, as a spring of its own, gives it a force at the
/// right time by that. To inner steps velocities come with what loads have given in that half step. What has come at once is left out: it would be a blow.
struct LoadHistory
{
	/// Of forces [N], or of torques [N m].
	struct Part
	{
		btVector3 m_load = btVector3(0, 0, 0);    ///< in the last step
		btVector3 m_change = btVector3(0, 0, 0);  ///< since the one before it
		btScalar m_greatest = 0;                  ///< the length of such a change, lately
		btVector3 m_smooth = btVector3(0, 0, 0);  ///< what it has come to without what has come at once

		/// Takes what acts in the next step.
		void follow(const btVector3& load);

		bool isNothing() const { return m_load.isZero() && m_change.isZero() && m_smooth.isZero(); }
	};

	btRigidBody* m_body = nullptr;
	int m_proxy = -1;     ///< uid of the broadphase: tells the body from a later one at its address
	btScalar m_step = 0;  ///< length of the last step [s]
	Part m_force, m_torque;

	/// Takes the loads that act on the body in a step of dt [s]. It may be another body than before.
	void follow(btRigidBody& body, btScalar dt);

	bool isNothing() const { return m_force.isNothing() && m_torque.isNothing(); }
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_LOAD_HISTORY_H
