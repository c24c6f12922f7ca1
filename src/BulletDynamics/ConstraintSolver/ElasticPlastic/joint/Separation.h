// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SEPARATION_H
#define BT_ELASTIC_PLASTIC_SEPARATION_H

#include "LinearMath/btScalar.h"

class btCollisionWorld;
class btDynamicsWorld;
class btRigidBody;
class btTypedConstraint;

namespace btElasticPlastic
{
/// The time from a joint's break until its bodies have parted.
///
/// Two bodies whose joint has broken collide again, but they may overlap: a bent joint has pushed their corners into each other.
/// Bullet would push them apart at high speed, and so create energy. Until they are apart, their contacts therefore only stop
/// motion that would deepen the overlap, and do not push. For this the broken constraint stays in the world without rows,
/// because constraints are called between collision detection and solver.
class Separation
{
public:
	/// Begins if the bodies overlap now: puts the constraint, which has just left the world, back into it without keeping its
	/// bodies from colliding. \return whether it has begun
	bool begin(btDynamicsWorld& world, btTypedConstraint& constraint);

	/// Takes the constraint out of the world, if it is still there: a user may have done so, and deleted its bodies.
	/// \param world  null: gone
	void end(btDynamicsWorld* world, btTypedConstraint& constraint);

	/// Goes on with one that was under way when a snapshot was taken.
	/// \param overlap  of the bodies in the last step [m]
	void resume(btDynamicsWorld& world, btTypedConstraint& constraint, btScalar overlap);

	bool isUnderWay() const { return m_world != nullptr; }
	btScalar getOverlap() const { return m_overlap; }

	/// Whether the bodies were apart in the last step.
	bool isDone() const;

	/// Sets the penetration of the bodies' contact points to zero for the step that is being set up.
	void holdOverlap(btTypedConstraint& constraint);

private:
	btDynamicsWorld* m_world =
		nullptr;             ///< while it is under way; the pointer is valid only when the world calls the constraint
	btScalar m_overlap = 0;  ///< of the bodies in the last step [m]
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SEPARATION_H
