// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What the documentation's snippets take for granted.
#ifndef EP_CONSUMERS_SNIPPETS_H
#define EP_CONSUMERS_SNIPPETS_H

#include "BulletDynamics/ConstraintSolver/btElasticPlasticMultiBodyConstraintSolver.h"
#include "BulletDynamics/Dynamics/btDiscreteDynamicsWorldMt.h"
#include "BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h"
#include "BulletCollision/CollisionDispatch/btSimulationIslandManager.h"
#include "LinearMath/btThreads.h"
#include "btBulletDynamicsCommon.h"
#include "btElasticPlasticCommon.h"

#include <stdio.h>

void playSound(const btVector3& place, double energy);

// clang-format off
#define SNIPPET_NAMES                                                                                                  \
	btDiscreteDynamicsWorld &world, btElasticPlasticAction &action, btElasticPlasticConstraintSolver &solver,          \
	btElasticPlasticSolverSettings &settings, btElasticPlasticStepper &stepper,                                        \
	btElasticPlastic6DofSpring2Constraint *joint, btRigidBody &a, btRigidBody &b, btScalar dt,                         \
	btHingeConstraint &hinge, const btElasticPlasticCapacity &capacity, btIDebugDraw *drawer,                          \
	btDispatcher &dispatcher, btDbvtBroadphase &broadphase, btCollisionConfiguration &configuration
// clang-format on

#endif  // EP_CONSUMERS_SNIPPETS_H
