// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticAction.h"

#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "LinearMath/btQuickprof.h"
#include "btElasticPlasticDebugDraw.h"
#include "ElasticPlastic/joint/Separation.h"

#include <stdio.h>

void btElasticPlasticListener::onRefused(btElasticPlasticJoint&, const char* text)
{
	fprintf(stderr, "Bullet Elastic-Plastic refused %s\n", text);
}

btElasticPlasticAction::~btElasticPlasticAction()
{
	for (int i = 0; i < getNumJoints(); ++i)
		getJoint(i)->m_action = nullptr;
}

bool btElasticPlasticAction::addJoint(btElasticPlasticJoint* joint)
{
	joint->m_fault = joint->findFault();
	joint->m_uncommitted = 0;
	joint->revert();
	if (joint->fault())
	{
		char text[320];
		joint->printFault(text, sizeof text);
		btElasticPlasticListener standard;
		(m_listener ? m_listener : &standard)->onRefused(*joint, text);
		return false;
	}
	if (joint->m_action == this)
		return true;
	if (joint->m_action)
		joint->m_action->removeJoint(joint);
	joint->m_action = this;
	appendWhole(joint);
	return true;
}

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
}  // namespace

void btElasticPlasticAction::appendWhole(btElasticPlasticJoint* joint)
{
	const Entry entry = {joint, nullptr, false};
	joint->m_entry = m_joints.size();
	m_joints.push_back(entry);
}

void btElasticPlasticAction::removeJoint(btElasticPlasticJoint* joint)
{
	if (joint->m_action != this)
		return;
	joint->m_action = nullptr;
	endParting(*joint);
	if (joint->m_entry < m_joints.size() && m_joints[joint->m_entry].m_joint == joint)
	{
		// Closing the gap waits: a world of 20000 joints may be taken down one by one.
		m_joints[joint->m_entry].m_joint = nullptr;
		m_hasGaps = true;
	}
	else
		removeIf(m_broken, [joint](const Entry& e) { return e.m_joint == joint; });
	for (int i = m_nextEvent; i < m_events.size(); ++i)
		if (m_events[i].m_joint == joint)
			m_events[i].m_joint = nullptr;
}

void btElasticPlasticAction::closeGaps()
{
	if (!m_hasGaps)
		return;
	removeIf(m_joints, [](const Entry& e) { return !e.m_joint; });
	for (int i = 0; i < m_joints.size(); ++i)
		m_joints[i].m_joint->m_entry = i;
	m_hasGaps = false;
}

void btElasticPlasticAction::removeBody(btDynamicsWorld& world, btRigidBody& body)
{
	for (int i = world.getNumConstraints() - 1; i >= 0; --i)
	{
		btTypedConstraint* const constraint = world.getConstraint(i);
		if (&constraint->getRigidBodyA() == &body || &constraint->getRigidBodyB() == &body)
			world.removeConstraint(constraint);
	}
	for (int i = getNumJoints() - 1; i >= 0; --i)
	{
		const btTypedConstraint& constraint = getJoint(i)->getConstraint();
		if (&constraint.getRigidBodyA() == &body || &constraint.getRigidBodyB() == &body)
			removeJoint(getJoint(i));
	}
	world.removeRigidBody(&body);
}

bool btElasticPlasticAction::repair(btElasticPlasticJoint* joint)
{
	for (int i = 0; i < m_broken.size(); ++i)
	{
		const Entry entry = m_broken[i];
		if (entry.m_joint != joint)
			continue;
		removeIf(m_broken, [joint](const Entry& e) { return e.m_joint == joint; });
		endParting(*joint);
		joint->resetState();
		entry.m_world->addConstraint(&joint->getConstraint(), entry.m_disableCollisions);
		appendWhole(joint);
		joint->getConstraint().getRigidBodyA().activate();
		joint->getConstraint().getRigidBodyB().activate();
		return true;
	}
	return false;
}

bool btElasticPlasticAction::popEvent(btElasticPlasticEvent& event)
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

