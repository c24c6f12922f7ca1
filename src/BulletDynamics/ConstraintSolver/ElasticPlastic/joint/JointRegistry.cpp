// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "JointRegistry.h"

#include "../../btElasticPlasticJoint.h"
#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "LinearMath/btHashMap.h"
#include "LinearMath/btIDebugDraw.h"
#include "JointWorks.h"
#include "SupportWay.h"

namespace btElasticPlastic
{
namespace
{
bool joins(const btTypedConstraint& constraint, const btRigidBody& body)
{
	return &constraint.getRigidBodyA() == &body || &constraint.getRigidBodyB() == &body;
}

bool isIn(const btDynamicsWorld& world, const btTypedConstraint& constraint)
{
	for (int i = 0; i < world.getNumConstraints(); ++i)
		if (world.getConstraint(i) == &constraint)
			return true;
	return false;
}

/// Bullet's search for islands has a body's tag for an index, also of one that has left the world, and crashes on the -1 that it has until
/// the world's first step. 0 is the index of a body that is there, unless nothing in the world can move; steps set the tags of what is in it.
void tagForIslands(btTypedConstraint& constraint)
{
	for (btRigidBody* const body : {&constraint.getRigidBodyA(), &constraint.getRigidBodyB()})
		if (!body->isStaticOrKinematicObject() && body->getIslandTag() < 0)
			body->setIslandTag(0);
}
}  // namespace

bool keepsFromColliding(btTypedConstraint& constraint)
{
	// A body refers to the constraints that keep it from colliding.
	btRigidBody& body = constraint.getRigidBodyA();
	for (int i = 0; i < body.getNumConstraintRefs(); ++i)
		if (body.getConstraintRef(i) == &constraint)
			return true;
	return false;
}

void JointRegistry::Entry::setIndex(int index) const { m_joint->m_entry.m_index = index; }

void JointRegistry::Entry::leave(btDynamicsWorld& world)
{
	btTypedConstraint& constraint = m_joint->m_model.m_constraint;
	m_world = &world;
	m_disableCollisions = keepsFromColliding(constraint);
	m_hasLeft = true;
	for (int side = 0; side < 2; ++side)
	{
		const btRigidBody& body = side == 0 ? constraint.getRigidBodyA() : constraint.getRigidBodyB();
		m_proxies[side] = body.getBroadphaseHandle();
		m_uids[side] = m_proxies[side] ? m_proxies[side]->getUid() : 0;
	}
}

bool JointRegistry::Entry::isWorldThere() const
{
	// A body that leaves a world, or whose world is deleted, loses its proxy; in another world it has another one.
	const JointModel& model = m_joint->m_model;
	for (int side = 0; side < 2; ++side)
	{
		const btBroadphaseProxy* const proxy = (side == 0 ? model.bodyA() : model.bodyB()).getBroadphaseHandle();
		if (proxy && proxy == m_proxies[side] && proxy->getUid() == m_uids[side])
			return true;
	}
	return false;
}

JointRegistry::~JointRegistry()
{
	while (getNumJoints() > 0)
		remove(getJoint(0));
	if (m_watch)
		m_watch->m_isDeleted = true;
	*m_substepShare = 1;
}

// ---- joints

JointWorks& JointRegistry::getJoint(int index)
{
	const int holding = m_joints.getCount();
	return index < holding ? *m_joints.get(index).m_joint : *m_broken.get(index - holding).m_joint;
}

bool JointRegistry::isBroken(const JointWorks& joint)
{
	const int index = joint.m_entry.m_index;
	return index < m_broken.getEnd() && m_broken[index].m_joint == &joint;
}

bool JointRegistry::add(JointWorks& joint)
{
	const bool wasRefused = bool(joint.m_model.m_fault);
	const btElasticPlasticFault fault = joint.m_model.findFault(), missingWorld = joint.m_model.findMissingWorld();
	joint.setFault(fault ? fault : missingWorld);
	// Bullet's search for islands crashes on a constraint one of whose bodies has never been in the world.
	joint.setOutOfIslands(bool(missingWorld));
	tagForIslands(joint.m_model.m_constraint);
	joint.forgetUncommitted();
	joint.forgetStepFault();
	joint.m_step.revert();
	if (joint.m_model.m_fault)
	{
		joint.tellFault(this);
		return false;
	}
	if (wasRefused)
		joint.releaseBase();
	if (joint.m_entry.m_registry == this)
		return true;
	if (joint.m_entry.m_registry)
		joint.m_entry.m_registry->remove(joint);
	joint.m_entry.m_registry = this;
	joint.m_entry.m_number = m_numNumbers++;
	SupportWay(joint.m_model).find();
	(joint.m_model.m_state.m_broken ? m_broken : m_joints).append(Entry(&joint));
	m_hasNew = true;
	return true;
}

void JointRegistry::remove(JointWorks& joint)
{
	if (joint.m_entry.m_registry != this)
		return;
	endSeparation(joint);
	m_events.forget(joint.m_entry.m_events);
	(isBroken(joint) ? m_broken : m_joints).remove(joint.m_entry.m_index);
	joint.m_entry.m_registry = nullptr;
	if (m_told && m_told->m_joint == &joint.m_joint)
		m_told->m_joint = nullptr;
}

void JointRegistry::wake(btRigidBody& body)
{
	const bool slept = !body.isActive();
	body.activate();
	// Bullet gives bodies their weight before the first substep, and takes it off after the last one.
	if (slept && body.isActive() && m_isCommitting)
		body.applyGravity();
}

/// Wakes what a body of a world touches or is joined to: it may have stood on it.
void JointRegistry::wakeNeighbours(btDynamicsWorld& world, btRigidBody& body)
{
	for (int i = 0; i < world.getNumConstraints(); ++i)
		if (joins(*world.getConstraint(i), body))
		{
			wake(world.getConstraint(i)->getRigidBodyA());
			wake(world.getConstraint(i)->getRigidBodyB());
		}
	btDispatcher& dispatcher = *world.getDispatcher();
	for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
	{
		const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
		const btCollisionObject* const bodies[2] = {manifold.getBody0(), manifold.getBody1()};
		for (int side = 0; side < 2; ++side)
			if (bodies[side] == &body && manifold.getNumContacts() > 0)
				if (btRigidBody* other = btRigidBody::upcast(const_cast<btCollisionObject*>(bodies[1 - side])))
					wake(*other);
	}
}

void JointRegistry::removeBody(btDynamicsWorld& world, btRigidBody& body)
{
	wakeNeighbours(world, body);
	for (int i = world.getNumConstraints() - 1; i >= 0; --i)
		if (joins(*world.getConstraint(i), body))
			world.removeConstraint(world.getConstraint(i));
	removeJointsOf(body, m_joints);
	removeJointsOf(body, m_broken);
	world.removeRigidBody(&body);
}

void JointRegistry::removeJointsOf(const btRigidBody& body, List& list)
{
	for (int i = list.getEnd() - 1; i >= 0; --i)
		if (i < list.getEnd() && !list[i].isGap() && joins(list[i].m_joint->m_model.m_constraint, body))
			remove(*list[i].m_joint);
}

bool JointRegistry::breakJoint(btDynamicsWorld& world, JointWorks& joint)
{
	// One that is not in the world may have bodies that are deleted.
	if (joint.m_entry.m_registry != this || isBroken(joint) || !isIn(world, joint.m_model.m_constraint))
		return false;
	report(BT_EP_EVENT_BREAK, joint);
	joint.m_model.m_state.m_broken = true;
	joint.m_step.revert();
	moveToBroken(joint);
	removeBrokenFromWorld(world);
	joint.wakeBodies();
	// Called by a listener, the event comes after the one that it is being told.
	if (!m_told)
		deliver();
	return true;
}

void JointRegistry::moveToBroken(JointWorks& joint)
{
	m_joints.remove(joint.m_entry.m_index);
	m_broken.append(Entry(&joint));
}

btElasticPlasticFault JointRegistry::putBack(JointWorks& joint, btDynamicsWorld* world)
{
	// A body without a broadphase handle is in no world: it has left its world, or that has been deleted.
	if (const btElasticPlasticFault fault = joint.m_model.findMissingWorld())
		return fault;
	const Entry entry = m_broken[joint.m_entry.m_index];
	if (!world && entry.m_world && !entry.isWorldThere())
		return btElasticPlasticFault("number of bodies that have stayed in the world that the joint has left", 0,
									 "1 or 2: call btElasticPlasticAction::repair with the world");
	m_broken.remove(joint.m_entry.m_index);
	endSeparation(joint);
	btDynamicsWorld* const to = world ? world : entry.m_world;
	if (to && !isIn(*to, joint.m_model.m_constraint))
		to->addConstraint(&joint.m_model.m_constraint, entry.m_disableCollisions);
	m_joints.append(Entry(&joint));
	joint.m_entry.m_worldIndex = 0;
	return btElasticPlasticFault();
}

bool JointRegistry::repair(JointWorks& joint, btDynamicsWorld* world)
{
	if (joint.m_entry.m_registry != this || !isBroken(joint) || putBack(joint, world))
		return false;
	joint.m_model.m_state = btElasticPlasticState();
	joint.m_model.setReferenceToCurrentPose();
	SupportWay(joint.m_model).find();
	joint.m_step.revert();
	joint.wakeBodies();
	return true;
}

void JointRegistry::findDrawable(btAlignedObjectArray<JointWorks*>& joints)
{
	joints.resize(0);
	btHashMap<btHashPtr, int> inWorld;
	// Without joints the world may be gone, and the action have come to a new one.
	if (getNumJoints() == 0)
		return;
	for (int i = 0; m_world && i < m_world->getNumCollisionObjects(); ++i)
		inWorld.insert(btHashPtr(m_world->getCollisionObjectArray()[i]), i);
	const auto isThere = [&](const btRigidBody& body)
	{ return inWorld.find(btHashPtr(&body)) || &body == &btTypedConstraint::getFixedBody(); };
	for (int i = 0; i < getNumJoints(); ++i)
	{
		const JointModel& model = getJoint(i).m_model;
		if (m_world && isThere(model.bodyA()) && isThere(model.bodyB()))
			joints.push_back(&getJoint(i));
	}
}

void JointRegistry::findHolding(const btDynamicsWorld& world, btAlignedObjectArray<JointWorks*>& joints)
{
	joints.resize(0);
	joints.resize(m_joints.getEnd(), nullptr);
	for (int i = 0; i < world.getNumConstraints(); ++i)
	{
		JointWorks* const joint = JointWorks::from(const_cast<btTypedConstraint*>(world.getConstraint(i)));
		if (joint && joint->m_entry.m_registry == this && !isBroken(*joint))
			joints[joint->m_entry.m_index] = joint;
	}
	int found = 0;
	for (int i = 0; i < joints.size(); ++i)
		if (joints[i])
			joints[found++] = joints[i];
	joints.resize(found);
}

// ---- the end of a substep

void JointRegistry::commit(btDynamicsWorld& world, btScalar timeStep)
{
	if (!isStep(timeStep))
		return;
	m_time += timeStep;
	*m_substepShare = 1;
	m_world = &world;
	m_isCommitting = true;
	m_joints.closeGaps();
	m_broken.closeGaps();
	endTaken(world);
	limitEnergy(world);
	commitJoints(world, timeStep);
	m_ledger.book();
	removeBrokenFromWorld(world);
	endSeparations();
	tellLeftOut(world);
	updateDrawnFrames(world);
	if (deliver())
		m_isCommitting = false;
}

/// A step that is not finite or not above 0 does nothing to joints.
bool JointRegistry::isStep(btScalar timeStep)
{
	if (timeStep > 0 && btElasticPlasticIsFinite(timeStep))
		return true;
	if (!m_isStepTold)
	{
		m_isStepTold = true;
		char text[128];
		btElasticPlasticFault("time step [s]", timeStep, "finite and greater than 0: joints do nothing in it")
			.print(text, sizeof text);
		tellAll([&](btElasticPlasticListener& listener) { listener.onBadStep(timeStep, text); });
	}
	return false;
}

void JointRegistry::take(const std::vector<BodyMotion>& motions, const std::vector<LoadHistory>& loads)
{
	if (motions.empty() && loads.empty())
		return;
	const std::lock_guard<std::mutex> lock(m_taking);
	m_motions.take(motions);
	m_loads.take(loads);
}

void JointRegistry::forgetTaken()
{
	const std::lock_guard<std::mutex> lock(m_taking);
	m_motions.forget();
	m_loads.forget();
}

void JointRegistry::endTaken(btDynamicsWorld& world)
{
	for (const BodyMotion& motion : m_motions.getTaken())
		motion.apply(world);
	m_motions.end();
	m_loads.end();
}

/// Whether a joint's constraint is in the world. One that has left it may have bodies that are deleted. The place in the world's list
/// is kept: it hardly ever changes, and joints mostly stand there in the registry's order.
bool JointRegistry::isInWorld(const btDynamicsWorld& world, JointWorks& joint)
{
	const btTypedConstraint* const constraint = &joint.m_model.m_constraint;
	const auto isAt = [&](int place)
	{ return place >= 0 && place < world.getNumConstraints() && world.getConstraint(place) == constraint; };
	int& index = joint.m_entry.m_worldIndex;
	const bool isNew = index < 0 && (joint.isInStep() || joint.wasInStep());
	if (!isAt(index) && (index >= 0 || isNew))
		index = isAt(m_nextWorldIndex) ? m_nextWorldIndex : world.getNumConstraints() - 1;
	while (index >= 0 && !isAt(index))
		--index;
	m_nextWorldIndex = index + 1;
	return index >= 0;
}

/// Another action may have taken a joint out of the world within the step, and deleted its bodies; or this action has come to another world,
/// and nobody commits what stayed behind.
void JointRegistry::leaveIfGone(const btDynamicsWorld& world, JointWorks& joint)
{
	if (joint.isInStep() && !isInWorld(world, joint))
		joint.leaveUncommitted();
}

/// Looks at a joint's load and follows what it stands on, after its commit. Of sleeping joints those are looked at that stand on something.
/// \return whether its bodies have to stay awake
bool JointRegistry::watch(const btDynamicsWorld& world, JointWorks& joint, btScalar timeStep)
{
	const bool mayBeWatched = joint.wasInStep() || (joint.mayHaveSupport() && isInWorld(world, joint));
	if (mayBeWatched)
		return joint.isLoadChanging(m_wakingShare, timeStep) && m_wakingShare < btElasticPlasticCapacity::unlimited();
	joint.forgetSupport();
	return false;
}

/// Keeps joints from giving more than they have where a solver's iterations have ended before the solution.
void JointRegistry::limitEnergy(const btDynamicsWorld& world)
{
	m_ledger.begin();
	if (!m_hasUnsure.exchange(false, std::memory_order_relaxed))
		return;
	for (int i = 0; i < m_joints.getEnd(); ++i)
	{
		JointWorks& joint = *m_joints[i].m_joint;
		leaveIfGone(world, joint);
		joint.takeFeedback();
		if (joint.m_step.isUnsure())
			m_ledger.add(joint);
	}
	m_ledger.limit();
}

void JointRegistry::commitJoints(const btDynamicsWorld& world, btScalar timeStep)
{
	m_leftOut.resize(0);
	for (int i = 0; i < m_joints.getEnd(); ++i)
	{
		if (i + PREFETCH_AHEAD < m_joints.getEnd() && !m_joints[i + PREFETCH_AHEAD].m_isDormant)
			m_joints[i + PREFETCH_AHEAD].m_joint->prefetch();
		if (i + 1 < m_joints.getEnd() && !m_joints[i + 1].m_isDormant)
			m_joints[i + 1].m_joint->prefetchParts();
		if (m_joints[i].m_isDormant)
			continue;
		JointWorks& joint = *m_joints[i].m_joint;
		const bool wasInStep = joint.wasInStep();
		leaveIfGone(world, joint);
		const bool isInStep = joint.isInStep();
		const int outcome = joint.commit();
		if (wasInStep && !joint.wasInStep())
			m_leftOut.push_back(&joint);
		if (watch(world, joint, timeStep))
			joint.wakeBodies();
		if (joint.wasInStep() && joint.m_levels.isAnySet())
			reportLevels(joint);
		if (outcome & JointStep::YIELDED)
			report(BT_EP_EVENT_YIELD, joint);
		if (isInStep && joint.m_step.getLosses().size() > 0)
			reportLosses(joint);
		if (outcome & JointStep::BROKE)
			report(BT_EP_EVENT_BREAK, joint);
		// Most of a world asleep, which is not worth the memory that it would have to be read from.
		m_joints[i].m_isDormant = !wasInStep && !isInStep && !joint.mayHaveSupport();
		if (joint.m_model.m_state.m_broken)
			moveToBroken(joint);
	}
}

/// Removes the last constraints first. Bullet fills the gap of a removed constraint with its last one; removed in this order,
/// the constraints that stay keep their order.
void JointRegistry::removeBrokenFromWorld(btDynamicsWorld& world)
{
	for (int i = m_broken.getEnd() - 1; i >= 0; --i)
	{
		Entry& entry = m_broken[i];
		if (entry.isGap())
			continue;
		if (entry.m_hasLeft)
			return;
		removeFromWorld(world, entry);
	}
}

void JointRegistry::removeFromWorld(btDynamicsWorld& world, Entry& entry)
{
	JointWorks& joint = *entry.m_joint;
	btTypedConstraint& constraint = joint.m_model.m_constraint;
	const bool wasInStep = joint.wasInStep();
	// One that a state has made broken need not be in the world, and then its bodies may be deleted.
	entry.m_hasLeft = true;
	if (wasInStep ? !isInWorld(world, joint) : !isIn(world, constraint))
		return;
	btRigidBody &a = constraint.getRigidBodyA(), &b = constraint.getRigidBodyB();
	entry.leave(world);
	const int place = isInWorld(world, joint) ? joint.m_entry.m_worldIndex : world.getNumConstraints();
	world.removeConstraint(&constraint);
	// Bullet has put the last one there.
	if (JointWorks* const moved =
			place < world.getNumConstraints() ? JointWorks::from(world.getConstraint(place)) : nullptr)
		moved->m_entry.m_worldIndex = place;
	if (entry.m_disableCollisions && !hasMarkedAnother(world) && joint.m_separation.begin(world, constraint))
	{
		m_token.enter(world);
		++m_numSeparations;
	}
	if (wasInStep)
	{
		wake(a);
		wake(b);
	}
}

/// Tells of joints that bear nothing because no world asks for them: they were added here, but to no world, or a body of theirs has
/// left it. One that has been in the world once may have been taken out of it on purpose.
void JointRegistry::tellLeftOut(const btDynamicsWorld& world)
{
	bool isAnyNew = false;
	for (int i = 0; i < m_joints.getEnd() && m_hasNew; ++i)
		isAnyNew |= !m_joints[i].isGap() && !m_joints[i].m_joint->hasBeenInWorld();
	m_hasNew = false;
	if (!isAnyNew && m_leftOut.size() == 0)
		return;
	btHashMap<btHashPtr, int> inWorld;
	for (int i = 0; i < world.getNumConstraints(); ++i)
		inWorld.insert(btHashPtr(world.getConstraint(i)), i);
	const auto isThere = [&](const JointWorks& joint)
	{ return inWorld.find(btHashPtr(&joint.m_model.m_constraint)) != nullptr; };
	for (int i = 0; i < m_leftOut.size(); ++i)
		if (isThere(*m_leftOut[i]))
			m_leftOut[i]->tellMissingBody();
	if (!isAnyNew)
		return;
	for (int i = 0; i < m_joints.getEnd(); ++i)
		if (!m_joints[i].isGap() && !m_joints[i].m_joint->hasBeenInWorld() && isThere(*m_joints[i].m_joint))
		{
			m_joints[i].m_joint->setInWorld();
			// It was not asked for rows: a body that had left before the first step had no island.
			m_joints[i].m_joint->tellMissingBody();
		}
	btAlignedObjectArray<JointWorks*> joints;
	findDrawable(joints);
	for (int i = 0; i < joints.size(); ++i)
		if (!joints[i]->hasBeenInWorld() && !isThere(*joints[i]) && !isBroken(*joints[i]))
			joints[i]->tellForgotten();
}

void JointRegistry::endSeparations()
{
	for (int i = 0; i < m_broken.getEnd() && m_numSeparations > 0; ++i)
		if (m_broken[i].m_joint->m_separation.isDone())
			endSeparation(*m_broken[i].m_joint);
}

void JointRegistry::endSeparation(JointWorks& joint)
{
	if (!joint.m_separation.isUnderWay())
		return;
	joint.m_separation.end(m_token.getWorld(), joint.m_model.m_constraint);
	if (--m_numSeparations == 0)
		m_token.leave();
}

/// Bullet's class brings its frames along only where it has rows.
void JointRegistry::updateDrawnFrames(btDynamicsWorld& world)
{
	const btIDebugDraw* const drawer = world.getDebugDrawer();
	if (!drawer || !(drawer->getDebugMode() & btIDebugDraw::DBG_DrawConstraints))
		return;
	for (int i = 0; i < m_joints.getEnd(); ++i)
		if (!m_joints[i].isGap() && m_joints[i].m_joint->wasInStep())
			m_joints[i].m_joint->updateDrawnFrames();
}

// ---- snapshots

void JointRegistry::arrange(btDynamicsWorld& world, const Standing* joints, int numJoints, double time)
{
	btAlignedObjectArray<Entry> entries;
	for (int i = 0; i < numJoints; ++i)
	{
		JointWorks& joint = *joints[i].m_joint;
		m_events.forget(joint.m_entry.m_events);
		endSeparation(joint);
		joint.m_entry.m_worldIndex = 0;
		entries.push_back(isBroken(joint) ? m_broken[joint.m_entry.m_index] : Entry(&joint));
	}
	m_joints.clear();
	m_broken.clear();
	for (int i = 0; i < numJoints; ++i)
	{
		btTypedConstraint& constraint = joints[i].m_joint->m_model.m_constraint;
		Entry& entry = entries[i];
		const bool wasBroken = entry.m_hasLeft;
		if (!joints[i].m_isBroken)
		{
			if (wasBroken)
				world.addConstraint(&constraint, entry.m_disableCollisions);
			m_joints.append(Entry(entry.m_joint));
			continue;
		}
		if (!wasBroken)
		{
			entry.leave(world);
			world.removeConstraint(&constraint);
		}
		if (joints[i].m_isSeparating)
		{
			entry.m_joint->m_separation.resume(world, constraint, joints[i].m_overlap);
			m_token.enter(world);
			++m_numSeparations;
		}
		m_broken.append(entry);
	}
	m_world = &world;
	m_time = time;
}

void JointRegistry::addEvent(const btElasticPlasticEvent& event, JointWorks& joint)
{
	m_events.push(event, joint.m_entry.m_events);
}

// ---- events

void JointRegistry::addListener(btElasticPlasticListener* listener)
{
	if (listener && m_listeners.findLinearSearch(listener) == m_listeners.size())
		m_listeners.push_back(listener);
}

/// Tells all listeners; without any, the default one, which prints. They may add and remove listeners and joints, and delete the registry.
/// \return whether the registry still exists
template <class Call>
bool JointRegistry::tellAll(const Call& call)
{
	const Watch watch(*this);
	const btAlignedObjectArray<btElasticPlasticListener*> listeners = m_listeners;
	btElasticPlasticListener printer;
	if (listeners.size() == 0)
		call(printer);
	for (int i = 0; i < listeners.size() && !watch.isDeleted(); ++i)
		if (m_listeners.findLinearSearch(listeners[i]) < m_listeners.size())
			call(*listeners[i]);
	return !watch.isDeleted();
}

void JointRegistry::refuse(btElasticPlasticJoint& joint, const char* text)
{
	const std::lock_guard<std::recursive_mutex> lock(m_refusal);
	tellAll([&](btElasticPlasticListener& listener) { listener.onRefused(joint, text); });
}

/// \param fibre  that the event is about, -1: none
void JointRegistry::report(btElasticPlasticEventType type, JointWorks& works, btElasticPlasticQuantity quantity,
						   int fibre)
{
	btElasticPlasticJoint& joint = works.m_joint;
	btElasticPlasticEvent event;
	event.m_type = type;
	event.m_joint = &joint;
	event.m_bodyA = &works.m_model.bodyA();
	event.m_bodyB = &works.m_model.bodyB();
	event.m_position = joint.getPosition();
	event.m_fibre = event.m_part = fibre;
	if (fibre >= 0)
	{
		const btElasticPlasticFibre& of = works.m_model.m_capacity.m_fibres[fibre];
		event.m_part = of.m_part;
		event.m_position += of.m_y * joint.getJointAxis(BT_EP_SHEAR_Y) + of.m_z * joint.getJointAxis(BT_EP_SHEAR_Z);
	}
	event.m_force.setValue(joint.getForce(0), joint.getForce(1), joint.getForce(2));
	event.m_moment.setValue(joint.getForce(3), joint.getForce(4), joint.getForce(5));
	event.m_energy = joint.getPlasticEnergy() + joint.getElasticEnergy();
	event.m_time = m_time;
	event.m_quantity = quantity;
	event.m_value = joint.getQuantity(quantity);
	event.m_impulse = works.appliedImpulse();
	event.m_velocity = works.relativeVelocity();
	joint.getUtilisation(&event.m_dof);
	// If no force is applied, the decisive degree of freedom is the one with the largest damage, as in a break.
	const bool isByDamage = type == BT_EP_EVENT_BREAK || quantity == BT_EP_QUANTITY_DAMAGE;
	if (isByDamage || !btElasticPlasticIsDof(event.m_dof))
	{
		event.m_dof = 0;
		for (int i = 1; i < BT_EP_DOF_COUNT; ++i)
			if (joint.getDamage(i) > joint.getDamage(event.m_dof))
				event.m_dof = i;
	}
	m_events.push(event, works.m_entry.m_events);
}

void JointRegistry::reportLevels(JointWorks& joint)
{
	for (int q = 0; q < BT_EP_QUANTITY_COUNT; ++q)
	{
		const btElasticPlasticQuantity quantity = btElasticPlasticQuantity(q);
		if (joint.m_levels.pass(quantity, joint.m_joint.getQuantity(quantity), joint.m_model.m_state.m_passedLevels))
			report(BT_EP_EVENT_LEVEL, joint, quantity);
	}
}

void JointRegistry::reportLosses(JointWorks& joint)
{
	const btAlignedObjectArray<FibreStep::Loss>& losses = joint.m_step.getLosses();
	for (int i = 0; i < losses.size(); ++i)
		report(losses[i].m_isRuptured ? BT_EP_EVENT_RUPTURE : BT_EP_EVENT_CRACK, joint, BT_EP_QUANTITY_COUNT,
			   losses[i].m_fibre);
	joint.m_step.forgetLosses();
}

bool JointRegistry::tell(const btElasticPlasticEvent& event)
{
	return tellAll(
		[&](btElasticPlasticListener& listener)
		{
			if (event.m_type == BT_EP_EVENT_YIELD)
				listener.onYield(event);
			else if (event.m_type == BT_EP_EVENT_BREAK)
				listener.onBreak(event);
			else if (event.m_type == BT_EP_EVENT_LEVEL)
				listener.onLevel(event);
			else if (event.m_type == BT_EP_EVENT_CRACK)
				listener.onCrack(event);
			else
				listener.onRupture(event);
		});
}

/// Takes events from the queue one by one: the listener may delete joints, whose events then leave the queue, and the action
/// itself.
/// \return whether the registry still exists
bool JointRegistry::deliver()
{
	btElasticPlasticEvent event;
	btElasticPlasticEvent* const toldOutside = m_told;
	m_told = &event;
	while (m_listeners.size() > 0 && m_events.pop(event))
		if (!tell(event))
			return false;
	m_told = toldOutside;
	return true;
}
}  // namespace btElasticPlastic
