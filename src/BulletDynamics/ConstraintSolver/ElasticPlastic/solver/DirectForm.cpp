// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The direct form of btElasticPlasticConstraintSolver: from Bullet's bodies, rows and contacts to btElasticPlastic::System and
// back. Bullet sees no rows of elastic-plastic joints here, which saves most of what it spends on setting them up.

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"

#include "BulletCollision/NarrowPhaseCollision/btManifoldPoint.h"
#include "../linear/ScopedTimer.h"

namespace
{
/// Compliance of hard rows, of A: it shows in the twelfth digit.
const double HARD = 1e-12;

/// Bullet multiplies a change of velocity by the body's factors twice, in the row and when it applies the impulse. What they
/// forbid to move is given the mass of something else: nothing pushes it, see addRow.
void setMass(const btRigidBody& body, btElasticPlastic::System::Body& to)
{
	for (int i = 0; i < 3; ++i)
	{
		const double factor = body.getLinearFactor()[i];
		to.m_mass[i] = 1 / (double(body.getInvMass()) * (factor > 0 ? factor * factor : 1));
	}
	// In the body's own axes the inertia is diagonal.
	const btMatrix3x3& basis = body.getCenterOfMassTransform().getBasis();
	for (double& element : to.m_inertia)
		element = 0;
	for (int axis = 0; axis < 3; ++axis)
	{
		const double inverse = body.getInvInertiaDiagLocal()[axis],
					 inertia = inverse > 0 ? 1 / inverse : 1e6 * to.m_mass[0];
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j)
				to.m_inertia[3 * i + j] += inertia * double(basis[i][axis]) * double(basis[j][axis]);
	}
	const btVector3& factor = body.getAngularFactor();
	for (int i = 0; i < 3; ++i)
		for (int j = 0; j < 3; ++j)
		{
			const double product = double(factor[i]) * double(factor[j]);
			if (product > 0)
				to.m_inertia[3 * i + j] /= product;
			else if (i != j)
				to.m_inertia[3 * i + j] = 0;
		}
}

void copy(double* to, const btVector3& from, const btVector3& factor)
{
	for (int i = 0; i < 3; ++i)
		to[i] = factor[i] != 0 ? double(from[i]) : 0;
}
bool isFree(const btSolverBody& body)
{
	const btVector3 one(1, 1, 1);
	return body.m_linearFactor == one && body.m_angularFactor == one;
}
}  // namespace

/// Those that Bullet has taken in since the last call, which may be static ones only.
void btElasticPlasticConstraintSolver::addBodies()
{
	for (int i = m_index.size(); i < m_tmpSolverBodyPool.size(); ++i)
	{
		const btRigidBody* body = m_tmpSolverBodyPool[i].m_originalBody;
		const bool moves = body && body->getInvMass() > 0;
		m_index.push_back(moves ? m_system.getNumBodies() : -1);
		if (moves)
			setMass(*body, m_system.addBody());
	}
}

/// From Bullet's row: its fixed point is rhs = cfm impulse + J dv / (A + C), with 1 / (A + C) what it multiplies by.
btElasticPlastic::System::Row& btElasticPlasticConstraintSolver::addRow(const btSolverConstraint& from)
{
	btElasticPlastic::System::Row& row = m_system.addRow();
	const btSolverBody &A = m_tmpSolverBodyPool[from.m_solverBodyIdA], &B = m_tmpSolverBodyPool[from.m_solverBodyIdB];
	copy(row.m_J, from.m_contactNormal1, A.m_linearFactor);
	copy(row.m_J + 3, from.m_relpos1CrossNormal, A.m_angularFactor);
	copy(row.m_J + 6, from.m_contactNormal2, B.m_linearFactor);
	copy(row.m_J + 9, from.m_relpos2CrossNormal, B.m_angularFactor);
	row.m_body[0] = m_index[from.m_solverBodyIdA];
	row.m_body[1] = m_index[from.m_solverBodyIdB];
	btElasticPlastic::System::Law& law = m_system.getLaw(row.m_law);
	const double diagonal = from.m_jacDiagABInv > 0 ? 1 / double(from.m_jacDiagABInv) : 1;
	law.m_target = double(from.m_rhs) * diagonal;
	law.m_compliance = btMax(double(from.m_cfm), HARD) * diagonal;
	law.m_lower = from.m_lowerLimit;
	law.m_upper = from.m_upperLimit;
	return row;
}

