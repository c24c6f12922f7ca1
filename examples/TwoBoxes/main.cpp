// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The smallest program that works: a box hangs from another on a steel rod, yields, and tears off.
#include <cstdio>

#include "BulletDynamics/ConstraintSolver/btElasticPlastic6DofSpring2Constraint.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticAction.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "btBulletDynamicsCommon.h"

struct Printer : btElasticPlasticListener
{
	void onYield(const btElasticPlasticEvent& e) override { print("yields", e); }
	void onBreak(const btElasticPlasticEvent& e) override { print("broke", e); }
	static void print(const char* what, const btElasticPlasticEvent& e)
	{
		printf("%.3f s: the rod %s at %.0f N (%s), energy %.0f J\n", e.m_time, what, double(e.m_force.x()),
			   btElasticPlasticDofName(e.m_dof), e.m_energy);
	}
};

int main()
{
	btBoxShape box(btVector3(0.5, 0.5, 0.5));
	btVector3 inertia;
	box.calculateLocalInertia(3000, inertia);
	btRigidBody support(0, nullptr, &box), load(3000, nullptr, &box, inertia);
	load.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, -2, 0)));

	// A Bullet world as ever, but with our solver: that is one line.
	btDefaultCollisionConfiguration configuration;
	btCollisionDispatcher dispatcher(&configuration);
	btDbvtBroadphase broadphase;
	btElasticPlasticConstraintSolver solver;
	btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);

	world.addRigidBody(&support);
	world.addRigidBody(&load);

	// One bookkeeper per world.
	Printer printer;
	btElasticPlasticAction action;
	action.setListener(&printer);
	world.addAction(&action);

	// The joint sits in the middle, its x axis runs along the rod: 1 x 1 cm of steel, 1 m long, tears at 20 % strain.
	const btQuaternion down(btVector3(0, 0, 1), -SIMD_HALF_PI);
	btElasticPlastic6DofSpring2Constraint joint(support, load, btTransform(down, btVector3(0, -1, 0)),
												btTransform(down, btVector3(0, 1, 0)));
	joint.setCapacity(btElasticPlasticCapacity::fromRod(btElasticPlasticMaterial::steel(200e6),
														btElasticPlasticSection::rectangle(0.01, 0.01), 1));
	world.addConstraint(&joint);
	action.addJoint(&joint);

	for (int i = 0; i < 240 && !joint.isBroken(); ++i)
		world.stepSimulation(btScalar(1) / 240, 0);
	return joint.isBroken() ? 0 : 1;
}
