// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "world/Hand.h"

namespace ep
{
namespace
{
const btScalar REACH = 500;     // [m]
const btScalar STRENGTH = 200;  // over the body's mass [m/s^2]
const btScalar STEP = btScalar(1) / 60;
}  // namespace

RayHit castRay(World& world, const btVector3& from, const btVector3& direction)
{
	const btVector3 to = from + direction.normalized() * REACH;
	btCollisionWorld::ClosestRayResultCallback found(from, to);
	world.bullet().rayTest(from, to, found);
	RayHit hit;
	hit.hasHit = found.hasHit();
	if (!hit.hasHit)
		return hit;
	hit.place = found.m_hitPointWorld;
	btRigidBody* const body = btRigidBody::upcast(const_cast<btCollisionObject*>(found.m_collisionObject));
	hit.body = body && body->getInvMass() > 0 ? body : nullptr;
	return hit;
}

btRigidBody* Hand::grab(const btVector3& from, const btVector3& direction)
{
	release();
	const RayHit hit = castRay(m_world, from, direction);
	btRigidBody* const body = hit.body;
	if (!body)
		return nullptr;
	m_place = hit.place;
	m_distance = (m_place - from).length();
	m_pull.reset(new btPoint2PointConstraint(*body, body->getCenterOfMassTransform().inverse() * m_place));
	m_pull->m_setting.m_impulseClamp = STRENGTH / body->getInvMass() * STEP;
	m_pull->m_setting.m_tau = btScalar(.1);
	m_world.bullet().addConstraint(m_pull.get());
	body->activate(true);
	return body;
}

void Hand::drag(const btVector3& from, const btVector3& direction)
{
	if (!m_pull)
		return;
	m_pull->getRigidBodyA().activate(true);
	m_pull->setPivotB(from + direction.normalized() * m_distance);
}

void Hand::release()
{
	if (m_pull)
		m_world.bullet().removeConstraint(m_pull.get());
	m_pull.reset();
}
}  // namespace ep
