// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "fuzz/Arena.h"

#include "BulletCollision/CollisionDispatch/btCollisionDispatcherMt.h"
#include "BulletDynamics/Dynamics/btDiscreteDynamicsWorldMt.h"

namespace
{
const int SOLVERS = 4;  ///< in a pool

/// Bullet looks outside an array for the island of a constraint whose bodies both do not move. Who uses its world with threads has to leave those out.
class PoolWorld : public btDiscreteDynamicsWorldMt
{
public:
	using btDiscreteDynamicsWorldMt::btDiscreteDynamicsWorldMt;

protected:
	void solveConstraints(btContactSolverInfo& info) override
	{
		std::vector<btTypedConstraint*> idle;
		for (int i = 0; i < getNumConstraints(); ++i)
		{
			btTypedConstraint* const constraint = getConstraint(i);
			if (constraint->isEnabled() && constraint->getRigidBodyA().getIslandTag() < 0 &&
				constraint->getRigidBodyB().getIslandTag() < 0)
				idle.push_back(constraint);
		}
		for (btTypedConstraint* constraint : idle)
			constraint->setEnabled(false);
		btDiscreteDynamicsWorldMt::solveConstraints(info);
		for (btTypedConstraint* constraint : idle)
			constraint->setEnabled(true);
	}
};
}  // namespace

std::unique_ptr<btConstraintSolver> Arena::makeSolver(bool isStock)
{
	if (isStock)
		return std::make_unique<btSequentialImpulseConstraintSolver>();
	auto own = std::make_unique<btElasticPlasticConstraintSolver>();
	m_own.push_back(own.get());
	return own;
}

std::unique_ptr<btDiscreteDynamicsWorld> Arena::makeWorld(bool isStock, bool isPool)
{
	if (isStock)
		m_unused = makeSolver(false);
	if (!isPool)
	{
		m_solver = makeSolver(isStock);
		return std::make_unique<btDiscreteDynamicsWorld>(m_dispatcher.get(), &m_broadphase, m_solver.get(),
														 &m_configuration);
	}
	btConstraintSolver* solvers[SOLVERS];
	for (btConstraintSolver*& solver : solvers)
		solver = makeSolver(isStock).release();
	auto pool = std::make_unique<btConstraintSolverPoolMt>(solvers, SOLVERS);
	auto world = std::make_unique<PoolWorld>(m_dispatcher.get(), &m_broadphase, pool.get(), nullptr, &m_configuration);
	m_solver = std::move(pool);
	return world;
}

Arena::Arena(bool isStock, bool isPool)
	: m_dispatcher(isPool ? new btCollisionDispatcherMt(&m_configuration)
						  : new btCollisionDispatcher(&m_configuration)),
	  m_owned(makeWorld(isStock, isPool)),
	  m_world(*m_owned),
	  m_quiet(m_world)
{
	m_world.setGravity(btVector3(0, -10, 0));
}

void Arena::setForm(btElasticPlasticForm form)
{
	for (btElasticPlasticConstraintSolver* solver : m_own)
		solver->setForm(form);
}

void Arena::setNumThreads(int threads)
{
	for (btElasticPlasticConstraintSolver* solver : m_own)
		solver->setNumThreads(threads);
}

bool Arena::setSettings(const btElasticPlasticSolverSettings& settings)
{
	bool isTaken = true;
	for (btElasticPlasticConstraintSolver* solver : m_own)
		isTaken &= solver->setSettings(settings);
	return isTaken;
}
