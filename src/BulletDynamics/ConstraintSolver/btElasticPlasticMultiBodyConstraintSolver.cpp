// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticMultiBodyConstraintSolver.h"

#include "ElasticPlastic/solver/ContactFactors.h"
#include "ElasticPlastic/solver/FrozenBodies.h"
#include "ElasticPlastic/solver/MultiBodyGroup.h"

struct btElasticPlasticMultiBodyConstraintSolver::Group : btElasticPlastic::MultiBodyGroup
{
};

btElasticPlasticMultiBodyConstraintSolver::btElasticPlasticMultiBodyConstraintSolver(btElasticPlasticOwnPrecision)
	: m_group(new Group)
{
}
btElasticPlasticMultiBodyConstraintSolver::~btElasticPlasticMultiBodyConstraintSolver() { delete m_group; }

void btElasticPlasticMultiBodyConstraintSolver::prepareSolve(int numBodies, int numManifolds)
{
	m_works->beginStep();
	btMultiBodyConstraintSolver::prepareSolve(numBodies, numManifolds);
}

void btElasticPlasticMultiBodyConstraintSolver::allSolved(const btContactSolverInfo& info, btIDebugDraw* debugDrawer)
{
	m_works->endStep();
	btMultiBodyConstraintSolver::allSolved(info, debugDrawer);
}

void btElasticPlasticMultiBodyConstraintSolver::solveMultiBodyGroup(
	btCollisionObject** bodies, int numBodies, btPersistentManifold** manifolds, int numManifolds,
	btTypedConstraint** constraints, int numConstraints, btMultiBodyConstraint** multiBodyConstraints,
	int numMultiBodyConstraints, const btContactSolverInfo& info, btIDebugDraw* debugDrawer, btDispatcher* dispatcher)
{
	btElasticPlastic::SolverGroup group;
	group.m_bodies = bodies;
	group.m_numBodies = numBodies;
	group.m_manifolds = manifolds;
	group.m_numManifolds = numManifolds;
	group.m_constraints = constraints;
	group.m_numConstraints = numConstraints;
	const bool hasJoints = m_group->split(*m_works, group, numMultiBodyConstraints > 0, info, dispatcher);
	const btElasticPlastic::ContactFactors factors(group, m_works->getSubstepShare());
	const btElasticPlastic::FrozenBodies frozen(bodies, hasJoints ? numBodies : 0);
	if (hasJoints)
		group = m_group->beginRest(info.m_timeStep);
	if (!hasJoints || group.m_numBodies > 0)
		btMultiBodyConstraintSolver::solveMultiBodyGroup(
			group.m_bodies, group.m_numBodies, group.m_manifolds, group.m_numManifolds, group.m_constraints,
			group.m_numConstraints, multiBodyConstraints, numMultiBodyConstraints, info, debugDrawer, dispatcher);
	if (!hasJoints)
		return;
	m_group->finishRest();
	m_works->takeRowSolvers(*this);
	m_works->solveIslands(info, debugDrawer, dispatcher);
}
