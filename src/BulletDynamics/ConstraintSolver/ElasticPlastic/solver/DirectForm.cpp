// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "DirectForm.h"

#include "BulletCollision/NarrowPhaseCollision/btManifoldPoint.h"
#include "BulletDynamics/ConstraintSolver/btContactSolverInfo.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "../joint/BodyGate.h"

namespace btElasticPlastic
{
namespace
{
/// Compliance of hard rows as a share of A: it changes the twelfth digit of the result.
const double HARD = 1e-12;
/// Softening of contacts as a share of A: the augmented Lagrangian then gains two digits a loop, and the matrix stays well
/// conditioned.
const double SOFTENING = 1e-2;
/// The upper bound of a contact's normal impulse: none.
const double UNBOUNDED = 1e30;
/// A contact slides, as a first guess, if its friction had this share of its bound in the last step.
const double SLIDING = 0.999;
/// Inertia over mass [m^2] of a body about an axis about which it has no inertia in Bullet: so much that nothing turns it.
const double INERTIA_OF_NONE = 1e6;

/// Bullet multiplies a change of velocity by the body's factors twice, in the row and when it applies the impulse; the mass
/// here is divided by their square. A direction that a factor of zero locks keeps its mass, as rows have no part in that
/// direction, see copy().
void setMass(const btRigidBody& body, SystemInput::Body& to)
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
					 inertia = inverse > 0 ? 1 / inverse : INERTIA_OF_NONE * to.m_mass[0];
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

/// Bounds of rows that are at none.
const signed char BETWEEN[BT_EP_DOF_COUNT] = {};

/// Copies a Jacobian without the directions that the body's factor locks.
void copy(double* to, const btVector3& from, const btVector3& factor)
{
	for (int i = 0; i < 3; ++i)
		to[i] = factor[i] != 0 ? double(from[i]) : 0;
}

/// Whether all numbers of a row are finite. They are not if one of its bodies is not finite.
bool isFiniteRow(const SystemInput::SingleRow& row, const SystemInput::Bounded& terms)
{
	double sum = terms.m_target + terms.m_compliance;
	for (const double element : row.m_J)
		sum += element;
	return btElasticPlasticIsFinite(sum);
}

/// Makes a row one that has no effect.
void makeIdle(SystemInput::SingleRow& row, SystemInput::Bounded& terms)
{
	for (double& element : row.m_J)
		element = 0;
	terms.m_target = 0;
	terms.m_compliance = 1;
}

bool isFree(const btSolverBody& body)
{
	const btVector3 one(1, 1, 1);
	return body.m_linearFactor == one && body.m_angularFactor == one;
}
}  // namespace

void DirectForm::begin()
{
	m_input.clear();
	m_joints.resize(0);
	m_index.resize(0);
	m_recovery.begin();
}

/// Adds the solver bodies that Bullet has made since the last call. There may be static ones only among them.
void DirectForm::addBodies(const SolverPools& pools)
{
	for (int i = m_index.size(); i < pools.m_bodies.size(); ++i)
	{
		const btRigidBody* body = pools.m_bodies[i].m_originalBody;
		// A kinematic body moves as it is told, even if it still has a mass.
		const bool moves = body && body->getInvMass() > 0 && !body->isKinematicObject() && isFinite(*body);
		m_index.push_back(moves ? m_input.getNumBodies() : -1);
		if (moves)
			setMass(*body, m_input.addBody());
	}
}

// ---- joints

void DirectForm::addJoint(JointWorks& joint, const JointRows& rows, const int solverBodies[2], const SolverPools& pools)
{
	addBodies(pools);
	const Kinematics& k = rows.m_kinematics;
	const btSolverBody &A = pools.m_bodies[solverBodies[0]], &B = pools.m_bodies[solverBodies[1]];
	const btVector3 wA = A.m_angularVelocity + A.m_externalTorqueImpulse,
					wB = B.m_angularVelocity + B.m_externalTorqueImpulse;
	const btVector3 velocity[2] = {A.m_linearVelocity + A.m_externalForceImpulse + wA.cross(k.m_rA) -
									   B.m_linearVelocity - B.m_externalForceImpulse - wB.cross(k.m_rB),
								   wA - wB};
	const double most = joint.m_model.m_constraint.getBreakingImpulseThreshold();
	Joint entry = {&joint, m_input.getNumRows(), {m_index[solverBodies[0]], m_index[solverBodies[1]]}, -1, false};
	const bool isUnit = isFree(A) && isFree(B);
	if (isUnit)
		addUnit(rows, solverBodies);
	else
		addUnitAsSingleRows(rows, solverBodies, pools);
	for (int r = 0; r < rows.m_numRows; ++r)
	{
		const JointRows::Row& from = rows.m_row[r];
		SystemInput::Bounded& row = m_input.m_rows[entry.m_firstRow + r];
		const double lower = from.m_soft.m_lower, upper = from.m_soft.m_upper;
		row.m_target = double(from.m_soft.m_velocity) - double(velocity[from.m_dof / 3].dot(k.m_axis[from.m_dof % 3]));
		row.m_compliance = btMax(double(from.m_soft.m_compliance), HARD * double(from.m_diagonal));
		row.m_lower = btMax(lower, -most);
		row.m_upper = btMin(upper, most);
		row.m_partner = from.m_partner >= 0 ? entry.m_firstRow + from.m_partner : -1;
		row.m_coupling = from.m_coupling;
		m_input.m_guess[entry.m_firstRow + r].m_bound = from.m_bound;
		entry.m_isCut |= row.m_lower > lower || row.m_upper < upper;
	}
	if (isUnit && rows.m_damping.m_factor > 0)
	{
		entry.m_firstDamping = m_input.getNumSingleRows();
		addDamping(rows.m_damping, velocity[1], entry.m_bodies);
	}
	m_joints.push_back(entry);
}

void DirectForm::addUnit(const JointRows& rows, const int solverBodies[2])
{
	const Kinematics& k = rows.m_kinematics;
	SystemInput::Unit& unit = m_input.addUnit(rows.m_numRows);
	for (int i = 0; i < 3; ++i)
	{
		for (int axis = 0; axis < 3; ++axis)
			unit.m_axis[axis][i] = k.m_axis[axis][i];
		unit.m_arm[0][i] = k.m_rA[i];
		unit.m_arm[1][i] = k.m_rB[i];
	}
	for (int side = 0; side < 2; ++side)
		unit.m_body[side] = m_index[solverBodies[side]];
	for (int r = 0; r < rows.m_numRows && r < BT_EP_DOF_COUNT; ++r)
		unit.m_dof[r] = static_cast<signed char>(rows.m_row[r].m_dof);
}

/// \param spin  relative, with external torques
void DirectForm::addDamping(const TensionDamping& damping, const btVector3& spin, const int bodies[2])
{
	for (const btVector3& axis : damping.m_across)
	{
		SystemInput::SingleRow& row = m_input.addSingleRow();
		for (int i = 0; i < 3; ++i)
		{
			row.m_J[i] = row.m_J[6 + i] = 0;
			row.m_J[3 + i] = axis[i];
			row.m_J[9 + i] = -axis[i];
		}
		row.m_body[0] = bodies[0];
		row.m_body[1] = bodies[1];
		m_input.m_rows[size_t(row.m_row)] = {-double(spin.dot(axis)), 1 / double(damping.m_factor), -UNBOUNDED,
											 UNBOUNDED};
	}
}

/// Adds a joint of bodies that may not move in every direction: parts of its rows' Jacobians are zero, so they are no unit.
void DirectForm::addUnitAsSingleRows(const JointRows& rows, const int solverBodies[2], const SolverPools& pools)
{
	const Kinematics& k = rows.m_kinematics;
	const btVector3 none(0, 0, 0), arms[2] = {k.m_rA, k.m_rB};
	for (int r = 0; r < rows.m_numRows; ++r)
	{
		SystemInput::SingleRow& row = m_input.addSingleRow();
		const int dof = rows.m_row[r].m_dof;
		for (int side = 0; side < 2; ++side)
		{
			const btVector3 axis = side == 0 ? k.m_axis[dof % 3] : -k.m_axis[dof % 3];
			const btSolverBody& body = pools.m_bodies[solverBodies[side]];
			copy(row.m_J + 6 * side, dof < 3 ? axis : none, body.m_linearFactor);
			copy(row.m_J + 6 * side + 3, dof < 3 ? arms[side].cross(axis) : axis, body.m_angularFactor);
			row.m_body[side] = m_index[solverBodies[side]];
		}
	}
}

// ---- Bullet's rows

/// Adds one of Bullet's rows. The fixed point of Bullet's iteration is rhs = cfm impulse + jacDiagABInv J dv, with
/// jacDiagABInv = 1 / (A + C); divided by jacDiagABInv it is the system's row.
SystemInput::SingleRow& DirectForm::addRow(const btSolverConstraint& from, const SolverPools& pools)
{
	SystemInput::SingleRow& row = m_input.addSingleRow();
	const btSolverBody &A = pools.m_bodies[from.m_solverBodyIdA], &B = pools.m_bodies[from.m_solverBodyIdB];
	copy(row.m_J, from.m_contactNormal1, A.m_linearFactor);
	copy(row.m_J + 3, from.m_relpos1CrossNormal, A.m_angularFactor);
	copy(row.m_J + 6, from.m_contactNormal2, B.m_linearFactor);
	copy(row.m_J + 9, from.m_relpos2CrossNormal, B.m_angularFactor);
	row.m_body[0] = m_index[from.m_solverBodyIdA];
	row.m_body[1] = m_index[from.m_solverBodyIdB];
	SystemInput::Bounded& terms = m_input.m_rows[row.m_row];
	const double diagonal = from.m_jacDiagABInv > 0 ? 1 / double(from.m_jacDiagABInv) : 1;
	terms.m_target = double(from.m_rhs) * diagonal;
	terms.m_compliance = btMax(double(from.m_cfm), HARD) * diagonal;
	terms.m_lower = from.m_lowerLimit;
	terms.m_upper = from.m_upperLimit;
	if (!isFiniteRow(row, terms))
		makeIdle(row, terms);
	return row;
}

/// Adds a contact's row, which is softened for the augmented Lagrangian unless it is softer already.
SystemInput::SingleRow& DirectForm::addContactRow(const btSolverConstraint& from, const SolverPools& pools)
{
	SystemInput::SingleRow& row = addRow(from, pools);
	SystemInput::Bounded& terms = m_input.m_rows[row.m_row];
	row.m_isContact = true;
	row.m_softening = btMax(0., SOFTENING / double(from.m_jacDiagABInv) - terms.m_compliance);
	terms.m_compliance += row.m_softening;
	return row;
}

/// The search begins with the bounds that follow from the impulses of the last step, which contact points keep. Multipliers
/// begin with the impulses of Bullet's warm start, which are a little smaller: an error that the loops leave then dissipates
/// energy and creates none.
void DirectForm::addContacts(const SolverPools& pools, const btContactSolverInfo& info)
{
	const bool hasTwoDirections = (info.m_solverMode & SOLVER_USE_2_FRICTION_DIRECTIONS) != 0;
	const int first = m_input.getNumSingleRows();
	m_lastFriction.resizeNoInitialize(0);
	m_lastFriction.resize(pools.m_friction.size(), 0);
	for (int i = 0; i < pools.m_contacts.size(); ++i)
	{
		btSolverConstraint& contact = pools.m_contacts[i];
		const int r = addContactRow(contact, pools).m_row;
		SystemInput::Bounded& row = m_input.m_rows[r];
		SystemInput::Guess& guess = m_input.m_guess[r];
		row.m_lower = 0;
		row.m_upper = UNBOUNDED;
		guess.m_bound = -1;
		m_recovery.addContact(contact, info, m_input, r);
		const btManifoldPoint* const point = static_cast<const btManifoldPoint*>(contact.m_originalContactPoint);
		if (!point)
			continue;
		guess.m_impulse = contact.m_appliedImpulse;
		guess.m_bound = static_cast<signed char>(guess.m_impulse > 0 ? 0 : -1);
		m_lastFriction[contact.m_frictionIndex] = point->m_appliedImpulseLateral1;
		if (hasTwoDirections)
			m_lastFriction[contact.m_frictionIndex + 1] = point->m_appliedImpulseLateral2;
	}
	addFriction(pools.m_friction, first, false, pools);
	addFriction(pools.m_rollingFriction, first, true, pools);
}

void DirectForm::addFriction(const btConstraintArray& rows, int firstContact, bool isRolling, const SolverPools& pools)
{
	for (int i = 0; i < rows.size(); ++i)
	{
		SystemInput::SingleRow& row = addContactRow(rows[i], pools);
		row.m_friction = rows[i].m_friction;
		row.m_normal = firstContact + rows[i].m_frictionIndex;
		// Bullet bounds rolling friction by its coefficient too.
		row.m_frictionMax = isRolling ? double(rows[i].m_friction) : 0;
		if (isRolling)
			continue;
		const double most = row.m_friction * m_input.m_guess[m_input.m_singleRows[row.m_normal].m_row].m_impulse;
		const double slides = SLIDING * most;
		m_input.m_guess[row.m_row].m_bound = static_cast<signed char>(m_lastFriction[i] >= slides    ? 1
																	  : m_lastFriction[i] <= -slides ? -1
																									 : 0);
	}
}

// ---- the solution

bool DirectForm::solve(const SolverPools& pools, const btContactSolverInfo& info)
{
	addBodies(pools);
	m_firstRow = m_input.getNumSingleRows();
	for (int i = 0; i < pools.m_constraints.size(); ++i)
		addRow(pools.m_constraints[i], pools);
	addContacts(pools, info);
	// The first joint of an island keeps the island's id.
	return m_recovery.solve(m_system, m_input, m_joints[0].m_works->m_islandId);
}

void DirectForm::writeResult(const SolverPools& pools, const btContactSolverInfo& info) const
{
	// Bullet turns bodies by a share of what it is told.
	const double turnShare = info.m_splitImpulseTurnErp > 0 ? double(info.m_splitImpulseTurnErp) : 1;
	for (int i = 0; i < pools.m_bodies.size(); ++i)
	{
		btSolverBody& body = pools.m_bodies[i];
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
		if (!m_recovery.hasMotion())
			continue;
		const double* motion = m_recovery.getMotion(m_index[i]);
		for (int k = 0; k < 3; ++k)
		{
			body.internalGetPushVelocity()[k] += linear[k] == 0 ? btScalar(0) : btScalar(motion[k]);
			body.internalGetTurnVelocity()[k] += angular[k] == 0 ? btScalar(0) : btScalar(motion[3 + k] / turnShare);
		}
	}
	btConstraintArray* const written[] = {&pools.m_constraints, &pools.m_contacts, &pools.m_friction,
										  &pools.m_rollingFriction};
	int row = m_firstRow;
	for (btConstraintArray* pool : written)
		for (int i = 0; i < pool->size(); ++i)
			(*pool)[i].m_appliedImpulse = btScalar(m_system.getImpulse(m_input.m_singleRows[row++].m_row));
}

btVector3 DirectForm::dampingImpulse(const Joint& joint) const
{
	btVector3 sum(0, 0, 0);
	for (int r = joint.m_firstDamping; r < joint.m_firstDamping + 2; ++r)
	{
		const SystemInput::SingleRow& row = m_input.m_singleRows[size_t(r)];
		sum += btVector3(btScalar(row.m_J[3]), btScalar(row.m_J[4]), btScalar(row.m_J[5])) *
			   btScalar(m_system.getImpulse(row.m_row));
	}
	return sum;
}

/// Tells a joint's step how its bodies' places move apart beside their velocities, and what it does against it.
void DirectForm::giveRecovery(const Joint& joint) const
{
	btVector3 linear[2], angular[2];
	for (int side = 0; side < 2; ++side)
	{
		linear[side].setZero();
		angular[side].setZero();
		const double* const motion = joint.m_bodies[side] >= 0 ? m_recovery.getMotion(joint.m_bodies[side]) : nullptr;
		for (int i = 0; motion && i < 3; ++i)
		{
			linear[side][i] = btScalar(motion[i]);
			angular[side][i] = btScalar(motion[3 + i]);
		}
	}
	joint.m_works->m_step.setRecovery(linear, angular, m_recovery.getImpulses(joint.m_firstRow),
									  joint.m_isCut ? BETWEEN : m_recovery.getBounds(joint.m_firstRow));
}

void DirectForm::finish()
{
	for (int j = 0; j < m_joints.size(); ++j)
	{
		const Joint& joint = m_joints[j];
		if (m_recovery.hasMotion())
			giveRecovery(joint);
		if (joint.m_firstDamping >= 0)
			joint.m_works->m_step.setDampingImpulse(dampingImpulse(joint));
		joint.m_works->finishAlone(m_system.getImpulses(joint.m_firstRow),
								   joint.m_isCut ? BETWEEN : m_system.getBounds(joint.m_firstRow));
	}
}

void DirectForm::cancel()
{
	for (int j = 0; j < m_joints.size(); ++j)
		m_joints[j].m_works->m_step.revert();
	m_joints.resize(0);
}
}  // namespace btElasticPlastic