void btElasticPlasticAction::updateAction(btCollisionWorld* world, btScalar timeStep)
{
	BT_PROFILE("elastic-plastic commit");
	m_time += timeStep;
	// Actions live in dynamics worlds only.
	btDynamicsWorld& dynamics = *static_cast<btDynamicsWorld*>(world);
	closeGaps();
	// Of what order joints are in the second level of a cache.
	const bool isLarge = m_joints.size() > 500;
	const int brokenBefore = m_broken.size();
	for (int i = 0; i < m_joints.size(); ++i)
	{
		if (isLarge && i + 4 < m_joints.size())
			m_joints[i + 4].m_joint->prefetch();
		btElasticPlasticJoint& joint = *m_joints[i].m_joint;
		const int outcome = joint.commit();
		if (outcome & btElasticPlasticJoint::YIELDED)
			report(BT_EP_EVENT_YIELD, joint);
		if (outcome & btElasticPlasticJoint::BROKE)
		{
			report(BT_EP_EVENT_BREAK, joint);
			m_broken.push_back(m_joints[i]);
		}
	}
	// Backwards: Bullet fills the gap of a removed constraint with its last one, and this way its list keeps its order.
	for (int i = m_broken.size() - 1; i >= brokenBefore; --i)
	{
		m_broken[i].m_world = &dynamics;
		m_broken[i].m_disableCollisions = removeBroken(dynamics, *m_broken[i].m_joint);
	}
	if (m_broken.size() > brokenBefore)
	{
		for (int i = brokenBefore; i < m_broken.size(); ++i)
			m_joints[m_broken[i].m_joint->m_entry].m_joint = nullptr;
		m_hasGaps = true;
		closeGaps();
	}
	endPartings();
	deliver();
}

/// \return whether the joint had kept its bodies from colliding
bool btElasticPlasticAction::removeBroken(btDynamicsWorld& world, btElasticPlasticJoint& joint)
{
	btTypedConstraint& constraint = joint.getConstraint();
	btRigidBody &a = constraint.getRigidBodyA(), &b = constraint.getRigidBodyB();
	bool kept = false;
	for (int i = 0; i < a.getNumConstraintRefs() && !kept; ++i)
		kept = a.getConstraintRef(i) == &constraint;
	world.removeConstraint(&constraint);
	if (kept && btElasticPlastic::overlapOf(world, a, b) > btElasticPlastic::SEPARATION_SLOP)
	{
		// Without rows, and without keeping the bodies from colliding: it is there to be called between collision detection and solver.
		world.addConstraint(&constraint, false);
		joint.m_partingWorld = &world;
		joint.m_overlap = SIMD_INFINITY;
		++m_parting;
	}
	a.activate();
	b.activate();
	return kept;
}

void btElasticPlasticAction::endPartings()
{
	for (int i = 0; i < m_broken.size() && m_parting > 0; ++i)
	{
		btElasticPlasticJoint& joint = *m_broken[i].m_joint;
		if (joint.m_overlap <= btElasticPlastic::SEPARATION_SLOP)
			endParting(joint);
	}
}

void btElasticPlasticAction::endParting(btElasticPlasticJoint& joint)
{
	if (!joint.m_partingWorld)
		return;
	joint.m_partingWorld->removeConstraint(&joint.getConstraint());
	joint.m_partingWorld = nullptr;
	--m_parting;
}

void btElasticPlasticAction::report(btElasticPlasticEventType type, btElasticPlasticJoint& joint)
{
	btElasticPlasticEvent event;
	event.m_type = type;
	event.m_joint = &joint;
	event.m_bodyA = &joint.getConstraint().getRigidBodyA();
	event.m_bodyB = &joint.getConstraint().getRigidBodyB();
	event.m_position = joint.getPosition();
	event.m_force.setValue(joint.getForce(0), joint.getForce(1), joint.getForce(2));
	event.m_moment.setValue(joint.getForce(3), joint.getForce(4), joint.getForce(5));
	event.m_energy = joint.getPlasticEnergy() + joint.getElasticEnergy();
	event.m_time = m_time;
	joint.getUtilisation(&event.m_dof);
	if (type == BT_EP_EVENT_BREAK)
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			if (joint.getDamage(i) > joint.getDamage(event.m_dof))
				event.m_dof = i;
	m_events.push_back(event);
}

void btElasticPlasticAction::deliver()
{
	// One by one from the queue: a listener may delete joints, which takes their events out of it.
	btElasticPlasticEvent event;
	while (m_listener && popEvent(event))
		if (event.m_type == BT_EP_EVENT_YIELD)
			m_listener->onYield(event);
		else
			m_listener->onBreak(event);
}

void btElasticPlasticAction::debugDraw(btIDebugDraw* drawer)
{
	for (int i = 0; i < getNumJoints(); ++i)
		btElasticPlasticDrawJoint(*drawer, *getJoint(i));
}
