// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticConstraintSolver.h"

#include "ElasticPlastic/solver/ContactFactors.h"
#include "ElasticPlastic/solver/SolverWorks.h"

btElasticPlasticConstraintSolver::btElasticPlasticConstraintSolver(btElasticPlasticOwnPrecision) {}
btElasticPlasticConstraintSolver::~btElasticPlasticConstraintSolver() {}

void btElasticPlasticConstraintSolver::prepareSolve(int numBodies, int numManifolds)
{
	m_works->beginStep();
	btSequentialImpulseConstraintSolver::prepareSolve(numBodies, numManifolds);
}

void btElasticPlasticConstraintSolver::allSolved(const btContactSolverInfo& info, btIDebugDraw* debugDrawer)
{
	m_works->endStep();
	btSequentialImpulseConstraintSolver::allSolved(info, debugDrawer);
}

btScalar btElasticPlasticConstraintSolver::solveGroup(btCollisionObject** bodies, int numBodies,
													  btPersistentManifold** manifolds, int numManifolds,
													  btTypedConstraint** constraints, int numConstraints,
													  const btContactSolverInfo& info, btIDebugDraw* debugDrawer,
													  btDispatcher* dispatcher)
{
	m_works->takeRowSolvers(*this);
	btElasticPlastic::SolverGroup group;
	group.m_bodies = bodies;
	group.m_numBodies = numBodies;
	group.m_manifolds = manifolds;
	group.m_numManifolds = numManifolds;
	group.m_constraints = constraints;
	group.m_numConstraints = numConstraints;
	const btElasticPlastic::SolverGroup others = m_works->solve(group, info, debugDrawer, dispatcher);
	const btElasticPlastic::ContactFactors factors(others, m_works->getSubstepShare());
	if (others.m_numBodies > 0)
		btSequentialImpulseConstraintSolver::solveGroup(others.m_bodies, others.m_numBodies, others.m_manifolds,
														others.m_numManifolds, others.m_constraints,
														others.m_numConstraints, info, debugDrawer, dispatcher);
	return 0;
}
