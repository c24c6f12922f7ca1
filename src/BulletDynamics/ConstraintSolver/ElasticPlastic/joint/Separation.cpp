// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Separation.h"

#include "BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h"
#include "BulletCollision/BroadphaseCollision/btOverlappingPairCache.h"
#include "BulletCollision/CollisionDispatch/btCollisionWorld.h"
#include "BulletDynamics/ConstraintSolver/btTypedConstraint.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
/// Overlaps up to this do not count [m].
const btScalar SLOP = btScalar(1e-4);

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

/// How deep the bodies' shapes overlap now [m], 0 if they do not.
btScalar overlapOf(btCollisionWorld& world, btRigidBody& a, btRigidBody& b)
{
	if (!a.getBroadphaseHandle() || !b.getBroadphaseHandle())
		return 0;
	Deepest deepest;
	world.contactPairTest(&a, &b, deepest);
	return deepest.m_depth;
}

/// Sets the penetration of the bodies' contact points to zero, after collision detection and before contacts become rows.
/// \return the deepest penetration it found [m]
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
}  // namespace

bool Separation::begin(btDynamicsWorld& world, btTypedConstraint& constraint)
{
	if (overlapOf(world, constraint.getRigidBodyA(), constraint.getRigidBodyB()) <= SLOP)
		return false;
	// The overlap has not been measured in a step yet.
	resume(world, constraint, SIMD_INFINITY);
	return true;
}

void Separation::resume(btDynamicsWorld& world, btTypedConstraint& constraint, btScalar overlap)
{
	world.addConstraint(&constraint, false);
	m_world = &world;
	m_overlap = overlap;
}

void Separation::end(btDynamicsWorld* world, btTypedConstraint& constraint)
{
	m_world = nullptr;
	for (int i = world ? world->getNumConstraints() - 1 : -1; i >= 0; --i)
		if (world->getConstraint(i) == &constraint)
		{
			world->removeConstraint(&constraint);
			return;
		}
}

bool Separation::isDone() const { return m_overlap <= SLOP; }

void Separation::holdOverlap(btTypedConstraint& constraint)
{
	if (m_world)
		m_overlap = suspendRecovery(*m_world, constraint.getRigidBodyA(), constraint.getRigidBodyB());
}
}  // namespace btElasticPlastic
