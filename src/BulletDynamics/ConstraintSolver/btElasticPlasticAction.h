// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_ACTION_H
#define BT_ELASTIC_PLASTIC_ACTION_H

#include "BulletDynamics/Dynamics/btActionInterface.h"
#include "btElasticPlasticEvent.h"
#include "btElasticPlasticJoint.h"
#include "btElasticPlasticPrecision.h"

class btDynamicsWorld;

namespace btElasticPlastic
{
class JointRegistry;
class Snapshot;
}  // namespace btElasticPlastic

/// The registry of a world's elastic-plastic joints: one per world, added with btDynamicsWorld::addAction.
/// Once per substep it commits every joint that was solved, takes broken ones out of the world, and reports events.
/// A broken joint whose bodies overlap stays in the world without rows until they have parted, so that they are not shot apart.
///
/// It owns nothing. Joints may be deleted, removed from the world or from here, in any order, before the world; so may the action.
/// As in Bullet, a body must not leave the world before its constraints do: removeBody() takes care of that.
class btElasticPlasticAction : public btActionInterface
{
public:
	btElasticPlasticAction(btElasticPlasticOwnPrecision = {});
	~btElasticPlasticAction() override;
	btElasticPlasticAction(const btElasticPlasticAction&) = delete;
	btElasticPlasticAction& operator=(const btElasticPlasticAction&) = delete;

	/// Takes a joint into the registry; the world gets it, as ever, by btDynamicsWorld::addConstraint.
	/// A joint belongs to one action; adding it again does nothing, adding it to another one moves it there.
	/// \return false if the joint is refused, see btElasticPlasticJoint::fault; the listener is told why.
	bool addJoint(btElasticPlasticJoint* joint);

	/// Forgets a joint and its events. It stays in the world if it is not broken, but does nothing there any more.
	void removeJoint(btElasticPlasticJoint* joint);

	/// Takes a body and all its constraints out of the world, elastic-plastic or not, and forgets its joints, broken ones too.
	/// Delete the joints, or at least do nothing with them any more, before you delete the body: Bullet's removeConstraint would look
	/// for a body that is gone.
	void removeBody(btDynamicsWorld& world, btRigidBody& body);

	/// Breaks a joint on purpose, as if its ductility were spent: it leaves the world, its bodies wake and collide again, and the break
	/// is told, to a listener before this returns (if a listener calls it, right after that). Its damage stays as it is.
	/// To be called between steps, or by a listener that is told of events.
	/// \return false, and nothing happens, if the joint is broken, not known here, or not in the world
	bool breakJoint(btDynamicsWorld& world, btElasticPlasticJoint* joint);

	/// Puts a broken joint back into its world as new: no force, no plastic deformation, no damage, at the bodies' present pose.
	/// \return false if the joint is not broken or not known here, or a body of it that moves is in no world.
	bool repair(btElasticPlasticJoint* joint);

	int getNumJoints();
	int getNumBroken() const;

	/// Joints in the order they were added; broken ones come last, in the order they broke.
	btElasticPlasticJoint* getJoint(int index);

	/// Joints known here that hold and are in a world, in the order they were added. Unlike those of getJoint() they have their
	/// bodies, even if a user has taken joints out of the world and deleted theirs.
	/// \param joints  what it held before is gone
	void getJointsInWorld(const btDynamicsWorld& world, btAlignedObjectArray<btElasticPlasticJoint*>& joints);

	/// With a listener, events go to it and not to the queue. Null: back to the queue. It must outlive the action.
	void setListener(btElasticPlasticListener* listener);

	/// Takes the oldest event from the queue. \return false if there is none.
	/// The queue holds the newest yield and the newest break of each joint that the action knows: unread, it stays bounded.
	bool popEvent(btElasticPlasticEvent& event);

	/// Sum of the substeps seen [s].
	double getTime() const;

	void updateAction(btCollisionWorld* world, btScalar timeStep) override;

	/// Draws the joints whose bodies are in the world, see btElasticPlasticDebugDraw.h; before the world's first step, none.
	void debugDraw(btIDebugDraw* drawer) override;

private:
	friend class btElasticPlastic::Snapshot;

	btElasticPlastic::JointRegistry* const m_registry;
};

#endif  // BT_ELASTIC_PLASTIC_ACTION_H
