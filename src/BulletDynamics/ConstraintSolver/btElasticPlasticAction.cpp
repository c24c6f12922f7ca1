// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticAction.h"

#include <stdio.h>

#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "ElasticPlastic/joint/JointRegistry.h"
#include "ElasticPlastic/joint/JointWorks.h"
#include "LinearMath/btQuickprof.h"

void btElasticPlasticListener::onRefused(btElasticPlasticJoint&, const char* text)
{
	fprintf(stderr, "Bullet Elastic-Plastic refused %s\n", text);
}

void btElasticPlasticListener::onBadStep(btScalar, const char* text)
{
	fprintf(stderr, "Bullet Elastic-Plastic: %s\n", text);
}

btElasticPlasticAction::btElasticPlasticAction(btElasticPlasticOwnPrecision)
	: m_registry(new btElasticPlastic::JointRegistry)
{
}
btElasticPlasticAction::~btElasticPlasticAction() { delete m_registry; }

bool btElasticPlasticAction::addJoint(btElasticPlasticJoint* joint)
{
	return joint && m_registry->add(*joint->m_works);
}

void btElasticPlasticAction::removeJoint(btElasticPlasticJoint* joint)
{
	if (joint)
		m_registry->remove(*joint->m_works);
}

void btElasticPlasticAction::removeBody(btDynamicsWorld& world, btRigidBody& body)
{
	m_registry->removeBody(world, body);
}

bool btElasticPlasticAction::breakJoint(btDynamicsWorld& world, btElasticPlasticJoint* joint)
{
	return joint && m_registry->breakJoint(world, *joint->m_works);
}

bool btElasticPlasticAction::repair(btElasticPlasticJoint* joint)
{
	return joint && m_registry->repair(*joint->m_works, nullptr);
}

bool btElasticPlasticAction::repair(btDynamicsWorld& world, btElasticPlasticJoint* joint)
{
	return joint && m_registry->repair(*joint->m_works, &world);
}

int btElasticPlasticAction::getNumJoints() { return m_registry->getNumJoints(); }
int btElasticPlasticAction::getNumBroken() const { return m_registry->getNumBroken(); }
btElasticPlasticJoint* btElasticPlasticAction::getJoint(int index)
{
	return index >= 0 && index < getNumJoints() ? &m_registry->getJoint(index).m_joint : nullptr;
}

void btElasticPlasticAction::getJointsInWorld(const btDynamicsWorld& world,
											  btAlignedObjectArray<btElasticPlasticJoint*>& joints)
{
	btAlignedObjectArray<btElasticPlastic::JointWorks*> found;
	m_registry->findHolding(world, found);
	joints.resize(found.size());
	for (int i = 0; i < found.size(); ++i)
		joints[i] = &found[i]->m_joint;
}

void btElasticPlasticAction::addListener(btElasticPlasticListener* listener) { m_registry->addListener(listener); }
void btElasticPlasticAction::removeListener(btElasticPlasticListener* listener)
{
	m_registry->removeListener(listener);
}

void btElasticPlasticAction::setListener(btElasticPlasticListener* listener)
{
	m_registry->removeListeners();
	m_registry->addListener(listener);
}

bool btElasticPlasticAction::popEvent(btElasticPlasticEvent& event) { return m_registry->popEvent(event); }
bool btElasticPlasticAction::setWakingShare(btScalar share)
{
	const bool isInRange = share >= 0 && share <= btElasticPlasticCapacity::unlimited();
	if (isInRange)
		m_registry->setWakingShare(share);
	return isInRange;
}
btScalar btElasticPlasticAction::getWakingShare() const { return m_registry->getWakingShare(); }

bool btElasticPlasticAction::getInnerMotion(const btRigidBody& body, btElasticPlasticInnerMotion& motion) const
{
	const btElasticPlastic::BodyMotion* const found = m_registry->findMotion(body);
	if (found)
		motion = found->m_inner;
	return found != nullptr;
}

double btElasticPlasticAction::getTime() const { return m_registry->getTime(); }

void btElasticPlasticAction::updateAction(btCollisionWorld* world, btScalar timeStep)
{
	BT_PROFILE("elastic-plastic commit");
	// Actions live in dynamics worlds only.
	m_registry->commit(*static_cast<btDynamicsWorld*>(world), timeStep);
}

void btElasticPlasticAction::debugDraw(btIDebugDraw* drawer)
{
	if (!drawer)
		return;
	btAlignedObjectArray<btElasticPlastic::JointWorks*> joints;
	m_registry->findDrawable(joints);
	for (int i = 0; i < joints.size(); ++i)
		btElasticPlasticDrawJoint(*drawer, joints[i]->m_joint, m_drawing);
}

bool btElasticPlasticAction::setDrawing(const btElasticPlasticDrawing& drawing)
{
	const bool isInRange = drawing.isInRange();
	if (isInRange)
		m_drawing = drawing;
	return isInRange;
}
