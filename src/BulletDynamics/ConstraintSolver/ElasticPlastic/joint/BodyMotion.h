// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BODY_MOTION_H
#define BT_ELASTIC_PLASTIC_BODY_MOTION_H

#include "../../btElasticPlasticInnerMotion.h"
#include "LinearMath/btTransform.h"

class btCollisionWorld;
class btRigidBody;

namespace btElasticPlastic
{
/// How a body has gone through a step that the solver has taken in several inner ones.
///
/// The solver leaves the body where it was, with its mean velocity, so that Bullet moves it as always, continuous collision
/// detection included. Afterwards the action puts it where the inner steps have ended.
struct BodyMotion
{
	btRigidBody* m_body = nullptr;
	int m_index = -1;  ///< in the world
	int m_proxy = -1;  ///< uid of the broadphase: tells the body from a later one at its address
	btTransform m_moved = btTransform::getIdentity();  ///< where Bullet moves it
	btTransform m_end = btTransform::getIdentity();
	btVector3 m_linear = btVector3(0, 0, 0), m_angular = m_linear;              ///< velocity at the end [m/s], [rad/s]
	btVector3 m_meanLinear = btVector3(0, 0, 0), m_meanAngular = m_meanLinear;  ///< with which Bullet moves it
	btElasticPlasticInnerMotion m_inner;
	bool m_isTouched = false;  ///< by a contact in the last inner step

	/// Ends the step after Bullet has moved the body. What others have given to its velocity since is kept, and so is the place where
	/// others have put it, or where continuous collision detection has stopped it. Does nothing if the body has left the world.
	void apply(btCollisionWorld& world) const;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_BODY_MOTION_H
