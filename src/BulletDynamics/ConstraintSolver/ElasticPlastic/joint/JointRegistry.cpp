// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "JointRegistry.h"

#include "../../btElasticPlasticJoint.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "LinearMath/btHashMap.h"
#include "../Prefetch.h"
#include "JointWorks.h"

namespace btElasticPlastic
{
namespace
{
/// Removes all elements of which the predicate is true, the others keep their order.
template <class T, class Predicate>
void removeIf(btAlignedObjectArray<T>& array, Predicate predicate)
{
	int kept = 0;
	for (int i = 0; i < array.size(); ++i)
		if (!predicate(array[i]))
		{
			if (kept < i)
				array[kept] = array[i];
			++kept;
		}
	array.resize(kept);
}

bool joins(const btTypedConstraint& constraint, const btRigidBody& body)
{
	return &constraint.getRigidBodyA() == &body || &constraint.getRigidBodyB() == &body;
}
}  // namespace

JointRegistry::~JointRegistry()
{
	for (int i = 0; i < getNumJoints(); ++i)
	{
		endSeparation(getJoint(i));
		getJoint(i).m_entry.m_registry = nullptr;
	}
	if (m_isDeleted)
		*m_isDeleted = true;
}

// ---- joints

int JointRegistry::getNumJoints()
{
	closeGaps();
	return m_joints.size() + m_broken.size();
}

JointWorks& JointRegistry::getJoint(int index)
{
	closeGaps();
	return index < m_joints.size() ? *m_joints[index].m_joint : *m_broken[index - m_joints.size()].m_joint;
}

bool JointRegistry::add(JointWorks& joint)
{
	const btElasticPlasticFault fault = joint.m_model.findFault(), missingWorld = joint.m_model.findMissingWorld();
	joint.setFault(fault ? fault : missingWorld);
	// Bullet's search for islands crashes on a constraint one of whose bodies has never been in the world.
	joint.setOutOfIslands(bool(missingWorld));
	joint.forgetUncommitted();
	joint.m_step.revert();
	if (joint.m_model.m_fault)
	{
		joint.tellFault(this);
		return false;
	}
	if (joint.m_entry.m_registry == this)
		return true;
	if (joint.m_entry.m_registry)
		joint.m_entry.m_registry->remove(joint);
	joint.m_entry.m_registry = this;
	append(joint);
	return true;
}

void JointRegistry::append(JointWorks& joint)
{
	const Entry entry = {&joint, nullptr, false};
	joint.m_entry.m_index = m_joints.size();
	m_joints.push_back(entry);
}

void JointRegistry::remove(JointWorks& joint)
{
	if (joint.m_entry.m_registry != this)
		return;
	joint.m_entry.m_registry = nullptr;
	endSeparation(joint);
	const int index = joint.m_entry.m_index;
	if (index < m_joints.size() && m_joints[index].m_joint == &joint)
	{
		// The gap is closed later: closing it for each of 20000 joints that are removed one by one would take quadratic time.
		m_joints[index].m_joint = nullptr;
		m_hasGaps = true;
	}
	else
		removeIf(m_broken, [&joint](const Entry& e) { return e.m_joint == &joint; });
	for (int i = m_nextEvent; i < m_events.size(); ++i)
		if (m_events[i].m_joint == &joint.m_joint)
			m_events[i].m_joint = nullptr;
}

void JointRegistry::closeGaps()
{
	if (!m_hasGaps)
		return;
	removeIf(m_joints, [](const Entry& e) { return !e.m_joint; });
	for (int i = 0; i < m_joints.size(); ++i)
		m_joints[i].m_joint->m_entry.m_index = i;
	m_hasGaps = false;
}

void JointRegistry::removeBody(btDynamicsWorld& world, btRigidBody& body)
{
	for (int i = world.getNumConstraints() - 1; i >= 0; --i)
		if (joins(*world.getConstraint(i), body))
			world.removeConstraint(world.getConstraint(i));
	for (int i = getNumJoints() - 1; i >= 0; --i)
		if (joins(getJoint(i).m_model.m_constraint, body))
			remove(getJoint(i));
	world.removeRigidBody(&body);
}

bool JointRegistry::repair(JointWorks& joint)
{
	for (int i = 0; i < m_broken.size(); ++i)
	{
		const Entry entry = m_broken[i];
		if (entry.m_joint != &joint)
			continue;
		// A body without a broadphase handle is in no world: it has left its world, or that has been deleted.
		const btRigidBody* const bodies[2] = {&joint.m_model.bodyA(), &joint.m_model.bodyB()};
		for (const btRigidBody* body : bodies)
			if (body->getInvMass() > 0 && !body->getBroadphaseHandle())
				return false;
		removeIf(m_broken, [&joint](const Entry& e) { return e.m_joint == &joint; });
		endSeparation(joint);
		joint.m_model.m_state = btElasticPlasticState();
		joint.m_model.setReferenceToCurrentPose();
		joint.m_step.revert();
		entry.m_world->addConstraint(&joint.m_model.m_constraint, entry.m_disableCollisions);
		append(joint);
		joint.m_model.bodyA().activate();
		joint.m_model.bodyB().activate();
		return true;
	}
	return false;
}

void JointRegistry::findDrawable(btAlignedObjectArray<JointWorks*>& joints)
{
	joints.resize(0);
	btHashMap<btHashPtr, int> inWorld;
	for (int i = 0; m_world && i < m_world->getNumCollisionObjects(); ++i)
		inWorld.insert(btHashPtr(m_world->getCollisionObjectArray()[i]), i);
	const auto isThere = [&](const btRigidBody& body)
	{ return inWorld.find(btHashPtr(&body)) || &body == &btTypedConstraint::getFixedBody(); };
	for (int i = 0; i < getNumJoints(); ++i)
	{
		const JointModel& model = getJoint(i).m_model;
		if (!m_world || (isThere(model.bodyA()) && isThere(model.bodyB())))
			joints.push_back(&getJoint(i));
	}
}

// ---- the end of a substep

void JointRegistry::commit(btDynamicsWorld& world, btScalar timeStep)
{
	if (!isStep(timeStep))
		return;
	m_time += timeStep;
	m_world = &world;
	closeGaps();
	const int brokenBefore = m_broken.size();
	commitJoints();
	removeBrokenFromWorld(world, brokenBefore);
	endSeparations();
	deliver();
}

/// A step that is not finite or not above 0 does nothing to joints.
bool JointRegistry::isStep(btScalar timeStep)
{
	if (timeStep > 0 && btElasticPlasticIsFinite(timeStep))
		return true;
	if (!m_isStepTold)
	{
		char text[128];
		btElasticPlasticFault("time step [s]", timeStep, "finite and greater than 0: joints do nothing in it")
			.print(text, sizeof text);
		btElasticPlasticListener printer;
		(m_listener ? m_listener : &printer)->onBadStep(timeStep, text);
	}
	m_isStepTold = true;
	return false;
}

void JointRegistry::commitJoints()
{
	const bool isLarge = m_joints.size() > MANY_JOINTS;
	for (int i = 0; i < m_joints.size(); ++i)
	{
		if (isLarge && i + PREFETCH_AHEAD < m_joints.size())
			prefetch(*m_joints[i + PREFETCH_AHEAD].m_joint);
		JointWorks& joint = *m_joints[i].m_joint;
		const int outcome = joint.commit();
		if (outcome & JointStep::YIELDED)
			report(BT_EP_EVENT_YIELD, joint);
		if (outcome & JointStep::BROKE)
		{
			report(BT_EP_EVENT_BREAK, joint);
			m_broken.push_back(m_joints[i]);
		}
	}
}

/// Removes the last constraints first. Bullet fills the gap of a removed constraint with its last one; removed in this order,
/// the constraints that stay keep their order.
void JointRegistry::removeBrokenFromWorld(btDynamicsWorld& world, int firstBroken)
{
	for (int i = m_broken.size() - 1; i >= firstBroken; --i)
	{
		Entry& entry = m_broken[i];
		entry.m_world = &world;
		entry.m_disableCollisions = removeFromWorld(world, *entry.m_joint);
		m_joints[entry.m_joint->m_entry.m_index].m_joint = nullptr;
		m_hasGaps = true;
	}
	closeGaps();
}

/// \return whether the joint had kept its bodies from colliding
bool JointRegistry::removeFromWorld(btDynamicsWorld& world, JointWorks& joint)
{
	btTypedConstraint& constraint = joint.m_model.m_constraint;
	btRigidBody &a = constraint.getRigidBodyA(), &b = constraint.getRigidBodyB();
	bool kept = false;
	for (int i = 0; i < a.getNumConstraintRefs() && !kept; ++i)
		kept = a.getConstraintRef(i) == &constraint;
	world.removeConstraint(&constraint);
	if (kept && joint.m_separation.begin(world, constraint))
	{
		m_token.enter(world);
		++m_numSeparations;
	}
	a.activate();
	b.activate();
	return kept;
}

void JointRegistry::endSeparations()
{
	for (int i = 0; i < m_broken.size() && m_numSeparations > 0; ++i)
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

// ---- events

void JointRegistry::refuse(btElasticPlasticJoint& joint, const char* text)
{
	const std::lock_guard<std::recursive_mutex> lock(m_refusal);
	btElasticPlasticListener printer;
	(m_listener ? m_listener : &printer)->onRefused(joint, text);
}

void JointRegistry::report(btElasticPlasticEventType type, const JointWorks& works)
{
	btElasticPlasticJoint& joint = works.m_joint;
	btElasticPlasticEvent event;
	event.m_type = type;
	event.m_joint = &joint;
	event.m_bodyA = &works.m_model.bodyA();
	event.m_bodyB = &works.m_model.bodyB();
	event.m_position = joint.getPosition();
	event.m_force.setValue(joint.getForce(0), joint.getForce(1), joint.getForce(2));
	event.m_moment.setValue(joint.getForce(3), joint.getForce(4), joint.getForce(5));
	event.m_energy = joint.getPlasticEnergy() + joint.getElasticEnergy();
	event.m_time = m_time;
	joint.getUtilisation(&event.m_dof);
	// If no force is applied, the decisive degree of freedom is the one with the largest damage, as in a break.
	if (type == BT_EP_EVENT_BREAK || !btElasticPlasticIsDof(event.m_dof))
	{
		event.m_dof = 0;
		for (int i = 1; i < BT_EP_DOF_COUNT; ++i)
			if (joint.getDamage(i) > joint.getDamage(event.m_dof))
				event.m_dof = i;
	}
	m_events.push_back(event);
}

bool JointRegistry::popEvent(btElasticPlasticEvent& event)
{
	while (m_nextEvent < m_events.size())
	{
		event = m_events[m_nextEvent++];
		if (event.m_joint)
			return true;
	}
	m_events.resize(m_nextEvent = 0);
	return false;
}

/// Takes events from the queue one by one: the listener may delete joints, whose events then leave the queue, and the action
/// itself.
void JointRegistry::deliver()
{
	bool isDeleted = false;
	bool* const outer = m_isDeleted;
	m_isDeleted = &isDeleted;
	btElasticPlasticEvent event;
	while (!isDeleted && m_listener && popEvent(event))
		if (event.m_type == BT_EP_EVENT_YIELD)
			m_listener->onYield(event);
		else
			m_listener->onBreak(event);
	if (!isDeleted)
		m_isDeleted = outer;
	else if (outer)
		*outer = true;
}
}  // namespace btElasticPlastic
