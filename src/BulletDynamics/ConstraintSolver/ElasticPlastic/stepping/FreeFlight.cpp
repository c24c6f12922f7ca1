// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "FreeFlight.h"

#include "BodyMarks.h"
#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "BulletDynamics/ConstraintSolver/btTypedConstraint.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
/// The world's bodies that have constraints or contacts.
BodyMarks findHeld(btDynamicsWorld& world)
{
	BodyMarks held;
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
}  // namespace

void keepFreeFlight(btDynamicsWorld& world, btScalar later)
{
	const BodyMarks held = findHeld(world);
	const btCollisionObjectArray& objects = world.getCollisionObjectArray();
	for (int i = 0; i < objects.size(); ++i)
	{
		btRigidBody* const body = btRigidBody::upcast(objects[i]);
		if (body && body->getInvMass() > 0 && body->isActive() && !held.isMarked(*body))
			body->setLinearVelocity(body->getLinearVelocity() + body->getGravity() * body->getLinearFactor() * later);
	}
}
}  // namespace btElasticPlastic
