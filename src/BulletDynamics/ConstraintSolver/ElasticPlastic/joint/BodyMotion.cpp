// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "BodyMotion.h"

#include "BulletCollision/CollisionDispatch/btCollisionWorld.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
/// The velocity at the end, exactly where nobody has changed it since.
btVector3 endOf(const btVector3& now, const btVector3& mean, const btVector3& end)
{
	return now == mean ? end : now + (end - mean);
}

/// Whether a body is in the world. It may have been deleted since, and the last of the world's bodies then has its index.
bool isIn(const btCollisionWorld& world, const BodyMotion& motion)
{
	const btCollisionObjectArray& objects = world.getCollisionObjectArray();
	const btCollisionObject* const body = motion.m_body;
	bool isThere = motion.m_index >= 0 && motion.m_index < objects.size() && objects[motion.m_index] == body;
	for (int i = 0; i < objects.size() && !isThere; ++i)
		isThere = objects[i] == body;
	return isThere && body->getBroadphaseHandle() && body->getBroadphaseHandle()->getUid() == motion.m_proxy;
}
}  // namespace

void BodyMotion::apply(btCollisionWorld& world) const
{
	if (!isIn(world, *this))
		return;
	if (m_body->getWorldTransform() == m_moved)
	{
		m_body->setWorldTransform(m_end);
		m_body->setInterpolationWorldTransform(m_end);
		m_body->updateInertiaTensor();
	}
	m_body->setLinearVelocity(endOf(m_body->getLinearVelocity(), m_meanLinear, m_linear));
	m_body->setAngularVelocity(endOf(m_body->getAngularVelocity(), m_meanAngular, m_angular));
	// What others have given since is known by these, see SteadyPushes.
	m_body->setInterpolationLinearVelocity(m_linear);
	m_body->setInterpolationAngularVelocity(m_angular);
}
}  // namespace btElasticPlastic
