// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticConstraintSolver.h"

#include "BulletCollision/CollisionDispatch/btCollisionObject.h"
#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"

// ---- islands

void btElasticPlasticConstraintSolver::setNumThreads(int threads)
{
	m_crew.reset(threads > 1 ? new btElasticPlastic::WorkerPool(threads) : nullptr);
	m_assistants.resize(threads > 1 ? threads - 1 : 0);
	for (auto& assistant : m_assistants)
		assistant.reset(new btElasticPlasticConstraintSolver);
}

void btElasticPlasticConstraintSolver::prepareSolve(int numBodies, int numManifolds)
{
	m_system.getLinearSolver().beginStep();
	for (const auto& assistant : m_assistants)
		assistant->prepareSolve(numBodies, numManifolds);
	btSequentialImpulseConstraintSolver::prepareSolve(numBodies, numManifolds);
}

namespace
{
/// Bullet looks itself, but not where the world does not split islands.
bool isAsleep(const btElasticPlastic::SolverGroup& island)
{
	for (int i = 0; i < island.m_numBodies; ++i)
		if (island.m_bodies[i]->isActive())
			return false;
	return island.m_numBodies > 0;
}

/// Is it any thread's business? Not if its factor is kept from step to step, and not with a kinematic body, in which Bullet
/// notes which of a solver's bodies it is.
bool isLight(const btElasticPlastic::SolverGroup& island)
{
	if (btElasticPlastic::LinearSolver::mayKeepFactor(island.m_numBodies))
		return false;
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_constraints[i]->getRigidBodyA().isKinematicObject() ||
			island.m_constraints[i]->getRigidBodyB().isKinematicObject())
			return false;
	for (int i = 0; i < island.m_numManifolds; ++i)
		if (island.m_manifolds[i]->getBody0()->isKinematicObject() ||
			island.m_manifolds[i]->getBody1()->isKinematicObject())
			return false;
	return true;
}

/// Bullet gives bodies their gravity first and wakes the rest of an island then: for a step that rest would weigh nothing,
/// and a structure that carries itself spring up.
void giveWokenTheirWeight(btCollisionObject** bodies, int numBodies)
{
	for (int i = 0; i < numBodies; ++i)
	{
		btRigidBody* const body = btRigidBody::upcast(bodies[i]);
		// Bullet leaves nobody else like this: who is tired has been at rest for a while.
		if (body && body->getActivationState() == WANTS_DEACTIVATION && body->getDeactivationTime() == 0)
			body->applyGravity();
	}
}
}  // namespace

void btElasticPlasticConstraintSolver::solveIsland(const btElasticPlastic::SolverGroup& island, const btContactSolverInfo& info,
												   btIDebugDraw* debugDrawer, btDispatcher* dispatcher)
{
	m_islandJoints = island.m_joints;
	if (m_islandJoints)
		giveWokenTheirWeight(island.m_bodies, island.m_numBodies);
	btSequentialImpulseConstraintSolver::solveGroup(island.m_bodies, island.m_numBodies, island.m_manifolds,
													island.m_numManifolds, island.m_constraints,
													island.m_numConstraints, info, debugDrawer, dispatcher);
}

/// Islands that the crew shares.
struct btElasticPlasticConstraintSolver::LightIslands : btElasticPlastic::WorkerPool::Task
{
	btElasticPlasticConstraintSolver& m_solver;
	const btContactSolverInfo& m_info;
	btDispatcher* m_dispatcher;
	std::vector<int>& m_islands;

	LightIslands(btElasticPlasticConstraintSolver& solver, const btContactSolverInfo& info, btDispatcher* dispatcher)
		: m_solver(solver), m_info(info), m_dispatcher(dispatcher), m_islands(solver.m_lightIslands)
	{
		m_islands.clear();
	}

	void solve()
	{
		if (m_islands.empty())
			return;
		for (auto& assistant : m_solver.m_assistants)
			assistant->m_system.copySettings(m_solver.m_system);
		m_solver.m_crew->run(*this, int(m_islands.size()));
		for (auto& assistant : m_solver.m_assistants)
		{
			m_solver.m_system.getStatistics() += assistant->getStatistics();
			assistant->resetStatistics();
		}
	}

	void run(int index, int worker) override
	{
		btElasticPlasticConstraintSolver& solver = worker == 0 ? m_solver : *m_solver.m_assistants[worker - 1];
		solver.solveIsland(m_solver.m_islands.getIsland(m_islands[index]), m_info, nullptr, m_dispatcher);
	}
};

btScalar btElasticPlasticConstraintSolver::solveGroup(btCollisionObject** bodies, int numBodies,
													  btPersistentManifold** manifolds, int numManifolds,
													  btTypedConstraint** constraints, int numConstraints,
													  const btContactSolverInfo& info, btIDebugDraw* debugDrawer,
													  btDispatcher* dispatcher)
{
	bool hasJoints = false;
	m_joints.resizeNoInitialize(numConstraints);
	for (int i = 0; i < numConstraints; ++i)
	{
		m_joints[i] = btElasticPlasticJoint::from(constraints[i]);
		hasJoints |= m_joints[i] != nullptr;
	}
	btElasticPlastic::SolverGroup group = {bodies, numBodies, manifolds, numManifolds, constraints, numConstraints, nullptr};
	if (hasJoints)
		group.m_joints = &m_joints[0];
	if (!hasJoints || m_form == BT_EP_ITERATIVE)
	{
		solveIsland(group, info, debugDrawer, dispatcher);
		return 0;
	}
	m_islands.split(group);
	LightIslands light(*this, info, dispatcher);
	for (int i = 0; i < m_islands.getNumIslands(); ++i)
	{
		const btElasticPlastic::SolverGroup island = m_islands.getIsland(i);
		if (isAsleep(island))
			continue;
		if (m_crew && isLight(island))
			m_lightIslands.push_back(i);
		else
			solveIsland(island, info, debugDrawer, dispatcher);
	}
	light.solve();
	group = m_islands.getOthers();
	group.m_joints = nullptr;
	if (group.m_numBodies > 0)
		solveIsland(group, info, debugDrawer, dispatcher);
	return 0;
}