void btElasticPlasticConstraintSolver::addJoint(btElasticPlasticJoint& joint, const btContactSolverInfo& info)
{
	if (joint.getNumRows() == 0 || !joint.startStep(info.m_timeStep))
		return;
	const DirectJoint direct = {&joint, m_system.getNumLaws()};
	m_directJoints.push_back(direct);
	const int ids[2] = {getOrInitSolverBody(joint.getConstraint().getRigidBodyA(), info.m_timeStep),
						getOrInitSolverBody(joint.getConstraint().getRigidBodyB(), info.m_timeStep)};
	addBodies();
	const btElasticPlastic::Kinematics& k = joint.getKinematics();
	btScalar diagonals[BT_EP_DOF_COUNT];
	joint.getDiagonals(diagonals);
	const btSolverBody &A = m_tmpSolverBodyPool[ids[0]], &B = m_tmpSolverBodyPool[ids[1]];
	const btVector3 wA = A.m_angularVelocity + A.m_externalTorqueImpulse,
					wB = B.m_angularVelocity + B.m_externalTorqueImpulse;
	const btVector3 velocity[2] = {A.m_linearVelocity + A.m_externalForceImpulse + wA.cross(k.m_rA) -
									   B.m_linearVelocity - B.m_externalForceImpulse - wB.cross(k.m_rB),
								   wA - wB};
	const double most = joint.getConstraint().getBreakingImpulseThreshold();
	const auto set = [&](btElasticPlastic::System::Law& law, int r)
	{
		const int dof = joint.getRowDof(r);
		const btElasticPlastic::SoftRow row = joint.implicitRow(r, diagonals[r], info.m_erp);
		law.m_target = double(row.m_velocity) - double(velocity[dof / 3].dot(k.m_axis[dof % 3]));
		law.m_compliance = btMax(double(row.m_compliance), HARD * double(diagonals[r]));
		law.m_lower = btMax(double(row.m_lower), -most);
		law.m_upper = btMin(double(row.m_upper), most);
		law.m_bound = static_cast<signed char>(joint.getRowBound(r));
	};
	const bool isUnit = isFree(A) && isFree(B);
	isUnit ? addUnit(joint, ids) : addSingleRows(joint, ids);
	for (int r = 0; r < joint.getNumRows(); ++r)
		set(m_system.getLaw(direct.m_firstLaw + r), r);
}

void btElasticPlasticConstraintSolver::addUnit(const btElasticPlasticJoint& joint, const int solverBodies[2])
{
	const btElasticPlastic::Kinematics& k = joint.getKinematics();
	btElasticPlastic::System::Joint& unit = m_system.addJoint(joint.getNumRows());
	for (int i = 0; i < 3; ++i)
	{
		for (int axis = 0; axis < 3; ++axis)
			unit.m_axis[axis][i] = k.m_axis[axis][i];
		unit.m_arm[0][i] = k.m_rA[i];
		unit.m_arm[1][i] = k.m_rB[i];
	}
	for (int side = 0; side < 2; ++side)
		unit.m_body[side] = m_index[solverBodies[side]];
	for (int r = 0; r < joint.getNumRows(); ++r)
		unit.m_dof[r] = static_cast<signed char>(joint.getRowDof(r));
}

/// Bodies that may not move in every direction: their rows have less than a joint's Jacobian.
void btElasticPlasticConstraintSolver::addSingleRows(const btElasticPlasticJoint& joint, const int solverBodies[2])
{
	const btElasticPlastic::Kinematics& k = joint.getKinematics();
	const btVector3 none(0, 0, 0), arms[2] = {k.m_rA, k.m_rB};
	for (int r = 0; r < joint.getNumRows(); ++r)
	{
		btElasticPlastic::System::Row& row = m_system.addRow();
		const int dof = joint.getRowDof(r);
		for (int side = 0; side < 2; ++side)
		{
			const btVector3 axis = side == 0 ? k.m_axis[dof % 3] : -k.m_axis[dof % 3];
			const btSolverBody& body = m_tmpSolverBodyPool[solverBodies[side]];
			copy(row.m_J + 6 * side, dof < 3 ? axis : none, body.m_linearFactor);
			copy(row.m_J + 6 * side + 3, dof < 3 ? arms[side].cross(axis) : axis, body.m_angularFactor);
			row.m_body[side] = m_index[solverBodies[side]];
		}
	}
}

