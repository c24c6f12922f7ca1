// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "StepInput.h"

#include "../joint/BodyGate.h"
#include "../joint/BodyLoad.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
btTransform wantedPlaceOf(btRigidBody& body)
{
	btTransform place = body.getWorldTransform();
	if (body.getMotionState())
		body.getMotionState()->getWorldTransform(place);
	return place;
}
}  // namespace

StepInput::Way::Way(btRigidBody& body, const btTransform& end)
	: m_body(&body),
	  m_motionState(body.getMotionState()),
	  m_proxy(uidOf(body)),
	  m_start(body.getInterpolationWorldTransform()),
	  m_end(end),
	  m_place(end)
{
}

void StepInput::Way::go(btScalar share)
{
	// A body that something else moves between substeps is left to that.
	if (!(wantedPlaceOf(*m_body) == (m_motionState ? m_end : m_place)))
		return;
	m_place = share < 1 ? btTransform(m_start.getRotation().slerp(m_end.getRotation(), share),
									  m_start.getOrigin().lerp(m_end.getOrigin(), share))
						: m_end;
	m_isReady = false;
	if (m_motionState)
		m_body->setMotionState(this);  // this reads it once, which must not count
	else
		m_body->setWorldTransform(m_place);
	m_isReady = true;
}

void StepInput::Way::stepAside() const
{
	if (m_body->getMotionState() == this)
		m_body->setMotionState(m_motionState);
}

void StepInput::Way::getWorldTransform(btTransform& place) const
{
	if (m_isReady)
		stepAside();
	place = m_place;
}

StepInput::StepInput(btDynamicsWorld& world, btScalar dt) : m_world(world)
{
	const btCollisionObjectArray& objects = world.getCollisionObjectArray();
	for (int i = 0; i < objects.size(); ++i)
	{
		btRigidBody* const body = btRigidBody::upcast(objects[i]);
		if (body && !(body->getTotalForce().isZero() && body->getTotalTorque().isZero()))
			m_loads.insert(btHashPtr(body), {uidOf(*body), beforeFactor(body->getTotalForce(), body->getLinearFactor()),
											 beforeFactor(body->getTotalTorque(), body->getAngularFactor())});
		if (!body || !isKinematicAndAwake(*body))
			continue;
		const btTransform end = wantedPlaceOf(*body), &start = body->getInterpolationWorldTransform();
		body->setLinearVelocity((end.getOrigin() - start.getOrigin()) / dt);
		if (!(start == end))
			m_ways.insert(btHashPtr(body), Way(*body, end));
	}
}

StepInput::~StepInput()
{
	const btCollisionObjectArray& objects = m_world.getCollisionObjectArray();
	for (int i = 0; i < objects.size() && m_ways.size() > 0; ++i)
		if (const Way* const way = m_ways.find(btHashPtr(objects[i])))
			way->stepAside();
}

void StepInput::apply(btScalar share)
{
	const btCollisionObjectArray& objects = m_world.getCollisionObjectArray();
	for (int i = 0; i < objects.size() && m_loads.size() + m_ways.size() > 0; ++i)
	{
		btRigidBody* const body = btRigidBody::upcast(objects[i]);
		if (!body)
			continue;
		const Load* const load = m_hasBegun ? m_loads.find(btHashPtr(body)) : nullptr;
		if (load && load->m_proxy == uidOf(*body))
		{
			body->applyCentralForce(load->m_force);
			body->applyTorque(load->m_torque);
		}
		Way* const way = m_ways.find(btHashPtr(body));
		if (way && way->getProxy() == uidOf(*body) && isKinematicAndAwake(*body))
			way->go(share);
	}
	m_hasBegun = true;
}
}  // namespace btElasticPlastic