// ---- rows, the iterative form

void btElasticPlasticConstraintSolver::convertJoints(btTypedConstraint** constraints, int numConstraints,
													 const btContactSolverInfo& info)
{
	m_jointRows.resize(0);
	m_directJoints.resize(0);
	if (!m_islandJoints)
		btSequentialImpulseConstraintSolver::convertJoints(constraints, numConstraints, info);
	else if (m_form == BT_EP_DIRECT)
		convertToUnits(constraints, numConstraints, info);
	else
		convertToRows(constraints, numConstraints, info);
}

void btElasticPlasticConstraintSolver::convertToRows(btTypedConstraint** constraints, int numConstraints,
													 const btContactSolverInfo& info)
{
	for (int i = 0; i < numConstraints; ++i)
		// A disabled one will not be asked for rows.
		if (m_islandJoints[i] && constraints[i]->isEnabled())
			m_islandJoints[i]->request(btElasticPlasticJoint::JACOBIANS);
	btSequentialImpulseConstraintSolver::convertJoints(constraints, numConstraints, info);

	int end = 0;
	for (int i = 0; i < numConstraints; ++i)
	{
		end += m_tmpConstraintSizesPool[i].m_numConstraintRows;
		if (!m_islandJoints[i] || !constraints[i]->isEnabled())
			continue;
		// The joint's own rows are the last of its constraint's.
		btElasticPlasticJoint& joint = *m_islandJoints[i];
		const JointRows rows = {&joint, end - joint.getNumRows()};
		m_jointRows.push_back(rows);
		for (int r = 0; r < joint.getNumRows(); ++r)
			makeSoft(m_tmpSolverNonContactConstraintPool[rows.m_firstRow + r], joint, r, info);
	}
}

/// Bullet has made J, A and -J v / A of the row; the rest comes from the joint:
/// impulse += (r - J v - C impulse - J dv) / (A + C).
void btElasticPlasticConstraintSolver::makeSoft(btSolverConstraint& row, btElasticPlasticJoint& joint, int r,
												const btContactSolverInfo& info)
{
	btScalar a, velocity;
	if (row.m_jacDiagABInv > 0)
	{
		a = 1 / row.m_jacDiagABInv;
		velocity = -row.m_rhs * a;
	}
	else
	{
		// Where A <= SIMD_EPSILON, in float two bodies of 8000 t, Bullet has put 0.
		const btSolverBody &A = m_tmpSolverBodyPool[row.m_solverBodyIdA], &B = m_tmpSolverBodyPool[row.m_solverBodyIdB];
		a = row.m_contactNormal1.length2() * joint.getConstraint().getRigidBodyA().getInvMass() +
			row.m_contactNormal2.length2() * joint.getConstraint().getRigidBodyB().getInvMass() +
			row.m_angularComponentA.dot(row.m_relpos1CrossNormal) +
			row.m_angularComponentB.dot(row.m_relpos2CrossNormal);
		velocity = row.m_contactNormal1.dot(A.m_linearVelocity + A.m_externalForceImpulse) +
				   row.m_relpos1CrossNormal.dot(A.m_angularVelocity + A.m_externalTorqueImpulse) +
				   row.m_contactNormal2.dot(B.m_linearVelocity + B.m_externalForceImpulse) +
				   row.m_relpos2CrossNormal.dot(B.m_angularVelocity + B.m_externalTorqueImpulse);
	}
	const btElasticPlastic::SoftRow soft = joint.implicitRow(r, a, info.m_erp);
	row.m_jacDiagABInv = 1 / (a + soft.m_compliance);
	row.m_rhs = (soft.m_velocity - velocity) * row.m_jacDiagABInv;
	row.m_cfm = soft.m_compliance * row.m_jacDiagABInv;
	// Bullet has put the breaking threshold there, if the user wants that too.
	btSetMax(row.m_lowerLimit, soft.m_lower);
	btSetMin(row.m_upperLimit, soft.m_upper);
}

btScalar btElasticPlasticConstraintSolver::solveGroupCacheFriendlyIterations(
	btCollisionObject** bodies, int numBodies, btPersistentManifold** manifolds, int numManifolds,
	btTypedConstraint** constraints, int numConstraints, const btContactSolverInfo& info, btIDebugDraw* debugDrawer)
{
	if (m_directJoints.size() > 0)
	{
		if (solveDirectly(info))
		{
			solveGroupCacheFriendlySplitImpulseIterations(bodies, numBodies, manifolds, numManifolds, constraints,
														  numConstraints, info, debugDrawer);
			takeResult();
			return 0;
		}
		fallBack(constraints, numConstraints, info);
	}
	return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyIterations(
		bodies, numBodies, manifolds, numManifolds, constraints, numConstraints, info, debugDrawer);
}

btScalar btElasticPlasticConstraintSolver::solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int numBodies,
																		 const btContactSolverInfo& info)
{
	for (int j = 0; j < m_jointRows.size(); ++j)
		for (int r = 0; r < m_jointRows[j].m_joint->getNumRows(); ++r)
			m_jointRows[j].m_joint->setRowImpulse(
				r, m_tmpSolverNonContactConstraintPool[m_jointRows[j].m_firstRow + r].m_appliedImpulse);
	btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyFinish(bodies, numBodies, info);
	giveJointsTheirImpulses();
	return 0;
}
