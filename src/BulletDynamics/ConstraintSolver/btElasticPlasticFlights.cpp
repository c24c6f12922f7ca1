/*
Bullet Elastic-Plastic: joints for Bullet Physics that bend before they break
Copyright (c) 2026 Bullet Elastic-Plastic contributors

This software is provided 'as-is', without any express or implied warranty.
In no event will the authors be held liable for any damages arising from the use of this software.
Permission is granted to anyone to use this software for any purpose,
including commercial applications, and to alter it and redistribute it freely,
subject to the following restrictions:

1. The origin of this software must not be misrepresented; you must not claim that you wrote the original software. If you use this software in a product, an acknowledgment in the product documentation would be appreciated but is not required.
2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the original software.
3. This notice may not be removed or altered from any source distribution.
*/

#include "btElasticPlasticFlights.h"

#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "BulletDynamics/ConstraintSolver/btTypedConstraint.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "LinearMath/btAabbUtil2.h"

namespace
{
struct Approach : btBroadphaseAabbCallback
{
	btDynamicsWorld& m_world;
	const btElasticPlasticBodyMarks& m_joined;
	btRigidBody* m_body = nullptr;
	btElasticPlasticApproach m_result;

	Approach(btDynamicsWorld& world, const btElasticPlasticBodyMarks& joined) : m_world(world), m_joined(joined) {}

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
			!m_world.getPairCache()->needsBroadphaseCollision(mine, const_cast<btBroadphaseProxy*>(other)) ||
			!m_body->checkCollideWith(body))
			return true;
		m_result.m_isBlow |=
			!TestAabbAgainstAabb2(mine->m_aabbMin, mine->m_aabbMax, other->m_aabbMin, other->m_aabbMax);
		const btScalar speed = (m_body->getLinearVelocity() - body->getLinearVelocity()).length();
		btSetMax(m_result.m_rate, double(speed / (SHARE * btMin(leastEdge(*mine), leastEdge(*other)))));
		return true;
	}

	static constexpr btScalar SHARE = btScalar(0.05);  ///< of an edge
};
}  // namespace

btElasticPlasticApproach btElasticPlasticLookAhead(btDynamicsWorld& world, const btElasticPlasticBodyMarks& joined,
												   btScalar dt)
{
	Approach approach(world, joined);
	const btCollisionObjectArray& objects = world.getCollisionObjectArray();
	for (int i = 0; i < objects.size(); ++i)
	{
		btRigidBody* const body = btRigidBody::upcast(objects[i]);
		if (body && (body->getInvMass() > 0 || body->isKinematicObject()) && body->isActive())
			approach.look(*body, dt);
	}
	return approach.m_result;
}

/// Which of the world's bodies have constraints or contacts.
static btElasticPlasticBodyMarks findHeld(btDynamicsWorld& world)
{
	btElasticPlasticBodyMarks held;
	held.clear(world.getNumCollisionObjects());
	for (int i = 0; i < world.getNumConstraints(); ++i)
	{
		held.mark(world.getConstraint(i)->getRigidBodyA());
		held.mark(world.getConstraint(i)->getRigidBodyB());
	}
	btDispatcher& dispatcher = *world.getDispatcher();
	for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
	{
		const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
		if (manifold.getNumContacts() == 0)
			continue;
		held.mark(*manifold.getBody0());
		held.mark(*manifold.getBody1());
	}
	return held;
}

void btElasticPlasticKeepFlights(btDynamicsWorld& world, btScalar later)
{
	const btElasticPlasticBodyMarks held = findHeld(world);
	const btCollisionObjectArray& objects = world.getCollisionObjectArray();
	for (int i = 0; i < objects.size(); ++i)
	{
		btRigidBody* const body = btRigidBody::upcast(objects[i]);
		if (body && body->getInvMass() > 0 && body->isActive() && !held.isMarked(*body))
			body->setLinearVelocity(body->getLinearVelocity() + body->getGravity() * body->getLinearFactor() * later);
	}
}
