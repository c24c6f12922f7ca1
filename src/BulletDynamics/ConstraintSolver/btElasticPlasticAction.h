// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_ACTION_H
#define BT_ELASTIC_PLASTIC_ACTION_H

#include "BulletDynamics/Dynamics/btActionInterface.h"
#include "btElasticPlasticDebugDraw.h"
#include "btElasticPlasticEvent.h"
#include "btElasticPlasticInnerMotion.h"
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
class alignas(16) btElasticPlasticAction : public btActionInterface
{
public:
	BT_DECLARE_ALIGNED_ALLOCATOR();

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

	/// Puts a broken joint back into the world that it has left as new: no force, no plastic deformation, no damage, at the bodies'
	/// present pose. One that was in no world when it became broken stays out of it.
	/// \return false if the joint is not broken or not known here, a body of it that moves is in no world, or both have left that world
	/// since, which may be gone: then name the world.
	bool repair(btElasticPlasticJoint* joint);

	/// The same into a world that its bodies are in.
	bool repair(btDynamicsWorld& world, btElasticPlasticJoint* joint);

	int getNumJoints();
	int getNumBroken() const;

	/// Joints in the order they were added; broken ones come last, in the order they broke. \return null where there is none
	btElasticPlasticJoint* getJoint(int index);

	/// Joints known here that hold and are in a world, in the order they were added. Unlike those of getJoint() they have their
	/// bodies, even if a user has taken joints out of the world and deleted theirs.
	/// \param joints  what it held before is gone
	void getJointsInWorld(const btDynamicsWorld& world, btAlignedObjectArray<btElasticPlasticJoint*>& joints);

	/// With listeners, events go to them, in the order in which they were added, and not to the queue. They must outlive the action
	/// or be removed before; both may be done while events are told. Adding one again does nothing, nor does null.
	void addListener(btElasticPlasticListener* listener);
	void removeListener(btElasticPlasticListener* listener);

	/// Makes this the only listener. Null: none, back to the queue.
	void setListener(btElasticPlasticListener* listener);

	/// Takes the oldest event from the queue. \return false if there is none.
	/// The queue holds the newest event of each joint and kind: yield, break, a quantity that has passed its level, and the crack and the rupture of
	/// each fibre. Unread, it stays bounded.
	bool popEvent(btElasticPlasticEvent& event);

	/// Bullet lets bodies sleep by their speed alone. Bodies stay awake, too, while the load of a joint of theirs changes within two
	/// seconds by more than this share of its yield value, or what it stands on, a static or kinematic body, moves; a joint
	/// that flows changes its load in this sense as far as the flow is as large. A sleeping structure wakes when what it stands on
	/// moves, and when a joint of it gets another capacity.
	/// \param share  0 (any change) to btElasticPlasticCapacity::unlimited() (nothing: sleep is left to Bullet); default 0.05.
	/// Vibrations that are larger keep a structure awake.
	/// \return false, and nothing changes, if it is out of range
	bool setWakingShare(btScalar share);
	btScalar getWakingShare() const;

	/// Sum of the substeps seen [s].
	double getTime() const;

	/// How a body has gone through the last substep. \return false, and nothing is written, if the solver has taken it as a whole
	bool getInnerMotion(const btRigidBody& body, btElasticPlasticInnerMotion& motion) const;

	void updateAction(btCollisionWorld* world, btScalar timeStep) override;

	/// Draws the joints whose bodies are in the world in the colours of their use, see btElasticPlasticDebugDraw.h; before the world's
	/// first step, none. Bullet calls it from debugDrawWorld() in the modes DBG_DrawWireframe, DBG_DrawAabb and DBG_DrawNormals; in any
	/// other call it yourself after debugDrawWorld().
	void debugDraw(btIDebugDraw* drawer) override;

	/// How debugDraw() draws. \return false, and nothing changes, if a number is not finite or a size negative
	bool setDrawing(const btElasticPlasticDrawing& drawing);
	const btElasticPlasticDrawing& getDrawing() const { return m_drawing; }

private:
	friend class btElasticPlastic::Snapshot;
	friend class btElasticPlasticStepControl;

	btElasticPlastic::JointRegistry* const m_registry;
	btElasticPlasticDrawing m_drawing;
};

#endif  // BT_ELASTIC_PLASTIC_ACTION_H
