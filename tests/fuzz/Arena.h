// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_FUZZ_ARENA_H
#define EP_FUZZ_ARENA_H

#include <memory>
#include <vector>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "btBulletDynamicsCommon.h"
#include "fuzz/Quiet.h"
#include "world/SmallPools.h"

/// A world with a quiet island in it.
struct Arena
{
	/// \param isStock  solved by Bullet's own solver
	/// \param isPool   a world of Bullet's with threads, and a pool of solvers
	Arena(bool isStock, bool isPool);

	void setForm(btElasticPlasticForm form);
	void setNumThreads(int threads);
	btElasticPlasticSolverSettings getSettings() const { return m_own[0]->getSettings(); }
	/// \return whether they are taken
	bool setSettings(const btElasticPlasticSolverSettings& settings);

	btDefaultCollisionConfiguration m_configuration{ep::smallPools()};
	const std::unique_ptr<btCollisionDispatcher> m_dispatcher;
	btDbvtBroadphase m_broadphase;
	std::vector<btElasticPlasticConstraintSolver*> m_own;  ///< ours, all set up alike
	std::unique_ptr<btConstraintSolver> m_unused;          ///< of ours, where Bullet's own is in use
	std::unique_ptr<btConstraintSolver> m_solver;          ///< or the pool of all
	const std::unique_ptr<btDiscreteDynamicsWorld> m_owned;
	btDiscreteDynamicsWorld& m_world;
	Quiet m_quiet;

private:
	std::unique_ptr<btConstraintSolver> makeSolver(bool isStock);
	std::unique_ptr<btDiscreteDynamicsWorld> makeWorld(bool isStock, bool isPool);
};

#endif  // EP_FUZZ_ARENA_H
