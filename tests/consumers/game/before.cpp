// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// A small game as Bullet alone makes it: a ball hits the mast of a crane, which is fixed to the ground and holds a boom.
#include <stdio.h>

#include "btBulletDynamicsCommon.h"

int main()
{
	btDefaultCollisionConfiguration configuration;
	btCollisionDispatcher dispatcher(&configuration);
	btDbvtBroadphase broadphase;
	btSequentialImpulseConstraintSolver solver;
	btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);

	btBoxShape groundShape(btVector3(50, 1, 50)), mastShape(btVector3(0.2, 5, 0.2)), boomShape(btVector3(4, 0.2, 0.2));
	btSphereShape ballShape(1);
	const auto makeBody = [&](btScalar mass, btCollisionShape& shape, const btVector3& place)
	{
		btVector3 inertia(0, 0, 0);
		if (mass > 0)
			shape.calculateLocalInertia(mass, inertia);
		btRigidBody* body = new btRigidBody(mass, nullptr, &shape, inertia);
		body->setWorldTransform(btTransform(btQuaternion::getIdentity(), place));
		world.addRigidBody(body);
		return body;
	};
	btRigidBody* const ground = makeBody(0, groundShape, btVector3(0, -1, 0));
	btRigidBody* const mast = makeBody(800, mastShape, btVector3(0, 5, 0));
	btRigidBody* const boom = makeBody(300, boomShape, btVector3(4.2, 9.8, 0));
	btRigidBody* const ball = makeBody(2000, ballShape, btVector3(0, 3, -8));
	ball->setLinearVelocity(btVector3(0, 0, 15));

	const btTransform up(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI), btVector3(0, 1, 0));
	btGeneric6DofSpring2Constraint foot(*ground, *mast, up, btTransform(up.getBasis(), btVector3(0, -5, 0)));
	const btQuaternion along = btQuaternion::getIdentity();
	btGeneric6DofSpring2Constraint head(*mast, *boom, btTransform(along, btVector3(0.2, 4.8, 0)),
										btTransform(along, btVector3(-4, 0, 0)));
	for (btGeneric6DofSpring2Constraint* joint : {&foot, &head})
	{
		joint->setAngularLowerLimit(btVector3(0, 0, 0));
		joint->setAngularUpperLimit(btVector3(0, 0, 0));
		world.addConstraint(joint, true);
	}

	for (int frame = 0; frame < 3 * 60; ++frame)
		world.stepSimulation(btScalar(1) / 60);
	printf("The boom is at a height of %.1f m\n", double(boom->getCenterOfMassPosition().y()));

	for (btGeneric6DofSpring2Constraint* joint : {&foot, &head})
		world.removeConstraint(joint);
	for (btRigidBody* body : {ground, mast, boom, ball})
	{
		world.removeRigidBody(body);
		delete body;
	}
	return 0;
}
