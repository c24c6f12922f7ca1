// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "IslandSolver.h"

#include "../joint/BodyGate.h"
#include "../linear/ScopedTimer.h"
#include "FrozenBodies.h"
#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
bool isVectorFinite(const btVector3& v)
{
	return btElasticPlasticIsFinite(double(v.x()) + double(v.y()) + double(v.z()));
}

/// Whether the velocities are finite that Bullet is about to write to bodies. Those are left out that were not finite before: the
/// gate has kept them out of the solution.
bool isResultFinite(const btAlignedObjectArray<btSolverBody>& bodies)
{
	for (int i = 0; i < bodies.size(); ++i)
	{
		const btSolverBody& b = bodies[i];
		const bool isFinite =
			isVectorFinite(b.m_linearVelocity + b.m_deltaLinearVelocity + b.m_externalForceImpulse) &&
			isVectorFinite(b.m_angularVelocity + b.m_deltaAngularVelocity + b.m_externalTorqueImpulse) &&
			isVectorFinite(b.m_pushVelocity) && isVectorFinite(b.m_turnVelocity);
		if (!isFinite && b.m_originalBody && isWellFormed(*b.m_originalBody))
			return false;
	}
	return true;
}

void setZero(btConstraintArray& rows)
{
	for (int i = 0; i < rows.size(); ++i)
		rows[i].m_appliedImpulse = rows[i].m_appliedPushImpulse = 0;
}

/// Bullet's friction knows what forces from outside do to velocities in the step, but not what torques do to spins. It would hold what was,
/// a step late, and push a structure along that a torque turns to and fro.
void takeTorques(btConstraintArray& friction, const btAlignedObjectArray<btSolverBody>& bodies)
{
	for (int i = 0; i < friction.size(); ++i)
	{
		btSolverConstraint& row = friction[i];
		const btVector3 &spinA = bodies[row.m_solverBodyIdA].m_externalTorqueImpulse,
						&spinB = bodies[row.m_solverBodyIdB].m_externalTorqueImpulse;
		row.m_rhs -= row.m_jacDiagABInv * (row.m_relpos1CrossNormal.dot(spinA) + row.m_relpos2CrossNormal.dot(spinB));
	}
}

/// Applies gravity to bodies that Bullet has woken in this step. Bullet applies gravity first and then wakes the rest of an
/// island, so the woken bodies would have no weight for a step, and a structure that carries its own weight would spring up.
/// Woken bodies are those that want to sleep but have no time at rest: others with that state have been at rest for a while.
void giveWokenTheirWeight(btCollisionObject** bodies, int numBodies)
{
	for (int i = 0; i < numBodies; ++i)
	{
		btRigidBody* const body = btRigidBody::upcast(bodies[i]);
		if (body && body->getActivationState() == WANTS_DEACTIVATION && body->getDeactivationTime() == 0)
			body->applyGravity();
	}
}
}  // namespace

SolverPools IslandSolver::pools()
{
	return {m_tmpSolverBodyPool, m_tmpSolverNonContactConstraintPool, m_tmpSolverContactConstraintPool,
			m_tmpSolverContactFrictionConstraintPool, m_tmpSolverContactRollingFrictionConstraintPool};
}

void IslandSolver::setSettings(const btElasticPlasticSolverSettings& settings)
{
	m_settings = settings;
	m_direct.getSystem().setSettings(settings);
}

void IslandSolver::solve(const SolverGroup& island, const btContactSolverInfo& info, btIDebugDraw* debugDrawer,
						 btDispatcher* dispatcher, bool isInPool)
{
	m_island = island;
	m_debugDrawer = debugDrawer;
	m_dispatcher = dispatcher;
	m_sweepsContacts = sweepsContacts(island);
	giveWokenTheirWeight(island.m_bodies, island.m_numBodies);
	const FrozenBodies frozen(island.m_bodies, island.m_numBodies);
	if (m_settings.m_form == BT_EP_DIRECT)
	{
		btElasticPlasticSolverSettings settings = m_settings;
		if (isInPool)
			settings.m_maxInnerSteps = 0;
		m_inner.solve(island, info, settings, m_statistics, *this);
	}
	else
		solveStep(info, {1, false}, 0);
}

