/*
Bullet Elastic-Plastic: joints for Bullet Physics that bend before they break
Copyright (c) 2026 Bullet Elastic-Plastic contributors

This software is provided 'as-is', without any express or implied warranty.
In no event will the authors be held liable for any damages arising from the use of this software.
Permission is granted to anyone to use this software for any purpose,
including commercial applications, and to alter it and redistribute it freely,
subject to the following restrictions:

1. The origin of this software must not be misrepresented; you must not claim that you wrote the original software. If you use this software in a product, an acknowledgment in the product documentation would be appreciated but is not required.
2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the original software.
3. This notice may not be removed or altered from any source distribution.
*/

#include "btElasticPlasticConstraintSolver.h"

#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "LinearMath/btQuickprof.h"

// ---- islands

namespace
{
/// Bullet's number of the island of two objects, of which one may be static and is in none.
int islandOf(const btCollisionObject& a, const btCollisionObject& b)
{
	return a.isStaticOrKinematicObject() ? b.getIslandTag() : a.getIslandTag();
}
}  // namespace

/// Bullet hands over several small islands at a time. Those without elastic-plastic joints go their stock way.
btScalar btElasticPlasticConstraintSolver::solveGroup(btCollisionObject** bodies, int numBodies,
													  btPersistentManifold** manifolds, int numManifolds,
													  btTypedConstraint** constraints, int numConstraints,
													  const btContactSolverInfo& info, btIDebugDraw* debugDrawer,
													  btDispatcher* dispatcher)
{
	btAlignedObjectArray<int> islands;
	for (int i = 0; i < numConstraints; ++i)
	{
		const int island = islandOf(constraints[i]->getRigidBodyA(), constraints[i]->getRigidBodyB());
		if ((islands.size() == 0 || islands[islands.size() - 1] != island) &&
			btElasticPlasticJoint::from(constraints[i]))
			islands.push_back(island);
	}
	islands.quickSort([](int a, int b) { return a < b; });
	const auto isOurs = [&islands](int island) { return islands.findBinarySearch(island) < islands.size(); };
	bool mixed = false;
	for (int i = 0; i < numBodies && islands.size() > 0 && !mixed; ++i)
		mixed = !bodies[i]->isStaticOrKinematicObject() && !isOurs(bodies[i]->getIslandTag());
	if (!mixed)
		return btSequentialImpulseConstraintSolver::solveGroup(bodies, numBodies, manifolds, numManifolds, constraints,
															   numConstraints, info, debugDrawer, dispatcher);

	for (int ours = 0; ours < 2; ++ours)
	{
		m_bodies[ours].resize(0);
		m_manifolds[ours].resize(0);
		m_constraints[ours].resize(0);
	}
	for (int i = 0; i < numBodies; ++i)
		m_bodies[isOurs(bodies[i]->getIslandTag())].push_back(bodies[i]);
	for (int i = 0; i < numManifolds; ++i)
		m_manifolds[isOurs(islandOf(*manifolds[i]->getBody0(), *manifolds[i]->getBody1()))].push_back(manifolds[i]);
	for (int i = 0; i < numConstraints; ++i)
		m_constraints[isOurs(islandOf(constraints[i]->getRigidBodyA(), constraints[i]->getRigidBodyB()))].push_back(
			constraints[i]);
	for (int ours = 0; ours < 2; ++ours)
		btSequentialImpulseConstraintSolver::solveGroup(
			m_bodies[ours].size() ? &m_bodies[ours][0] : nullptr, m_bodies[ours].size(),
			m_manifolds[ours].size() ? &m_manifolds[ours][0] : nullptr, m_manifolds[ours].size(),
			m_constraints[ours].size() ? &m_constraints[ours][0] : nullptr, m_constraints[ours].size(), info,
			debugDrawer, dispatcher);
	return 0;
}

// ---- rows, both forms

