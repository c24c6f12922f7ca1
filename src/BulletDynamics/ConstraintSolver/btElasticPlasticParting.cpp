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

#include "btElasticPlasticParting.h"

#include "BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h"
#include "BulletCollision/BroadphaseCollision/btOverlappingPairCache.h"
#include "BulletCollision/CollisionDispatch/btCollisionWorld.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

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

btScalar btElasticPlasticOverlap(btCollisionWorld& world, btRigidBody& a, btRigidBody& b)
{
	if (!a.getBroadphaseHandle() || !b.getBroadphaseHandle())
		return 0;
	Deepest deepest;
	world.contactPairTest(&a, &b, deepest);
	return deepest.m_depth;
}

btScalar btElasticPlasticHoldOverlap(btCollisionWorld& world, btRigidBody& a, btRigidBody& b)
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