void IslandSolver::solveStep(const btContactSolverInfo& info, StepKind kind, long long maxWork)
{
	m_kind = kind;
	m_direct.getSystem().setMaxWork(maxWork);
	solveGroup(m_island.m_bodies, m_island.m_numBodies, m_island.m_manifolds, m_island.m_numManifolds,
			   m_island.m_constraints, m_island.m_numConstraints, info, m_debugDrawer, m_dispatcher);
}

bool IslandSolver::sweepsContacts(const SolverGroup& island) const
{
	if (m_settings.m_contacts != BT_EP_CONTACTS_BY_ISLAND)
		return m_settings.m_contacts == BT_EP_SWEPT_CONTACTS;
	int points = 0;
	for (int i = 0; i < island.m_numManifolds; ++i)
		points += island.m_manifolds[i]->getNumContacts();
	return points > m_settings.m_maxExactContacts;
}

// ---- set-up

void IslandSolver::convertJoints(btTypedConstraint** constraints, int numConstraints, const btContactSolverInfo& info)
{
	m_direct.begin(m_sweepsContacts, double(m_kind.m_share));
	m_iterative.begin();
	if (m_settings.m_form == BT_EP_DIRECT)
		convertForDirect(constraints, numConstraints, info);
	else
		convertForIterative(constraints, numConstraints, info);
}

void IslandSolver::convertForDirect(btTypedConstraint** constraints, int numConstraints,
									const btContactSolverInfo& info)
{
	m_others.resize(0);
	m_otherJoints.resize(0);
	m_direct.reserve(numConstraints);
	{
		const ScopedTimer timer("elastic-plastic set-up", m_statistics.m_setUpTime, m_settings.m_measuresTime);
		for (int i = 0; i < numConstraints; ++i)
		{
			if (i + PREFETCH_AHEAD < numConstraints && m_island.m_joints[i + PREFETCH_AHEAD])
				JointWorks::prefetch(constraints[i + PREFETCH_AHEAD]);
			m_island.prefetchJointAfter(i);
			if (i + 1 < numConstraints && m_island.m_joints[i + 1])
				m_island.m_joints[i + 1]->prefetchParts();
			JointWorks* const joint = constraints[i]->isEnabled() ? m_island.m_joints[i] : nullptr;
			if (joint && joint->beginAlone())
				addToDirect(*joint, info);
			else
			{
				m_others.push_back(constraints[i]);
				m_otherJoints.push_back(joint);
			}
		}
	}
	btSequentialImpulseConstraintSolver::convertJoints(m_others.size() > 0 ? &m_others[0] : nullptr, m_others.size(),
													   info);
	for (int i = 0; i < m_others.size(); ++i)
		if (m_otherJoints[i])
			addToDirect(*m_otherJoints[i], info);
}

void IslandSolver::addToDirect(JointWorks& joint, const btContactSolverInfo& info)
{
	if (!joint.m_step.begin(info.m_timeStep, info.m_erp, m_kind, m_rows))
		return;
	const int solverBodies[2] = {getOrInitSolverBody(joint.m_model.bodyA(), info.m_timeStep),
								 getOrInitSolverBody(joint.m_model.bodyB(), info.m_timeStep)};
	m_direct.addJoint(joint, m_rows, solverBodies, pools());
}

void IslandSolver::convertForIterative(btTypedConstraint** constraints, int numConstraints,
									   const btContactSolverInfo& info)
{
	for (int i = 0; i < numConstraints; ++i)
		// Bullet does not ask a disabled joint for rows.
		if (m_island.m_joints[i] && constraints[i]->isEnabled())
			m_island.m_joints[i]->requestJacobians();
	btSequentialImpulseConstraintSolver::convertJoints(constraints, numConstraints, info);

	int end = 0;
	for (int i = 0; i < numConstraints; ++i)
	{
		end += m_tmpConstraintSizesPool[i].m_numConstraintRows;
		// The joint's own rows are the last of its constraint's.
		if (m_island.m_joints[i] && constraints[i]->isEnabled())
			m_iterative.addJoint(*m_island.m_joints[i], end - m_island.m_joints[i]->m_step.getNumRows(), pools(),
								 info.m_erp);
	}
}