void btElasticPlasticConstraintSolver::convertJoints(btTypedConstraint** constraints, int numConstraints,
													 const btContactSolverInfo& info)
{
	m_jointRows.resize(0);
	for (int i = 0; i < numConstraints; ++i)
		// A disabled one is not asked for rows.
		if (btElasticPlasticJoint* joint =
				constraints[i]->isEnabled() ? btElasticPlasticJoint::from(constraints[i]) : nullptr)
		{
			joint->requestImplicitRows();
			const JointRows rows = {joint, i, 0};
			m_jointRows.push_back(rows);
		}

	btSequentialImpulseConstraintSolver::convertJoints(constraints, numConstraints, info);

	int end = 0;
	for (int i = 0, j = 0; j < m_jointRows.size(); ++i)
	{
		end += m_tmpConstraintSizesPool[i].m_numConstraintRows;
		JointRows& rows = m_jointRows[j];
		if (rows.m_firstRow != i)
			continue;
		// The joint's own rows are the last of its constraint's.
		rows.m_rows = rows.m_joint->getNumRows();
		rows.m_firstRow = end - rows.m_rows;
		for (int r = 0; r < rows.m_rows; ++r)
			makeSoft(m_tmpSolverNonContactConstraintPool[rows.m_firstRow + r], *rows.m_joint, r, info);
		++j;
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
	const btElasticPlasticRow& soft = joint.implicitRow(r, a, info.m_erp);
	row.m_jacDiagABInv = 1 / (a + soft.m_compliance);
	row.m_rhs = (soft.m_velocity - velocity) * row.m_jacDiagABInv;
	row.m_cfm = soft.m_compliance * row.m_jacDiagABInv;
	// Bullet has put the breaking threshold there, if the user wants that too.
	btSetMax(row.m_lowerLimit, soft.m_lower);
	btSetMin(row.m_upperLimit, soft.m_upper);
}

// ---- the direct form

namespace
{
/// Mass matrix of a body, 6x6. What its factors forbid to move is given the mass of something else: nothing pushes it, see
/// addRow.
void massOf(const btRigidBody& body, double mass[36])
{
	for (int i = 0; i < 36; ++i)
		mass[i] = 0;
	for (int i = 0; i < 3; ++i)
	{
		const double factor = body.getLinearFactor()[i];
		mass[7 * i] = 1 / (double(body.getInvMass()) * (factor > 0 ? factor : 1));
	}
	// In the body's own axes the inertia is diagonal.
	const btMatrix3x3& basis = body.getCenterOfMassTransform().getBasis();
	for (int axis = 0; axis < 3; ++axis)
	{
		const double inverse = body.getInvInertiaDiagLocal()[axis], inertia = inverse > 0 ? 1 / inverse : 1e6 * mass[0];
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j)
				mass[6 * (3 + i) + 3 + j] += inertia * double(basis[i][axis]) * double(basis[j][axis]);
	}
	for (int i = 0; i < 3; ++i)
		if (body.getAngularFactor()[i] == 0)
			for (int j = 0; j < 3; ++j)
				if (j != i)
					mass[6 * (3 + i) + 3 + j] = mass[6 * (3 + j) + 3 + i] = 0;
}

void copy(double* to, const btVector3& from, const btVector3& factor)
{
	for (int i = 0; i < 3; ++i)
		to[i] = factor[i] != 0 ? double(from[i]) : 0;
}
}  // namespace

void btElasticPlasticConstraintSolver::addBodies()
{
	m_index.resizeNoInitialize(m_tmpSolverBodyPool.size());
	for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i)
	{
		const btRigidBody* body = m_tmpSolverBodyPool[i].m_originalBody;
		m_index[i] = -1;
		if (!body || body->getInvMass() == 0)
			continue;
		double mass[36];
		massOf(*body, mass);
		m_index[i] = m_system.addBody(mass);
	}
}

/// From Bullet's row: its fixed point is rhs = cfm impulse + J dv / (A + C), with 1 / (A + C) what it multiplies by.
btElasticPlasticSystem::Row& btElasticPlasticConstraintSolver::addRow(const btSolverConstraint& from)
{
	btElasticPlasticSystem::Row& row = m_system.addRow();
	const btRigidBody *a = m_tmpSolverBodyPool[from.m_solverBodyIdA].m_originalBody,
					  *b = m_tmpSolverBodyPool[from.m_solverBodyIdB].m_originalBody;
	const btVector3 one(1, 1, 1);
	copy(row.m_J, from.m_contactNormal1, a ? a->getLinearFactor() : one);
	copy(row.m_J + 3, from.m_relpos1CrossNormal, a ? a->getAngularFactor() : one);
	copy(row.m_J + 6, from.m_contactNormal2, b ? b->getLinearFactor() : one);
	copy(row.m_J + 9, from.m_relpos2CrossNormal, b ? b->getAngularFactor() : one);
	row.m_isAngular = from.m_contactNormal1.isZero() && from.m_contactNormal2.isZero();
	row.m_bodyA = m_index[from.m_solverBodyIdA];
	row.m_bodyB = m_index[from.m_solverBodyIdB];
	const double diagonal = from.m_jacDiagABInv > 0 ? 1 / double(from.m_jacDiagABInv) : 1;
	row.m_target = double(from.m_rhs) * diagonal;
	// Hard rows are given a compliance that shows in the twelfth digit.
	row.m_compliance = btMax(double(from.m_cfm), 1e-12) * diagonal;
	row.m_lower = from.m_lowerLimit;
	row.m_upper = from.m_upperLimit;
	return row;
}

