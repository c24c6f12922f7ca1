// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "DirectForm.h"

#include <algorithm>
#include <cmath>

#include "BulletCollision/NarrowPhaseCollision/btManifoldPoint.h"
#include "BulletDynamics/ConstraintSolver/btContactSolverInfo.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "../joint/BodyGate.h"
#include "../Cancelled.h"
#include "Jacobian.h"

namespace btElasticPlastic
{
namespace
{
/// Softening of contacts as a share of A: the augmented Lagrangian then gains two digits a loop, and the matrix stays well
/// conditioned.
const double SOFTENING = 1e-2;
/// The least compliance of the rows of Bullet's constraints, as a share of A: whatever digits it has less, momentum has, too. With HARD it is right to five.
/// They bear loads of up to a million times the bodies' mass. Contacts are softened, and made harder as they need it.
const double HARDEST_ROW = 1e-10;
/// The upper bound of a contact's normal impulse: none.
const double UNBOUNDED = 1e30;
/// A contact slides, as a first guess, if its friction had this share of its bound in the last step.
const double SLIDING = 0.999;
/// A contact would take long to sweep if what it holds, a loose body or a structure's share, is this many times as heavy as the joined
/// body that touches.
const double HEAVY = 3;
/// The most such contacts that are in the system.
const int MOST_HEAVY = 64;
/// Sweeps of contacts between two solutions of the system, and between those of one with few bodies, which cost little.
const int SWEEPS_A_SOLUTION = 5, SWEEPS_WITH_FEW = 2;
/// How often swept impulses that give energy are taken back, in the end all of them.
const int MOST_TAKEN_BACK = 4;
/// Recovery of swept contacts between loose bodies that is slower than this stays Bullet's [m/s].
const double SLOW_OF_LOOSE = 0.1;
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

/// Springs of btGeneric6DofSpring2Constraint ask for an infinite speed, in Bullet 2.89 always and later by a flag: what they mean is the
/// force at which they are bounded.
void boundInfinite(SystemInput::Bounded& terms)
{
	const double infinite = 1e30;  // [m/s], or an impulse [N s]
	const double bound = terms.m_target > 0 ? terms.m_upper : terms.m_lower;
	if (!(std::fabs(terms.m_target) > infinite && std::fabs(bound) < infinite))
		return;
	terms.m_lower = terms.m_upper = bound;
	terms.m_target = 0;
}

/// Makes a row one that has no effect.
void makeIdle(SystemInput::SingleRow& row, SystemInput::Bounded& terms)
{
	for (double& element : row.m_J)
		element = 0;
	terms.m_target = 0;
	terms.m_compliance = 1;
}

/// With which bound the search for a one-sided row begins. A limit from which its bodies are far asks for the speed that would take them there in a
/// step: to begin with that, and to take it back, leaves more than rounding where what they are joined to is rigid.
signed char boundAtRest(const SystemInput::Bounded& row)
{
	if (row.m_lower == 0 && row.m_upper > 0 && row.m_target < 0)
		return -1;
	return static_cast<signed char>(row.m_upper == 0 && row.m_lower < 0 && row.m_target > 0 ? 1 : 0);
}

/// The square of what two spins differ by, over that of their mean, up to which bodies turn as one.
const double AS_ONE = 0.1;

/// How fast two bodies that turn as one have to close along a contact's normal to stay where they are to each other [m/s]: the straight ways of a step
/// leave their circle, and part them by half of its square.
double closingOfTurn(const btSolverBody& A, const btSolverBody& B, const btVector3& normal, btScalar dt)
{
	if (!A.m_originalBody || !B.m_originalBody)
		return 0;
	const btVector3 spin = (A.m_angularVelocity + B.m_angularVelocity) / 2,
					apart = A.m_worldTransform.getOrigin() - B.m_worldTransform.getOrigin();
	if (!(double((A.m_angularVelocity - B.m_angularVelocity).length2()) < AS_ONE * double(spin.length2())))
		return 0;
	return btMax(-double(spin.cross(spin.cross(apart)).dot(normal)) * double(dt) / 2, 0.);
}

/// J v of a row at the velocities with which the step begins, external forces included.
double speedAlong(const SystemInput::SingleRow& row, const btSolverBody& A, const btSolverBody& B)
{
	const btVector3 velocity[4] = {
		A.m_linearVelocity + A.m_externalForceImpulse, A.m_angularVelocity + A.m_externalTorqueImpulse,
		B.m_linearVelocity + B.m_externalForceImpulse, B.m_angularVelocity + B.m_externalTorqueImpulse};
	double speed = 0;
	for (int i = 0; i < 12; ++i)
		speed += row.m_J[i] * double(velocity[i / 3][i % 3]);
	return speed;
}

bool isFree(const btSolverBody& body)
{
	const btVector3 one(1, 1, 1);
	return body.m_linearFactor == one && body.m_angularFactor == one;
}
}  // namespace

void DirectForm::begin(bool sweepsContacts, double share)
{
	m_sweepsContacts = sweepsContacts;
	m_share = share;
	m_input.clear();
	m_joints.resize(0);
	m_index.resize(0);
	m_poolRows.resize(0);
	m_solverBodies.resize(0);
	m_byOthers.clear();
	m_swept.clear(btScalar(share));
	m_recovery.begin();
}

/// Looks at the solver bodies that Bullet has made since the last call. There may be static ones only among them.
void DirectForm::addBodies(const SolverPools& pools)
{
	for (int i = m_index.size(); i < pools.m_bodies.size(); ++i)
	{
		const btRigidBody* body = pools.m_bodies[i].m_originalBody;
		// A kinematic body moves as it is told, even if it still has a mass.
		const bool moves =
			body && body->getInvMass() > 0 && !body->isKinematicObject() && !isFrozen(*body) && isWellFormed(*body);
		m_index.push_back(moves ? OUTSIDE : STILL);
		if (!m_sweepsContacts)
			addBody(i, pools);
	}
}

/// \return the body's index in the system, -1: it does not move
int DirectForm::addBody(int solverBody, const SolverPools& pools)
{
	int& index = m_index[solverBody];
	if (index == OUTSIDE)
	{
		index = m_input.getNumBodies();
		setMass(*pools.m_bodies[solverBody].m_originalBody, m_input.addBody());
		m_solverBodies.push_back(solverBody);
	}
	return index;
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
	btScalar along[BT_EP_DOF_COUNT];
	k.projectMotion(velocity[0], velocity[1], along);
	const double most = joint.m_model.m_constraint.getBreakingImpulseThreshold();
	Joint entry = {
		&joint, m_input.getNumRows(), {addBody(solverBodies[0], pools), addBody(solverBodies[1], pools)}, 0, 0, false};
	const auto isFreeOrStill = [&](int side, const btSolverBody& body)
	{ return entry.m_bodies[side] < 0 || isFree(body); };
	const bool isUnit = isFreeOrStill(0, A) && isFreeOrStill(1, B);
	if (isUnit)
		addUnit(rows, entry.m_bodies);
	else
		addUnitAsSingleRows(rows, solverBodies, pools);
	for (int r = 0; r < rows.m_numRows; ++r)
	{
		const JointRows::Row& from = rows.m_row[r];
		SystemInput::Bounded& row = m_input.m_rows[entry.m_firstRow + r];
		const double lower = from.m_soft.m_lower, upper = from.m_soft.m_upper;
		row.m_target = double(from.m_soft.m_velocity) - double(along[from.m_dof]);
		row.m_compliance = btMax(double(from.m_soft.m_compliance), HARD * double(from.m_diagonal));
		row.m_lower = btMax(lower, -most);
		row.m_upper = btMin(upper, most);
		row.m_partner = from.m_partner >= 0 ? entry.m_firstRow + from.m_partner : -1;
		row.m_coupling = from.m_coupling;
		m_input.m_guess[entry.m_firstRow + r].m_bound = from.m_bound;
		entry.m_isCut |= row.m_lower > lower || row.m_upper < upper;
	}
	if (rows.m_numFibres > 0)
		addFibres(rows, along, most, entry);
	if (isUnit)
	{
		entry.m_firstDamping = m_input.getNumSingleRows();
		entry.m_numDamping = rows.m_damping.m_numRows;
		addDamping(rows.m_damping, velocity[1], entry.m_bodies);
	}
	m_joints.push_back(entry);
}

void DirectForm::addUnit(const JointRows& rows, const int bodies[2])
{
	const Kinematics& k = rows.m_kinematics;
	SystemInput::Unit& unit = m_input.addUnit(rows.m_numRows + rows.m_numFibres, rows.m_numFibres);
	for (int i = 0; i < 3; ++i)
	{
		for (int axis = 0; axis < 3; ++axis)
			unit.m_axis[axis][i] = k.m_axis[axis][i];
		unit.m_arm[0][i] = k.m_rA[i];
		unit.m_arm[1][i] = k.m_rB[i];
	}
	unit.m_place[0] = k.m_bow[0];
	unit.m_place[1] = k.m_bow[1];
	for (int side = 0; side < 2; ++side)
		unit.m_body[side] = bodies[side];
	for (int r = 0; r < rows.m_numRows && r < BT_EP_DOF_COUNT; ++r)
		unit.m_dof[r] = static_cast<signed char>(rows.m_row[r].m_dof);
	for (int i = 0; i < rows.m_numFibres; ++i)
	{
		const JointRows::Fibre& from = rows.m_fibres[i];
		m_input.m_fibres[size_t(unit.m_firstFibre + i)] = {unit.m_place[0] + double(from.m_y),
														   unit.m_place[1] + double(from.m_z)};
	}
}

/// The terms of a joint's fibres, whose rows follow its others.
void DirectForm::addFibres(const JointRows& rows, const btScalar along[BT_EP_DOF_COUNT], double most, Joint& entry)
{
	const double axial = along[BT_EP_AXIAL], turnY = along[BT_EP_BENDING_Y], turnZ = along[BT_EP_BENDING_Z];
	for (int i = 0; i < rows.m_numFibres; ++i)
	{
		const JointRows::Fibre& from = rows.m_fibres[i];
		const int r = entry.m_firstRow + rows.m_numRows + i;
		SystemInput::Bounded& row = m_input.m_rows[size_t(r)];
		const double lower = from.m_soft.m_lower, upper = from.m_soft.m_upper;
		row.m_target = double(from.m_soft.m_velocity) - (axial + double(from.m_z) * turnY - double(from.m_y) * turnZ);
		row.m_compliance = btMax(double(from.m_soft.m_compliance), HARD * double(rows.m_fibreDiagonal));
		row.m_lower = btMax(lower, -most);
		row.m_upper = btMin(upper, most);
		m_input.m_guess[size_t(r)].m_bound = from.m_bound;
		entry.m_isCut |= row.m_lower > lower || row.m_upper < upper;
	}
	if (rows.m_coupledShear[0] >= 0 || rows.m_coupledShear[1] >= 0)
		coupleFibres(rows, entry);
}

/// Makes a bundle of the last unit's fibres and shears.
void DirectForm::coupleFibres(const JointRows& rows, const Joint& entry)
{
	SystemInput::Unit& unit = m_input.m_units.back();
	SystemInput::Bundle bundle = {int(m_input.m_units.size()) - 1, {-1, -1}, int(m_input.m_couplings.size())};
	for (int i = 0; i < unit.m_numFibres; ++i)
	{
		m_input.m_rows[size_t(unit.getFirstFibreRow() + i)].m_partner = SystemInput::Bounded::FIBRE_OF_BUNDLE;
		const btScalar* const coupling = rows.m_fibres[i].m_coupling;
		m_input.m_couplings.push_back({{double(coupling[0]), double(coupling[1])}});
	}
	for (int s = 0; s < 2; ++s)
		if (rows.m_coupledShear[s] >= 0)
		{
			bundle.m_shearRow[s] = entry.m_firstRow + rows.m_coupledShear[s];
			m_input.m_rows[size_t(bundle.m_shearRow[s])].m_partner = SystemInput::Bounded::SHEAR_OF_BUNDLE;
		}
	unit.m_bundle = int(m_input.m_bundles.size());
	m_input.m_bundles.push_back(bundle);
}

/// \param spin  relative, with external torques
void DirectForm::addDamping(const TensionDamping& damping, const btVector3& spin, const int bodies[2])
{
	for (int r = 0; r < damping.m_numRows; ++r)
	{
		const btVector3& axis = damping.m_row[r].m_axis;
		SystemInput::SingleRow& row = m_input.addSingleRow();
		for (int i = 0; i < 3; ++i)
		{
			row.m_J[i] = row.m_J[6 + i] = 0;
			row.m_J[3 + i] = axis[i];
			row.m_J[9 + i] = -axis[i];
		}
		row.m_body[0] = bodies[0];
		row.m_body[1] = bodies[1];
		m_input.m_rows[size_t(row.m_row)] = {-double(spin.dot(axis)), 1 / double(damping.m_row[r].m_factor), -UNBOUNDED,
											 UNBOUNDED};
	}
}

/// Adds a joint of bodies that may not move in every direction: parts of its rows' Jacobians are zero, so they are no unit.
void DirectForm::addUnitAsSingleRows(const JointRows& rows, const int solverBodies[2], const SolverPools& pools)
{
	const Kinematics& k = rows.m_kinematics;
	const btVector3 none(0, 0, 0), arms[2] = {k.m_rA, k.m_rB};
	/// \param along  direction, and arm beside that of the point; \param about  direction
	const auto add = [&](const btVector3& along, const btVector3& about, const btVector3& arm)
	{
		SystemInput::SingleRow& row = m_input.addSingleRow();
		for (int side = 0; side < 2; ++side)
		{
			const btVector3 moment = (arms[side] + arm).cross(along) + about;
			const btSolverBody& body = pools.m_bodies[solverBodies[side]];
			copy(row.m_J + 6 * side, side == 0 ? along : -along, body.m_linearFactor);
			copy(row.m_J + 6 * side + 3, side == 0 ? moment : -moment, body.m_angularFactor);
			row.m_body[side] = m_index[solverBodies[side]];
		}
	};
	for (int r = 0; r < rows.m_numRows; ++r)
	{
		const int dof = rows.m_row[r].m_dof;
		add(dof < 3 ? k.m_axis[dof] : none, dof < 3 ? none : k.m_axis[dof % 3],
			dof == BT_EP_AXIAL ? k.armOfBow() : none);
	}
	for (int i = 0; i < rows.m_numFibres; ++i)
		add(k.m_axis[0], none, k.armOfBow() + k.m_axis[1] * rows.m_fibres[i].m_y + k.m_axis[2] * rows.m_fibres[i].m_z);
}

// ---- Bullet's rows

/// Adds one of Bullet's rows. The fixed point of Bullet's iteration is rhs = cfm impulse + jacDiagABInv J dv, with
/// jacDiagABInv = 1 / (A + C); divided by jacDiagABInv it is the system's row.
SystemInput::SingleRow& DirectForm::addRow(btSolverConstraint& from, double hardest, const SolverPools& pools)
{
	const int bodies[2] = {addBody(from.m_solverBodyIdA, pools), addBody(from.m_solverBodyIdB, pools)};
	SystemInput::SingleRow& row = m_input.addSingleRow();
	m_poolRows.push_back({&from, row.m_row});
	const btSolverBody &A = pools.m_bodies[from.m_solverBodyIdA], &B = pools.m_bodies[from.m_solverBodyIdB];
	copy(row.m_J, from.m_contactNormal1, A.m_linearFactor);
	copy(row.m_J + 3, from.m_relpos1CrossNormal, A.m_angularFactor);
	copy(row.m_J + 6, from.m_contactNormal2, B.m_linearFactor);
	copy(row.m_J + 9, from.m_relpos2CrossNormal, B.m_angularFactor);
	row.m_body[0] = bodies[0];
	row.m_body[1] = bodies[1];
	SystemInput::Bounded& terms = m_input.m_rows[row.m_row];
	const double diagonal = from.m_jacDiagABInv > 0 ? 1 / double(from.m_jacDiagABInv) : 1;
	terms.m_target = double(from.m_rhs) * diagonal;
	terms.m_compliance = btMax(double(from.m_cfm), hardest) * diagonal;
	terms.m_lower = from.m_lowerLimit;
	terms.m_upper = from.m_upperLimit;
	boundInfinite(terms);
	if (!isFiniteRow(row, terms))
		makeIdle(row, terms);
	m_input.m_guess[size_t(row.m_row)].m_bound = boundAtRest(terms);
	return row;
}

/// Adds a contact's row, which is softened for the augmented Lagrangian unless it is softer already. What Bullet's warm start has
/// given to the bodies is taken back: the system gives it itself.
SystemInput::SingleRow& DirectForm::addContactRow(btSolverConstraint& from, const SolverPools& pools)
{
	SystemInput::SingleRow& row = addRow(from, HARD, pools);
	SystemInput::Bounded& terms = m_input.m_rows[row.m_row];
	row.m_isContact = true;
	row.m_softening = btMax(0., SOFTENING / double(from.m_jacDiagABInv) - terms.m_compliance);
	terms.m_compliance += row.m_softening;
	if (m_sweepsContacts)
	{
		btSolverBody &A = pools.m_bodies[from.m_solverBodyIdA], &B = pools.m_bodies[from.m_solverBodyIdB];
		A.internalApplyImpulse(from.m_contactNormal1 * A.internalGetInvMass(), from.m_angularComponentA,
							   -btScalar(from.m_appliedImpulse));
		B.internalApplyImpulse(from.m_contactNormal2 * B.internalGetInvMass(), from.m_angularComponentB,
							   -btScalar(from.m_appliedImpulse));
	}
	return row;
}

/// Where contacts are swept, the constraints' rows that hang together with joints are in the system, and others are swept.
void DirectForm::addConstraints(const SolverPools& pools)
{
	const auto isInside = [&](const btSolverConstraint& row)
	{ return m_index[row.m_solverBodyIdA] >= 0 || m_index[row.m_solverBodyIdB] >= 0; };
	for (bool grows = m_sweepsContacts; grows;)
	{
		const int before = m_input.getNumBodies();
		for (int i = 0; i < pools.m_constraints.size(); ++i)
			if (isInside(pools.m_constraints[i]))
			{
				addBody(pools.m_constraints[i].m_solverBodyIdA, pools);
				addBody(pools.m_constraints[i].m_solverBodyIdB, pools);
			}
		grows = m_input.getNumBodies() > before;
	}
	for (int i = 0; i < pools.m_constraints.size(); ++i)
		if (!m_sweepsContacts || isInside(pools.m_constraints[i]))
			addRow(pools.m_constraints[i], HARDEST_ROW, pools);
		else
			m_swept.addConstraint(i);
}

/// Chooses the contacts that stay in the system: sweeping sees only the two bodies that touch, and takes long where much more rests
/// on them.
void DirectForm::chooseExactContacts(const SolverPools& pools)
{
	const int n = pools.m_contacts.size();
	m_singleRowOf.resizeNoInitialize(n);
	for (int i = 0; i < n; ++i)
		m_singleRowOf[i] = m_sweepsContacts ? -1 : 0;
	if (n == 0)
		return;
	m_structures.find(m_input);
	m_isLoose.resizeNoInitialize(m_input.getNumBodies());
	for (int b = 0; b < m_input.getNumBodies(); ++b)
		m_isLoose[b] = m_structures.isLoose(b);
	if (!m_sweepsContacts)
		return;
	const auto massOf = [&](int solverBody)
	{ return 1 / double(pools.m_bodies[solverBody].m_originalBody->getInvMass()); };
	// The body of a structure that the contact holds, -1 if it holds none: from below, or against something heavier.
	const auto heldBy = [&](const btSolverConstraint& contact)
	{
		const int bodies[2] = {contact.m_solverBodyIdA, contact.m_solverBodyIdB};
		for (int side = 0; side < 2; ++side)
		{
			const int joined = bodies[side], other = bodies[1 - side];
			if (m_index[joined] >= 0 && !m_structures.isHeld(m_index[joined]) && m_index[other] == STILL)
				return joined;
		}
		return -1;
	};
	// The body of a structure on which something loose and heavy lies, -1 if there is none.
	const auto loadedBy = [&](const btSolverConstraint& contact)
	{
		const int bodies[2] = {contact.m_solverBodyIdA, contact.m_solverBodyIdB};
		for (int side = 0; side < 2; ++side)
		{
			const int loose = bodies[side], joined = bodies[1 - side];
			if (m_index[loose] == OUTSIDE && m_index[joined] >= 0 && massOf(loose) > HEAVY * massOf(joined))
				return joined;
		}
		return -1;
	};
	m_numSupports.resizeNoInitialize(0);
	m_numSupports.resize(m_input.getNumBodies(), 0);
	m_isLoaded.resizeNoInitialize(0);
	m_isLoaded.resize(m_input.getNumBodies(), false);
	for (int i = 0; i < n; ++i)
	{
		const int held = heldBy(pools.m_contacts[i]), loaded = loadedBy(pools.m_contacts[i]);
		if (held >= 0)
			++m_numSupports[m_structures.of(m_index[held])];
		if (loaded >= 0)
			m_isLoaded[m_index[loaded]] = true;
	}
	const auto isHeavy = [&](const btSolverConstraint& contact)
	{
		const int held = heldBy(contact);
		if (held < 0)
			return loadedBy(contact) >= 0;
		const int body = m_index[held];
		return m_isLoaded[body] ||
			   m_structures.getMass(body) > HEAVY * massOf(held) * m_numSupports[m_structures.of(body)];
	};
	for (int i = 0, numHeavy = 0; i < n && numHeavy < MOST_HEAVY; ++i)
		if (isHeavy(pools.m_contacts[i]))
		{
			m_singleRowOf[i] = 0;
			++numHeavy;
		}
}

/// A contact of what turns as one may close as fast as that leaves its circle, and neither opens nor gets deeper: one that overlaps would be held at
/// no speed, and work against all that holds the bodies together.
/// \return the contact's single row
int DirectForm::addContact(btSolverConstraint& contact, const SolverPools& pools, btScalar dt)
{
	const SystemInput::SingleRow& single = addContactRow(contact, pools);
	const int r = single.m_row;
	SystemInput::Bounded& row = m_input.m_rows[size_t(r)];
	const btSolverBody &A = pools.m_bodies[contact.m_solverBodyIdA], &B = pools.m_bodies[contact.m_solverBodyIdB];
	const double closing = closingOfTurn(A, B, contact.m_contactNormal1, dt);
	if (closing > 0)
	{
		// What has a wider gap closes anyway, and what bounces does not.
		const double asked = row.m_target + speedAlong(single, A, B);
		if (std::fabs(asked) < closing)
			row.m_target -= asked + closing;
	}
	SystemInput::Guess& guess = m_input.m_guess[size_t(r)];
	row.m_lower = 0;
	row.m_upper = UNBOUNDED;
	guess.m_bound = -1;
	if (contact.m_originalContactPoint)
	{
		guess.m_impulse = contact.m_appliedImpulse;
		guess.m_bound = static_cast<signed char>(guess.m_impulse > 0 ? 0 : -1);
	}
	return m_input.getNumSingleRows() - 1;
}

/// The search begins with the bounds that follow from the impulses of the last step, which contact points keep. Multipliers
/// begin with the impulses of Bullet's warm start, which are a little smaller: an error that the loops leave then dissipates
/// energy and creates none.
void DirectForm::addContacts(const SolverPools& pools, const btContactSolverInfo& info)
{
	chooseExactContacts(pools);
	for (int i = 0; i < pools.m_contacts.size(); ++i)
	{
		const double recovery = takeRecovery(i, pools, info);
		if (m_singleRowOf[i] >= 0)
			m_singleRowOf[i] = addContact(pools.m_contacts[i], pools, info.m_timeStep);
		else
			m_swept.addContact(i);
		addRecovery(i, recovery, pools);
	}
	m_isLoose.resize(m_input.getNumBodies(), true);
	addFriction(pools.m_friction, false, pools, info);
	addFriction(pools.m_rollingFriction, true, pools, info);
}

bool DirectForm::isLoose(int solverBody) const
{
	const int body = m_index[solverBody];
	// What contacts bring into the system was outside of it when structures were found.
	return body == OUTSIDE || body >= m_isLoose.size() || (body >= 0 && m_isLoose[body]);
}

/// Slow recovery between loose bodies stays Bullet's where contacts are swept: with it a stack stands as with Bullet.
double DirectForm::takeRecovery(int contact, const SolverPools& pools, const btContactSolverInfo& info) const
{
	btSolverConstraint& row = pools.m_contacts[contact];
	const bool isOutside = m_index[row.m_solverBodyIdA] < 0 && m_index[row.m_solverBodyIdB] < 0;
	return Recovery::take(row, info, isOutside ? SLOW_OF_LOOSE : 0);
}

void DirectForm::addRecovery(int contact, double speed, const SolverPools& pools)
{
	const btSolverConstraint& row = pools.m_contacts[contact];
	const int bodies[2] = {row.m_solverBodyIdA, row.m_solverBodyIdB};
	const bool loose[2] = {isLoose(bodies[0]), isLoose(bodies[1])};
	if (loose[0] || loose[1])
	{
		// What lies on a loose body that is moved moves with it.
		if (speed > 0 || pools.m_contacts[contact].m_appliedImpulse > 0)
			m_recovery.addContact(contact, speed, loose);
	}
	else if (speed == 0)
		return;
	else if (m_singleRowOf[contact] >= 0)
		m_recovery.addJoinedContact(m_input.m_singleRows[size_t(m_singleRowOf[contact])].m_row, speed,
									double(row.m_jacDiagABInv));
	else
	{
		const bool moves[2] = {m_index[bodies[0]] != STILL, m_index[bodies[1]] != STILL};
		m_recovery.addContact(contact, speed, moves);
	}
}

void DirectForm::addFriction(btConstraintArray& rows, bool isRolling, const SolverPools& pools,
							 const btContactSolverInfo& info)
{
	const bool hasTwoDirections = (info.m_solverMode & SOLVER_USE_2_FRICTION_DIRECTIONS) != 0;
	for (int i = 0; i < rows.size(); ++i)
	{
		const int contact = rows[i].m_frictionIndex;
		if (m_singleRowOf[contact] < 0)
		{
			isRolling ? m_swept.addRollingFriction(i) : m_swept.addFriction(i);
			continue;
		}
		SystemInput::SingleRow& row = addContactRow(rows[i], pools);
		row.m_friction = rows[i].m_friction;
		row.m_normal = m_singleRowOf[contact];
		// Bullet bounds rolling friction by its coefficient too.
		row.m_frictionMax = isRolling ? double(rows[i].m_friction) * m_share : 0;
		if (isRolling)
			continue;
		// The last step's impulse in this direction: the first of a contact's rows, or the second.
		double last = 0;
		if (const auto* const point =
				static_cast<const btManifoldPoint*>(pools.m_contacts[contact].m_originalContactPoint))
		{
			const bool isSecond = i != pools.m_contacts[contact].m_frictionIndex;
			last = !isSecond          ? point->m_appliedImpulseLateral1
				   : hasTwoDirections ? point->m_appliedImpulseLateral2
									  : btScalar(0);
		}
		const double most = row.m_friction * m_input.m_guess[m_input.m_singleRows[row.m_normal].m_row].m_impulse;
		const double slides = SLIDING * most;
		m_input.m_guess[row.m_row].m_bound = static_cast<signed char>(last >= slides ? 1 : last <= -slides ? -1 : 0);
	}
}

// ---- the solution

void DirectForm::solve(const SolverPools& pools, const btContactSolverInfo& info,
					   const SweptRows::RowSolvers& rowSolvers)
{
	addBodies(pools);
	addConstraints(pools);
	addContacts(pools, info);
	if (!m_swept.isEmpty())
	{
		solveAround(pools, info, rowSolvers);
		return;
	}
	m_recovery.keep(m_input);
	// The first joint of an island keeps the island's id.
	const bool isSolved = m_system.solve(m_input, m_joints[0].m_works->m_islandId, System::EXACT);
	writeVelocities(pools);
	recover(isSolved, pools, info);
}

void DirectForm::recover(bool isSolved, const SolverPools& pools, const btContactSolverInfo& info)
{
	if (isSolved && !m_system.isCut() && m_recovery.isAsked())
		m_recovery.solve(m_system, m_input, pools, info, m_solverBodies, m_isLoose);
}

/// Sweeps and solutions in turn; ends with a solution.
void DirectForm::solveAround(const SolverPools& pools, const btContactSolverInfo& info,
							 const SweptRows::RowSolvers& rowSolvers)
{
	m_asked.read(m_input);
	const int sweeps = btMax(info.m_numIterations, 1),
			  between = m_solverBodies.size() > System::FEW_BODIES ? SWEEPS_A_SOLUTION : SWEEPS_WITH_FEW;
	bool isSolved = true;
	const auto takeTargets = [&]
	{
		takeOthers(pools);
		takeFromTargets(m_input, m_byOthers, m_isChanged, m_asked);
	};
	for (int done = 0;;)
	{
		const bool isFirst = done == 0, isLast = done >= sweeps;
		const double made = isFirst ? m_swept.findMade(pools) : 0;
		takeTargets();
		if (isLast)
			m_recovery.keep(m_input);
		const System::Effort effort = isLast ? System::EXACT : System::ROUGH;
		isSolved = isFirst ? m_system.solve(m_input, m_joints[0].m_works->m_islandId, effort, 2 + sweeps / between)
						   : m_system.solveAgain(m_input, effort);
		// Neither sweeps nor solutions let the sum of both rise, so it has to begin below 0: else there would be energy from nowhere.
		if (made > 0 && !(made + m_system.findMade(m_input) <= 0))
		{
			writeVelocities(pools);
			m_swept.takeBack(pools);
			takeTargets();
			isSolved = m_system.solveAgain(m_input, effort);
		}
		writeVelocities(pools);
		if (isLast)
			break;
		// Where much of the structure is flowing, a solution costs much, and says little about the next one.
		const int most = m_system.isHard() ? sweeps : between;
		for (int i = 0; i < most && done < sweeps; ++i, ++done)
			m_swept.sweep(pools, rowSolvers);
	}
	// Impulses of the step before that contacts have no need of by now go slowly where much is joined to the bodies that touch.
	for (int i = 1; isSolved && i <= MOST_TAKEN_BACK && m_swept.giveEnergy(pools); ++i)
	{
		if (i < MOST_TAKEN_BACK)
			m_swept.takeBackWhatParts(pools);
		else
			m_swept.takeBack(pools);
		takeTargets();
		m_recovery.keep(m_input);
		isSolved = m_system.solveAgain(m_input, System::EXACT);
		writeVelocities(pools);
	}
	recover(isSolved, pools, info);
}

/// Reads what swept rows have given to the system's bodies since their velocities were written.
void DirectForm::takeOthers(const SolverPools& pools)
{
	const size_t n = size_t(m_solverBodies.size());
	if (m_byOthers.size() != 6 * n)
	{
		m_byOthers.assign(6 * n, 0.);
		m_written.assign(6 * n, 0.);
	}
	m_isChanged.assign(n, 0);
	for (size_t b = 0; b < n; ++b)
	{
		btSolverBody& body = pools.m_bodies[m_solverBodies[int(b)]];
		for (size_t i = 0; i < 6; ++i)
		{
			const btVector3& now =
				i < 3 ? body.internalGetDeltaLinearVelocity() : body.internalGetDeltaAngularVelocity();
			const double given = double(now[int(i % 3)]) - m_written[6 * b + i];
			m_byOthers[6 * b + i] += given;
			m_isChanged[b] |= given != 0;
		}
	}
}

/// Gives bodies the system's change of velocity, beside what swept rows have given. What stands in a plane stays there: out of it there is rounding.
void DirectForm::writeVelocities(const SolverPools& pools)
{
	double fastest[2] = {};  // along and about an axis
	for (int b = 0; b < m_solverBodies.size(); ++b)
	{
		const double* const own = m_system.getVelocityChange(b);
		for (int i = 0; i < 6; ++i)
			fastest[i / 3] = std::max(fastest[i / 3], std::fabs(own[i]));
	}
	for (int b = 0; b < m_solverBodies.size(); ++b)
	{
		btSolverBody& body = pools.m_bodies[m_solverBodies[b]];
		const btVector3 &linearFactor = body.m_originalBody->getLinearFactor(),
						&angularFactor = body.m_originalBody->getAngularFactor();
		btVector3 &linear = body.internalGetDeltaLinearVelocity(), &angular = body.internalGetDeltaAngularVelocity();
		double own[6];
		for (int i = 0; i < 6; ++i)
			own[i] = cancelled(m_system.getVelocityChange(b)[i], fastest[i / 3]);
		const double* const others = m_byOthers.empty() ? nullptr : &m_byOthers[size_t(6 * b)];
		for (int i = 0; i < 3; ++i)
		{
			linear[i] = linearFactor[i] == 0 ? btScalar(0) : btScalar(own[i] + (others ? others[i] : 0));
			angular[i] = angularFactor[i] == 0 ? btScalar(0) : btScalar(own[3 + i] + (others ? others[3 + i] : 0));
			if (!others)
				continue;
			m_written[size_t(6 * b + i)] = linear[i];
			m_written[size_t(6 * b + 3 + i)] = angular[i];
		}
	}
}

/// Takes back what Bullet has given to bodies that move as they are told but have a mass: by its warm start, and by sweeping.
void DirectForm::holdStill(const SolverPools& pools) const
{
	for (int i = 0; i < m_index.size(); ++i)
		if (m_index[i] == STILL)
			for (btVector3* change :
				 {&pools.m_bodies[i].m_deltaLinearVelocity, &pools.m_bodies[i].m_deltaAngularVelocity,
				  &pools.m_bodies[i].m_pushVelocity, &pools.m_bodies[i].m_turnVelocity})
				change->setZero();
}

void DirectForm::writeResult(const SolverPools& pools, const btContactSolverInfo& info) const
{
	holdStill(pools);
	for (int i = 0; i < m_poolRows.size(); ++i)
		m_poolRows[i].m_from->m_appliedImpulse = btScalar(m_system.getImpulse(m_poolRows[i].m_row));
	if (!m_recovery.hasMotion())
		return;
	// Bullet turns bodies by a share of what it is told.
	const double turnShare = info.m_splitImpulseTurnErp > 0 ? double(info.m_splitImpulseTurnErp) : 1;
	for (int i = 0; i < pools.m_bodies.size(); ++i)
	{
		btSolverBody& body = pools.m_bodies[i];
		if (m_index[i] == STILL)
			continue;
		const double* const motion = m_recovery.getMotion(i);
		const btVector3 &linear = body.m_originalBody->getLinearFactor(),
						&angular = body.m_originalBody->getAngularFactor();
		for (int k = 0; k < 3; ++k)
		{
			body.internalGetPushVelocity()[k] += linear[k] == 0 ? btScalar(0) : btScalar(motion[k]);
			body.internalGetTurnVelocity()[k] += angular[k] == 0 ? btScalar(0) : btScalar(motion[3 + k] / turnShare);
		}
	}
}

btVector3 DirectForm::dampingImpulse(const Joint& joint) const
{
	btVector3 sum(0, 0, 0);
	for (int r = joint.m_firstDamping; r < joint.m_firstDamping + joint.m_numDamping; ++r)
	{
		const SystemInput::SingleRow& row = m_input.m_singleRows[size_t(r)];
		sum += btVector3(btScalar(row.m_J[3]), btScalar(row.m_J[4]), btScalar(row.m_J[5])) *
			   btScalar(m_system.getImpulse(row.m_row));
	}
	return sum;
}

/// Tells a joint's step how its bodies' places move apart beside their velocities.
void DirectForm::giveRecovery(const Joint& joint) const
{
	btVector3 linear[2], angular[2];
	for (int side = 0; side < 2; ++side)
	{
		linear[side].setZero();
		angular[side].setZero();
		const int body = joint.m_bodies[side];
		const double* const motion = body >= 0 ? m_recovery.getMotion(m_solverBodies[body]) : nullptr;
		for (int i = 0; motion && i < 3; ++i)
		{
			linear[side][i] = btScalar(motion[i]);
			angular[side][i] = btScalar(motion[3 + i]);
		}
	}
	joint.m_works->m_step.setRecovery(linear, angular);
}

void DirectForm::finish(bool isFree)
{
	for (int j = 0; j < m_joints.size(); ++j)
	{
		if (j + PREFETCH_AHEAD < m_joints.size())
			m_joints[j + PREFETCH_AHEAD].m_works->prefetch();
		const Joint& joint = m_joints[j];
		if (j + 1 < m_joints.size())
			m_joints[j + 1].m_works->prefetchPartsForSolution();
		joint.m_works->m_step.setFree(isFree);
		if (m_recovery.hasMotion())
			giveRecovery(joint);
		if (m_system.isCut())
			joint.m_works->m_step.setCut();
		if (joint.m_numDamping > 0)
			joint.m_works->m_step.setDampingImpulse(dampingImpulse(joint));
		joint.m_works->finishAlone(m_system.getImpulses(joint.m_firstRow),
								   joint.m_isCut ? nullptr : m_system.getBounds(joint.m_firstRow));
	}
}

void DirectForm::cancel()
{
	for (int j = 0; j < m_joints.size(); ++j)
		m_joints[j].m_works->m_step.revert();
	m_joints.resize(0);
}
}  // namespace btElasticPlastic
