// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Separation.h"

#include "BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h"
#include "BulletCollision/BroadphaseCollision/btOverlappingPairCache.h"
#include "BulletCollision/CollisionDispatch/btCollisionWorld.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
struct Deepest : btCollisionWorld::ContactResultCallback
{
	btScalar m_depth = 0;

	btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
							 const btCollisionObjectWrapper*, int, int) override
	{
		btSetMax(m_depth, -point.getDistance());
		return 0;
	}
};
}  // namespace

btScalar overlapOf(btCollisionWorld& world, btRigidBody& a, btRigidBody& b)
{
	if (!a.getBroadphaseHandle() || !b.getBroadphaseHandle())
		return 0;
	Deepest deepest;
	world.contactPairTest(&a, &b, deepest);
	return deepest.m_depth;
}

btScalar suspendRecovery(btCollisionWorld& world, btRigidBody& a, btRigidBody& b)
{
	btScalar depth = 0;
	if (!a.getBroadphaseHandle() || !b.getBroadphaseHandle())
		return depth;
	btBroadphasePair* const pair = world.getPairCache()->findPair(a.getBroadphaseHandle(), b.getBroadphaseHandle());
	if (!pair || !pair->m_algorithm)
		return depth;
	btManifoldArray manifolds;
	pair->m_algorithm->getAllContactManifolds(manifolds);
	for (int m = 0; m < manifolds.size(); ++m)
		for (int i = 0; i < manifolds[m]->getNumContacts(); ++i)
		{
			btManifoldPoint& point = manifolds[m]->getContactPoint(i);
			btSetMax(depth, -point.getDistance());
			point.setDistance(btMax(point.getDistance(), btScalar(0)));
		}
	return depth;
}
}  // namespace btElasticPlastic
