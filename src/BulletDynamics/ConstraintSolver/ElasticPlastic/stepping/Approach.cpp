// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Approach.h"

#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "LinearMath/btAabbUtil2.h"

namespace btElasticPlastic
{
namespace
{
/// Asks the broadphase which bodies are in the path of a body.
struct Query : btBroadphaseAabbCallback
{
	btDynamicsWorld& m_world;
	const BodyMarks& m_joined;
	btRigidBody* m_body = nullptr;
	Approach m_result;

	Query(btDynamicsWorld& world, const BodyMarks& joined) : m_world(world), m_joined(joined) {}

	static btScalar leastEdge(const btBroadphaseProxy& proxy)
	{
		const btVector3 size = proxy.m_aabbMax - proxy.m_aabbMin;
		return size[size.minAxis()];
	}

	void look(btRigidBody& body, btScalar dt)
	{
		const btBroadphaseProxy* const proxy = body.getBroadphaseProxy();
		const btVector3 way = body.getLinearVelocity() * dt;
		if (!proxy || proxy->m_collisionFilterMask == 0 || way.length() < SHARE * leastEdge(*proxy))
			return;
		btVector3 from = proxy->m_aabbMin, to = proxy->m_aabbMax;
		from.setMin(from + way);
		to.setMax(to + way);
		m_body = &body;
		m_world.getBroadphase()->aabbTest(from, to, *this);
	}

	bool process(const btBroadphaseProxy* other) override
	{
		btBroadphaseProxy* const mine = m_body->getBroadphaseProxy();
		btCollisionObject* const object = static_cast<btCollisionObject*>(other->m_clientObject);
		btRigidBody* const body = btRigidBody::upcast(object);
		if (other == mine || !body || (!m_joined.isMarked(*m_body) && !m_joined.isMarked(*body)) ||
			!passesFilter(*mine, const_cast<btBroadphaseProxy&>(*other)) || !m_body->checkCollideWith(body))
			return true;
		m_result.m_isBlow |=
			!TestAabbAgainstAabb2(mine->m_aabbMin, mine->m_aabbMax, other->m_aabbMin, other->m_aabbMax);
		const btScalar speed = (m_body->getLinearVelocity() - body->getLinearVelocity()).length();
		btSetMax(m_result.m_rate, double(speed / (SHARE * btMin(leastEdge(*mine), leastEdge(*other)))));
		return true;
	}

	bool passesFilter(btBroadphaseProxy& mine, btBroadphaseProxy& other) const
	{
#if BT_BULLET_VERSION >= 305
		return m_world.getPairCache()->needsBroadphaseCollision(&mine, &other);
#else
		// Older ones do not say what a filter of the user's does.
		return (mine.m_collisionFilterGroup & other.m_collisionFilterMask) != 0 &&
			   (other.m_collisionFilterGroup & mine.m_collisionFilterMask) != 0;
#endif
	}

	static constexpr btScalar SHARE = btScalar(0.05);  ///< of the least edge
};
}  // namespace

Approach lookAhead(btDynamicsWorld& world, const BodyMarks& joined, btScalar dt)
{
	Query query(world, joined);
	const btCollisionObjectArray& objects = world.getCollisionObjectArray();
	for (int i = 0; i < objects.size(); ++i)
	{
		btRigidBody* const body = btRigidBody::upcast(objects[i]);
		if (body && (body->getInvMass() > 0 || body->isKinematicObject()) && body->isActive())
			query.look(*body, dt);
	}
	return query.m_result;
}
}  // namespace btElasticPlastic
