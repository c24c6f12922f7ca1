// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CONSTRAINT_SOLVER_H
#define BT_ELASTIC_PLASTIC_CONSTRAINT_SOLVER_H

#include "BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h"
#include "btElasticPlasticSolver.h"

/// Bullet's solver, which also solves elastic-plastic joints accurately: give it to the world instead of
/// btSequentialImpulseConstraintSolver. Islands without elastic-plastic joints are solved as by Bullet, bit for bit.
///
/// Direct (the default): all joints of an island at once, by a sparse factorisation. A stiff structure holds at any step. Contacts are
/// solved with them or swept around them, see btElasticPlasticContacts.
///
/// Iterative: Bullet's sequential impulses, with rows that have the joints' true compliance.
class alignas(16) btElasticPlasticConstraintSolver : public btSequentialImpulseConstraintSolver,
													 public btElasticPlasticSolver
{
public:
	BT_DECLARE_ALIGNED_ALLOCATOR();

	btElasticPlasticConstraintSolver(btElasticPlasticOwnPrecision = {});
	~btElasticPlasticConstraintSolver() override;

	void prepareSolve(int numBodies, int numManifolds) override;
	void allSolved(const btContactSolverInfo& info, btIDebugDraw* debugDrawer) override;
	btScalar solveGroup(btCollisionObject** bodies, int numBodies, btPersistentManifold** manifolds, int numManifolds,
						btTypedConstraint** constraints, int numConstraints, const btContactSolverInfo& info,
						btIDebugDraw* debugDrawer, btDispatcher* dispatcher) override;
};

#endif  // BT_ELASTIC_PLASTIC_CONSTRAINT_SOLVER_H