void btElasticPlasticConstraintSolver::convertToUnits(btTypedConstraint** constraints, int numConstraints,
													  const btContactSolverInfo& info)
{
	m_system.clear();
	m_index.resize(0);
	addBodies();
	m_others.resize(0);
	m_otherJoints.resize(0);
	{
		const btElasticPlastic::ScopedTimer lap("elastic-plastic set-up", m_system.getStatistics().m_setUpTime);
		const bool isLarge = numConstraints > 400;
		for (int i = 0; i < numConstraints; ++i)
		{
			if (isLarge && i + 4 < numConstraints && m_islandJoints[i + 4])
				m_islandJoints[i + 4]->prefetch();
			btElasticPlasticJoint* const joint = constraints[i]->isEnabled() ? m_islandJoints[i] : nullptr;
			if (joint && joint->prepareAlone())
				addJoint(*joint, info);
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
			addJoint(*m_otherJoints[i], info);
}

/// A row that the augmented Lagrangian makes soft by a hundredth of A, unless it is softer already: it then gains two digits a
/// loop, and the matrix stays well conditioned.
btElasticPlastic::System::Row& btElasticPlasticConstraintSolver::addContactRow(const btSolverConstraint& from)
{
	btElasticPlastic::System::Row& row = addRow(from);
	btElasticPlastic::System::Law& law = m_system.getLaw(row.m_law);
	row.m_isContact = true;
	row.m_softening = btMax(0., 1e-2 / double(from.m_jacDiagABInv) - law.m_compliance);
	law.m_compliance += row.m_softening;
	return row;
}

/// The search begins with the bounds that the contacts' points remember of the last step. Multipliers begin as Bullet's warm
/// start does, a little below: what the loops leave then takes energy instead of making it.
void btElasticPlasticConstraintSolver::addContacts(bool hasTwoDirections)
{
	const int first = m_system.getNumRows();
	m_lastFriction.resizeNoInitialize(0);
	m_lastFriction.resize(m_tmpSolverContactFrictionConstraintPool.size(), 0);
	for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i)
	{
		const btSolverConstraint& contact = m_tmpSolverContactConstraintPool[i];
		btElasticPlastic::System::Law& law = m_system.getLaw(addContactRow(contact).m_law);
		law.m_lower = 0;
		law.m_upper = 1e30;
		law.m_bound = -1;
		const btManifoldPoint* const point = static_cast<const btManifoldPoint*>(contact.m_originalContactPoint);
		if (!point)
			continue;
		law.m_impulse = contact.m_appliedImpulse;
		law.m_bound = static_cast<signed char>(law.m_impulse > 0 ? 0 : -1);
		m_lastFriction[contact.m_frictionIndex] = point->m_appliedImpulseLateral1;
		if (hasTwoDirections)
			m_lastFriction[contact.m_frictionIndex + 1] = point->m_appliedImpulseLateral2;
	}
	btConstraintArray* const pools[] = {&m_tmpSolverContactFrictionConstraintPool,
										&m_tmpSolverContactRollingFrictionConstraintPool};
	for (int p = 0; p < 2; ++p)
		for (int i = 0; i < pools[p]->size(); ++i)
		{
			const btSolverConstraint& friction = (*pools[p])[i];
			btElasticPlastic::System::Row& row = addContactRow(friction);
			btElasticPlastic::System::Law& law = m_system.getLaw(row.m_law);
			row.m_friction = friction.m_friction;
			row.m_normal = first + friction.m_frictionIndex;
			// Bullet bounds rolling friction by its coefficient too.
			row.m_frictionMax = p == 1 ? double(friction.m_friction) : 0;
			if (p == 1)
				continue;
			const double most = row.m_friction * m_system.getLaw(m_system.getRow(row.m_normal).m_law).m_impulse;
			const double slides = 0.999 * most;
			law.m_bound = static_cast<signed char>(m_lastFriction[i] >= slides    ? 1
												   : m_lastFriction[i] <= -slides ? -1
																				  : 0);
		}
}

bool btElasticPlasticConstraintSolver::solveDirectly(const btContactSolverInfo& info)
{
	addBodies();
	m_firstRow = m_system.getNumRows();
	for (int i = 0; i < m_tmpSolverNonContactConstraintPool.size(); ++i)
		addRow(m_tmpSolverNonContactConstraintPool[i]);
	addContacts((info.m_solverMode & SOLVER_USE_2_FRICTION_DIRECTIONS) != 0);
	// The island is known again by the first of its joints.
	btElasticPlasticJoint& first = *m_directJoints[0].m_joint;
	int ticket = first.getTicket();
	const bool solved = m_system.solve(ticket);
	first.setTicket(ticket);
	return solved;
}

void btElasticPlasticConstraintSolver::fallBack(btTypedConstraint** constraints, int numConstraints,
												const btContactSolverInfo& info)
{
	++m_system.getStatistics().m_fallbacks;
	for (int j = 0; j < m_directJoints.size(); ++j)
		m_directJoints[j].m_joint->revert();
	m_directJoints.resize(0);
	convertToRows(constraints, numConstraints, info);
	m_orderNonContactConstraintPool.resizeNoInitialize(m_tmpSolverNonContactConstraintPool.size());
	for (int i = 0; i < m_orderNonContactConstraintPool.size(); ++i)
		m_orderNonContactConstraintPool[i] = i;
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
	int row = m_firstRow;
	for (btConstraintArray* pool : pools)
		for (int i = 0; i < pool->size(); ++i)
			(*pool)[i].m_appliedImpulse = btScalar(m_system.getLaw(m_system.getRow(row++).m_law).m_impulse);
}

void btElasticPlasticConstraintSolver::giveJointsTheirImpulses()
{
	for (int j = 0; j < m_directJoints.size(); ++j)
	{
		btElasticPlasticJoint& joint = *m_directJoints[j].m_joint;
		for (int r = 0; r < joint.getNumRows(); ++r)
		{
			const btElasticPlastic::System::Law& law = m_system.getLaw(m_directJoints[j].m_firstLaw + r);
			joint.setRowImpulse(r, btScalar(law.m_impulse));
			joint.setRowBound(r, law.m_bound);
		}
		joint.reportImpulses();
	}
}