// ---- solution

btScalar IslandSolver::solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int numBodies,
														 btPersistentManifold** manifolds, int numManifolds,
														 btTypedConstraint** constraints, int numConstraints,
														 const btContactSolverInfo& info, btIDebugDraw* debugDrawer)
{
	takeTorques(m_tmpSolverContactFrictionConstraintPool, m_tmpSolverBodyPool);
	takeTorques(m_tmpSolverContactRollingFrictionConstraintPool, m_tmpSolverBodyPool);
	if (m_direct.hasJoints())
	{
		m_direct.solve(pools(), info,
					   {getActiveConstraintRowSolverGeneric(), getActiveConstraintRowSolverLowerLimit()});
		solveGroupCacheFriendlySplitImpulseIterations(bodies, numBodies, manifolds, numManifolds, constraints,
													  numConstraints, info, debugDrawer);
		m_direct.writeResult(pools(), info);
		return 0;
	}
	return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyIterations(
		bodies, numBodies, manifolds, numManifolds, constraints, numConstraints, info, debugDrawer);
}

btScalar IslandSolver::solveSingleIteration(int iteration, btCollisionObject** bodies, int numBodies,
											btPersistentManifold** manifolds, int numManifolds,
											btTypedConstraint** constraints, int numConstraints,
											const btContactSolverInfo& info, btIDebugDraw* debugDrawer)
{
	const btScalar ofFibres = m_iterative.solveFibres(iteration, pools());
	const btScalar ofRows = btSequentialImpulseConstraintSolver::solveSingleIteration(
		iteration, bodies, numBodies, manifolds, numManifolds, constraints, numConstraints, info, debugDrawer);
	return btMax(ofFibres, ofRows);
}

/// Leaves bodies their velocities, forces from outside included, and joints their state.
void IslandSolver::withholdResult()
{
	++m_statistics.m_notFinite;
	m_direct.cancel();
	m_iterative.cancel();
	for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i)
	{
		btSolverBody& body = m_tmpSolverBodyPool[i];
		for (btVector3* change :
			 {&body.m_deltaLinearVelocity, &body.m_deltaAngularVelocity, &body.m_externalForceImpulse,
			  &body.m_externalTorqueImpulse, &body.m_pushVelocity, &body.m_turnVelocity})
			change->setZero();
	}
	setZero(m_tmpSolverNonContactConstraintPool);
	setZero(m_tmpSolverContactConstraintPool);
	setZero(m_tmpSolverContactFrictionConstraintPool);
	setZero(m_tmpSolverContactRollingFrictionConstraintPool);
}

namespace
{
/// Whether no load acts on any body, and nothing touches or is joined to what moves by itself.
bool areFree(const btAlignedObjectArray<btSolverBody>& bodies)
{
	for (int i = 0; i < bodies.size(); ++i)
	{
		const btRigidBody* const body = bodies[i].m_originalBody;
		if (!body || isHeld(*body) || !body->getTotalForce().isZero() || !body->getTotalTorque().isZero())
			return false;
	}
	return true;
}
}  // namespace

btScalar IslandSolver::solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int numBodies,
													 const btContactSolverInfo& info)
{
	if (!isResultFinite(m_tmpSolverBodyPool))
		withholdResult();
	m_iterative.finish(pools());
	const bool isFree = areFree(m_tmpSolverBodyPool);
	btContactSolverInfo finishing = info;
	// Bullet tells contact points their impulses only in this mode, and by these a blow is seen. Whether a step begins with them has been decided.
	finishing.m_solverMode |= SOLVER_USE_WARMSTARTING;
	// Bullet moves places beside velocities only in this mode.
	if (m_direct.movesPlaces())
	{
		finishing.m_splitImpulse = 1;
		if (!(finishing.m_splitImpulseTurnErp > 0))
			finishing.m_splitImpulseTurnErp = 1;
	}
	btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyFinish(bodies, numBodies, finishing);
	m_direct.finish(isFree);
	return 0;
}
}  // namespace btElasticPlastic
