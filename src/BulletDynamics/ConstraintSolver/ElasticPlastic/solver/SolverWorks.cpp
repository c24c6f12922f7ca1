// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "SolverWorks.h"

#include "../joint/JointRegistry.h"
#include "../joint/JointWorks.h"
#include "ContactFactors.h"
#include "BulletCollision/CollisionDispatch/btCollisionObject.h"
#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "BulletDynamics/ConstraintSolver/btContactSolverInfo.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
/// Whether all bodies of an island sleep. Bullet leaves out sleeping islands itself, unless the world does not split islands.
bool isAsleep(const SolverGroup& island)
{
	for (int i = 0; i < island.m_numBodies; ++i)
		if (island.m_bodies[i]->isActive())
			return false;
	return island.m_numBodies > 0;
}

/// Whether any thread may solve an island. It may not if the island's factor is kept from step to step by one solver, or if
/// it has a kinematic body, to which Bullet writes its index among one solver's bodies.
bool isForAnyThread(const SolverGroup& island)
{
	// Bullet's solver gives a kinematic body, and a static one that has kept its mass, a place of its own in each island.
	const auto hasPlace = [](const btCollisionObject& object)
	{
		const btRigidBody* const body = btRigidBody::upcast(&object);
		return object.isKinematicObject() || (object.isStaticObject() && body && body->getInvMass() != 0);
	};
	if (LinearSolver::mayKeepFactor(island.m_numBodies))
		return false;
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (hasPlace(island.m_constraints[i]->getRigidBodyA()) || hasPlace(island.m_constraints[i]->getRigidBodyB()))
			return false;
	for (int i = 0; i < island.m_numManifolds; ++i)
		if (hasPlace(*island.m_manifolds[i]->getBody0()) || hasPlace(*island.m_manifolds[i]->getBody1()))
			return false;
	return true;
}
}  // namespace

SolverWorks::SolverWorks() { m_solvers.emplace_back(new IslandSolver); }

void SolverWorks::setSettings(const btElasticPlasticSolverSettings& settings)
{
	const int threads = settings.m_numThreads;
	if (threads != m_settings.m_numThreads)
	{
		m_pool.reset(threads > 1 ? new WorkerPool(threads) : nullptr);
		m_solvers.resize(size_t(threads));
		for (auto& solver : m_solvers)
			if (!solver)
				solver.reset(new IslandSolver);
	}
	m_settings = settings;
	for (const auto& solver : m_solvers)
		solver->setSettings(settings);
}

void SolverWorks::takeRowSolvers(btSequentialImpulseConstraintSolver& from)
{
	for (const auto& solver : m_solvers)
	{
		solver->setConstraintRowSolverGeneric(from.getActiveConstraintRowSolverGeneric());
		solver->setConstraintRowSolverLowerLimit(from.getActiveConstraintRowSolverLowerLimit());
	}
}

void SolverWorks::beginStep()
{
	m_isInPool = false;
	for (const auto& solver : m_solvers)
		solver->beginStep(false);
}

/// A pool does not tell its solvers of steps, but the time of the joints' action does.
void SolverWorks::beginStepInPool()
{
	if (!m_registry || m_registry->getTime() == m_poolTime)
		return;
	m_poolTime = m_registry->getTime();
	for (const auto& solver : m_solvers)
		solver->beginStep(true);
}

bool SolverWorks::findJoints(const SolverGroup& group)
{
	bool hasJoints = false;
	m_registry = nullptr;
	m_joints.resizeNoInitialize(group.m_numConstraints);
	for (int i = 0; i < group.m_numConstraints; ++i)
	{
		group.prefetchAfter(i);
		m_joints[i] = JointWorks::from(group.m_constraints[i]);
		hasJoints |= m_joints[i] != nullptr;
		if (m_joints[i] && !m_registry)
			m_registry = m_joints[i]->m_entry.m_registry;
	}
	if (m_registry)
		m_substepShare = m_registry->getSubstepShare();
	return hasJoints;
}

SolverGroup SolverWorks::solve(const SolverGroup& given, const btContactSolverInfo& info, btIDebugDraw* debugDrawer,
							   btDispatcher* dispatcher)
{
	if (!findJoints(given))
		return given;
	const ContactFactors factors(given, getSubstepShare());
	SolverGroup group = given;
	group.m_joints = &m_joints[0];
	if (m_settings.m_form == BT_EP_ITERATIVE)
	{
		m_solvers[0]->solve(group, info, debugDrawer, dispatcher, m_isInPool);
		return SolverGroup();
	}
	splitIslands(group, info, dispatcher);
	solveIslands(info, debugDrawer, dispatcher);
	return getOthers();
}

bool SolverWorks::split(const SolverGroup& given, const btContactSolverInfo& info, btDispatcher* dispatcher)
{
	if (!findJoints(given))
		return false;
	SolverGroup group = given;
	group.m_joints = &m_joints[0];
	splitIslands(group, info, dispatcher);
	return true;
}

/// Of a group of which the joints are known.
void SolverWorks::splitIslands(SolverGroup& group, const btContactSolverInfo& info, btDispatcher* dispatcher)
{
	const bool looksAhead = m_settings.m_form == BT_EP_DIRECT && !m_isInPool && dispatcher && info.m_timeStep > 0 &&
							InnerSteps::areAsked(m_settings) && !(m_registry && m_registry->isStepControlled());
	if (m_isInPool)
		beginStepInPool();
	m_islands.find(group);
	if (looksAhead && m_earlyContacts.find(group, m_islands, info.m_timeStep, m_settings, *dispatcher))
		m_islands.find(group);
	m_islands.split(group);
}

void SolverWorks::solveIslands(const btContactSolverInfo& info, btIDebugDraw* debugDrawer, btDispatcher* dispatcher)
{
	m_sharedIslands.clear();
	for (int i = 0; i < m_islands.getNumIslands(); ++i)
	{
		const SolverGroup island = m_islands.getIsland(i);
		if (isAsleep(island))
			continue;
		if (m_pool && isForAnyThread(island))
			m_sharedIslands.push_back(i);
		else
			m_solvers[0]->solve(island, info, debugDrawer, dispatcher, m_isInPool);
	}
	solveShared(info, dispatcher);
}

struct SolverWorks::SharedIslands : WorkerPool::Task
{
	SolverWorks& m_works;
	const btContactSolverInfo& m_info;
	btDispatcher* m_dispatcher;

	SharedIslands(SolverWorks& works, const btContactSolverInfo& info, btDispatcher* dispatcher)
		: m_works(works), m_info(info), m_dispatcher(dispatcher)
	{
	}

	void run(int index, int worker) override
	{
		const SolverGroup island = m_works.m_islands.getIsland(m_works.m_sharedIslands[size_t(index)]);
		m_works.m_solvers[size_t(worker)]->solve(island, m_info, nullptr, m_dispatcher, m_works.m_isInPool);
	}
};

void SolverWorks::solveShared(const btContactSolverInfo& info, btDispatcher* dispatcher)
{
	if (m_sharedIslands.empty())
		return;
	SharedIslands task(*this, info, dispatcher);
	m_pool->run(task, int(m_sharedIslands.size()));
	for (size_t worker = 1; worker < m_solvers.size(); ++worker)
	{
		m_solvers[0]->getStatistics() += m_solvers[worker]->getStatistics();
		m_solvers[worker]->getStatistics() = btElasticPlasticStatistics();
	}
}
}  // namespace btElasticPlastic
