// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The library as a project outside uses it: a beam of reinforced concrete juts out of a wall, with too little steel in it.
// It bends at the wall and breaks off; what the fall has released must be where the joint's books say.
#include <math.h>
#include <stdio.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlastic6DofSpring2Constraint.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticAction.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "btBulletDynamicsCommon.h"

int main()
{
	const auto material = btElasticPlasticMaterial::reinforcedConcrete(btScalar(0.002));
	const auto section = btElasticPlasticSection::rectangle(1, 1);
	const btScalar gravity = 10, length = 4, mass = material.m_density * section.m_area * length;

	btBoxShape wallShape(btVector3(1, 5, 5)), beamShape(btVector3(length / 2, btScalar(0.5), btScalar(0.5)));
	btVector3 inertia;
	beamShape.calculateLocalInertia(mass, inertia);
	btRigidBody wall(0, nullptr, &wallShape), beam(mass, nullptr, &beamShape, inertia);
	wall.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(-1, 0, 0)));
	beam.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(length / 2, 0, 0)));

	// After the bodies, so that it goes before them.
	btDefaultCollisionConfiguration configuration;
	btCollisionDispatcher dispatcher(&configuration);
	btDbvtBroadphase broadphase;
	btElasticPlasticConstraintSolver solver;
	btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
	world.setGravity(btVector3(0, -gravity, 0));
	world.addRigidBody(&wall);
	world.addRigidBody(&beam);

	btElasticPlasticAction action;
	world.addAction(&action);
	btElasticPlastic6DofSpring2Constraint joint(wall, beam,
												btTransform(btQuaternion::getIdentity(), btVector3(1, 0, 0)),
												btTransform(btQuaternion::getIdentity(), btVector3(-length / 2, 0, 0)));
	joint.setCapacity(btElasticPlasticCapacity::fromMember(material, section, 0, length));
	world.addConstraint(&joint, true);
	if (!action.addJoint(&joint))
		return 1;

	for (int i = 0; i < 5 * 240 && !joint.isBroken(); ++i)
		world.stepSimulation(btScalar(1) / 240, 0);

	btElasticPlasticEvent yield, tear;
	if (!action.popEvent(yield) || yield.m_type != BT_EP_EVENT_YIELD || !action.popEvent(tear) ||
		tear.m_type != BT_EP_EVENT_BREAK || tear.m_dof != BT_EP_BENDING_Z)
	{
		printf("The beam did not bend and break\n");
		return 1;
	}
	printf("%.3f s: yields; %.3f s: broke in %s, energy %.0f J\n", yield.m_time, tear.m_time,
		   btElasticPlasticDofName(tear.m_dof), tear.m_energy);

	// What gravity gave and the beam does not have as motion went into the joint; gravity's part is known to a step's fall.
	const double released = -mass * gravity * beam.getCenterOfMassPosition().y();
	const double kinetic = 0.5 * (mass * beam.getLinearVelocity().length2() +
								  beam.getAngularVelocity().length2() / beam.getInvInertiaDiagLocal().z());
	printf("Released %.0f J, in motion %.0f J, in the joint %.0f J\n", released, kinetic, joint.getWork());
	return tear.m_energy > 0 && fabs(released - kinetic - joint.getWork()) < 0.01 * released ? 0 : 1;
}
