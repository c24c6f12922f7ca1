// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticConstraintSolver.h"

#include <stdio.h>

#include "ElasticPlastic/solver/SolverWorks.h"

btElasticPlasticConstraintSolver::btElasticPlasticConstraintSolver(btElasticPlasticOwnPrecision)
	: m_works(new btElasticPlastic::SolverWorks)
{
}
btElasticPlasticConstraintSolver::~btElasticPlasticConstraintSolver() { delete m_works; }

bool btElasticPlasticConstraintSolver::setSettings(const btElasticPlasticSolverSettings& settings)
{
	if (const btElasticPlasticFault fault = settings.fault())
	{
		char text[192];
		fault.print(text, sizeof text);
		fprintf(stderr, "Bullet Elastic-Plastic refused the solver's settings: %s\n", text);
		return false;
	}
	m_works->setSettings(settings);
	return true;
}

const btElasticPlasticSolverSettings& btElasticPlasticConstraintSolver::getSettings() const
{
	return m_works->getSettings();
}

bool btElasticPlasticConstraintSolver::setForm(btElasticPlasticForm form)
{
	btElasticPlasticSolverSettings settings = getSettings();
	settings.m_form = form;
	return setSettings(settings);
}

bool btElasticPlasticConstraintSolver::setNumThreads(int threads)
{
	btElasticPlasticSolverSettings settings = getSettings();
	settings.m_numThreads = threads;
	return setSettings(settings);
}

const btElasticPlasticStatistics& btElasticPlasticConstraintSolver::getStatistics() const
{
	return m_works->getStatistics();
}

void btElasticPlasticConstraintSolver::resetStatistics() { m_works->getStatistics() = btElasticPlasticStatistics(); }

void btElasticPlasticConstraintSolver::prepareSolve(int numBodies, int numManifolds)
{
	m_works->beginStep();
	btSequentialImpulseConstraintSolver::prepareSolve(numBodies, numManifolds);
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
	if (others.m_numBodies > 0)
		btSequentialImpulseConstraintSolver::solveGroup(others.m_bodies, others.m_numBodies, others.m_manifolds,
														others.m_numManifolds, others.m_constraints,
														others.m_numConstraints, info, debugDrawer, dispatcher);
	return 0;
}
