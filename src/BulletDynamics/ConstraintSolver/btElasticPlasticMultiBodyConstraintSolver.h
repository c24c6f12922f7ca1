// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_MULTI_BODY_CONSTRAINT_SOLVER_H
#define BT_ELASTIC_PLASTIC_MULTI_BODY_CONSTRAINT_SOLVER_H

#include "BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h"
#include "btElasticPlasticSolver.h"

/// Bullet's solver for btMultiBodyDynamicsWorld, which also solves elastic-plastic joints accurately: give it to the world instead
/// of btMultiBodyConstraintSolver. What has no elastic-plastic joints is solved as by Bullet.
///
/// Elastic-plastic joints join rigid bodies: a btTypedConstraint cannot refer to a link. A rigid body is tied to a link by Bullet's
/// btMultiBodyFixedConstraint and its like. Where links touch a structure of elastic-plastic joints, or are tied to it, Bullet first
/// finds the impulses between the links and the structure's bodies as if those were free, and then the joints are solved for the
/// velocities that are left. Momentum is kept; a contact under load gives by about dt^2 g m / (0.2 m_p), with the mass m on it and
/// that of the touched body m_p: make parts on which robots stand no lighter than these.
///
/// Bullet's world must split islands (btSimulationIslandManager::setSplitIslands, its default): it passes a wrong number of multibody
/// constraints otherwise.
class alignas(16) btElasticPlasticMultiBodyConstraintSolver : public btMultiBodyConstraintSolver,
															  public btElasticPlasticSolver
{
public:
	BT_DECLARE_ALIGNED_ALLOCATOR();

	btElasticPlasticMultiBodyConstraintSolver(btElasticPlasticOwnPrecision = {});
	~btElasticPlasticMultiBodyConstraintSolver() override;

	void prepareSolve(int numBodies, int numManifolds) override;
	void allSolved(const btContactSolverInfo& info, btIDebugDraw* debugDrawer) override;
	void solveMultiBodyGroup(btCollisionObject** bodies, int numBodies, btPersistentManifold** manifolds,
							 int numManifolds, btTypedConstraint** constraints, int numConstraints,
							 btMultiBodyConstraint** multiBodyConstraints, int numMultiBodyConstraints,
							 const btContactSolverInfo& info, btIDebugDraw* debugDrawer,
							 btDispatcher* dispatcher) override;

private:
	struct Group;

	Group* const m_group;
};

#endif  // BT_ELASTIC_PLASTIC_MULTI_BODY_CONSTRAINT_SOLVER_H