void btElasticPlasticConstraintSolver::addContacts()
{
	// Soft by a hundredth of A: the augmented Lagrangian then gains two digits a loop, and the matrix stays well conditioned.
	const double softness = 1e-2;
	const int first = m_system.getNumRows();
	for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i)
	{
		const btSolverConstraint& contact = m_tmpSolverContactConstraintPool[i];
		btElasticPlasticSystem::Row& row = addRow(contact);
		row.m_isContact = true;
		row.m_compliance = btMax(row.m_compliance, softness / double(contact.m_jacDiagABInv));
		row.m_lower = 0;
		row.m_upper = 1e30;
		row.m_impulse = contact.m_appliedImpulse;
	}
	btConstraintArray* const pools[] = {&m_tmpSolverContactFrictionConstraintPool,
										&m_tmpSolverContactRollingFrictionConstraintPool};
	for (int p = 0; p < 2; ++p)
		for (int i = 0; i < pools[p]->size(); ++i)
		{
			const btSolverConstraint& friction = (*pools[p])[i];
			btElasticPlasticSystem::Row& row = addRow(friction);
			row.m_isContact = true;
			row.m_compliance = btMax(row.m_compliance, softness / double(friction.m_jacDiagABInv));
			row.m_impulse = friction.m_appliedImpulse;
			row.m_friction = friction.m_friction;
			row.m_normal = first + friction.m_frictionIndex;
			// Bullet bounds rolling friction by its coefficient too.
			row.m_frictionMax = p == 1 ? double(friction.m_friction) : 0;
		}
}

bool btElasticPlasticConstraintSolver::solveDirectly()
{
	m_system.clear();
	addBodies();
	for (int i = 0; i < m_tmpSolverNonContactConstraintPool.size(); ++i)
		addRow(m_tmpSolverNonContactConstraintPool[i]);
	for (int j = 0; j < m_jointRows.size(); ++j)
		for (int r = 0; r < m_jointRows[j].m_rows; ++r)
			m_system.getRow(m_jointRows[j].m_firstRow + r).m_bound = m_jointRows[j].m_joint->getRowBound(r);
	addContacts();
	return m_system.solve();
}

void btElasticPlasticConstraintSolver::takeResult()
{
	for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i)
	{
		btSolverBody& body = m_tmpSolverBodyPool[i];
		if (m_index[i] < 0)
			continue;
		const double* v = m_system.getVelocityChange(m_index[i]);
		body.internalGetDeltaLinearVelocity().setValue(btScalar(v[0]), btScalar(v[1]), btScalar(v[2]));
		body.internalGetDeltaAngularVelocity().setValue(btScalar(v[3]), btScalar(v[4]), btScalar(v[5]));
		const btVector3 &linear = body.m_originalBody->getLinearFactor(),
						&angular = body.m_originalBody->getAngularFactor();
		for (int k = 0; k < 3; ++k)
		{
			if (linear[k] == 0)
				body.internalGetDeltaLinearVelocity()[k] = 0;
			if (angular[k] == 0)
				body.internalGetDeltaAngularVelocity()[k] = 0;
		}
	}
	btConstraintArray* const pools[] = {&m_tmpSolverNonContactConstraintPool, &m_tmpSolverContactConstraintPool,
										&m_tmpSolverContactFrictionConstraintPool,
										&m_tmpSolverContactRollingFrictionConstraintPool};
	int row = 0;
	for (btConstraintArray* pool : pools)
		for (int i = 0; i < pool->size(); ++i)
			(*pool)[i].m_appliedImpulse = btScalar(m_system.getRow(row++).m_impulse);
	for (int j = 0; j < m_jointRows.size(); ++j)
		for (int r = 0; r < m_jointRows[j].m_rows; ++r)
			m_jointRows[j].m_joint->setRowBound(r, m_system.getRow(m_jointRows[j].m_firstRow + r).m_bound);
}

btScalar btElasticPlasticConstraintSolver::solveGroupCacheFriendlyIterations(
	btCollisionObject** bodies, int numBodies, btPersistentManifold** manifolds, int numManifolds,
	btTypedConstraint** constraints, int numConstraints, const btContactSolverInfo& info, btIDebugDraw* debugDrawer)
{
	if (m_jointRows.size() > 0 && m_form == BT_EP_DIRECT)
	{
		BT_PROFILE("elastic-plastic direct");
		if (solveDirectly())
		{
			solveGroupCacheFriendlySplitImpulseIterations(bodies, numBodies, manifolds, numManifolds, constraints,
														  numConstraints, info, debugDrawer);
			takeResult();
			return 0;
		}
	}
	return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyIterations(
		bodies, numBodies, manifolds, numManifolds, constraints, numConstraints, info, debugDrawer);
}

btScalar btElasticPlasticConstraintSolver::solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int numBodies,
																		 const btContactSolverInfo& info)
{
	for (int j = 0; j < m_jointRows.size(); ++j)
		for (int r = 0; r < m_jointRows[j].m_rows; ++r)
			m_jointRows[j].m_joint->setRowImpulse(
				r, m_tmpSolverNonContactConstraintPool[m_jointRows[j].m_firstRow + r].m_appliedImpulse);
	return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyFinish(bodies, numBodies, info);
}
