// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// A step of a joint: from pose and step to rows.

#include "JointStep.h"

#include <math.h>

#include "BodyGate.h"
#include "BodyLoad.h"
#include "Diagonal.h"
#include "JoinedVelocity.h"
#include "SupportWay.h"

namespace btElasticPlastic
{
namespace
{
/// Below this square of frequency times step a row is by row in them, too: that damps its own swing by 0.4 % of the critical.
const btScalar WELL_RESOLVED = btScalar(0.1);
/// What a row has done before a blow does not count below this share of what it does in the first step.
const btScalar SHARE_AT_REST = btScalar(1e-3);
}  // namespace

int JointStep::prepare(bool knowsFibres)
{
	m_numRows = 0;
	m_usesFibres = knowsFibres && m_model.usesFibres();
	if (m_model.m_state.m_broken || (m_model.bodyA().getInvMass() == 0 && m_model.bodyB().getInvMass() == 0))
		return 0;
	// Angular rows come first, as in Bullet's own classes.
	const auto isPlain = [&](int dof)
	{ return m_model.isElasticPlastic(dof) && !(m_usesFibres && btElasticPlasticCapacity::isOfFibres(dof)); };
	for (int dof = 3; dof < BT_EP_DOF_COUNT; ++dof)
		if (isPlain(dof))
			m_row[m_numRows++].m_dof = dof;
	for (int dof = 0; dof < 3; ++dof)
		if (isPlain(dof))
			m_row[m_numRows++].m_dof = dof;
	// In the order of what fibres add up to.
	for (int dof = 0; dof < BT_EP_DOF_COUNT && m_usesFibres; ++dof)
		if (btElasticPlasticCapacity::isOfFibres(dof))
			m_row[m_numRows++].m_dof = dof;
	return m_numRows;
}

/// Takes the motion of kinematic bodies out of the measured strain. A kinematic body is already where the step will take it,
/// and its velocity is the one that brought it there: the step would count this motion a second time.
void JointStep::takeBackKinematicMotion()
{
	const btRigidBody &A = m_model.bodyA(), &B = m_model.bodyB();
	if (!A.isKinematicObject() && !B.isKinematicObject())
		return;
	btVector3 linear(0, 0, 0), angular(0, 0, 0);
	if (A.isKinematicObject())
	{
		linear += velocityAt(A, m_kinematics.m_rA);
		angular += spinOf(A);
	}
	if (B.isKinematicObject())
	{
		linear -= velocityAt(B, m_kinematics.m_rB);
		angular -= spinOf(B);
	}
	btScalar moved[BT_EP_DOF_COUNT];
	m_kinematics.projectMotion(linear, angular, moved);
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		m_kinematics.m_strain[i] += m_dt * moved[i];
}

bool JointStep::evaluate(btScalar dt, btScalar share)
{
	const SupportWay support(m_model);
	if (!m_isLeadFound)
		m_lead = support.findLead(dt / share);
	m_isLeadFound = true;
	m_model.measure(m_kinematics, m_lead + support.getLate());
	if (!m_kinematics.isUsable() || !(dt > 0) || !btElasticPlasticIsFinite(dt))
	{
		revert();
		return false;
	}
	btScalar velocity[BT_EP_DOF_COUNT];
	projectVelocities(velocity);
	m_spin0[0] = spinOf(m_model.bodyA());
	m_spin0[1] = spinOf(m_model.bodyB());
	m_dampingImpulse.setZero();
	m_hasRecovery = m_isCut = m_isWorkKnown = false;
	for (int r = 0, rows = m_numRows; r < rows; ++r)
	{
		m_row[r].m_velocity0 = velocity[m_row[r].m_dof];
		m_row[r].m_partner = -1;
		m_row[r].m_coupling = 0;
		m_row[r].m_isOfWaves = m_row[r].m_isAtRest = false;
		setImpulse(r, 0);
	}
	m_dt = dt;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		m_yield[i] = m_model.yieldUnder(-m_model.m_state.m_force[BT_EP_AXIAL], i);
	const btScalar damping = m_model.m_capacity.m_damping;
	if (!m_damping.isFor(damping, dt))
		m_damping = MaterialDamping(damping, dt);
	takeBackKinematicMotion();
	withholdDrift();
	return true;
}

/// The most that bodies A and B leave at a joint in a step if they turn so fast.
/// \param spin  [rad/s]
JointStep::Drift JointStep::driftOf(const btScalar spin[2], btScalar dt) const
{
	const btScalar a = spin[0] * dt * spin[0] * dt, b = spin[1] * dt * spin[1] * dt;
	return {a * m_kinematics.m_rA.length() + b * m_kinematics.m_rB.length(), a + b};
}

/// The strain that is measured is the law's, force over stiffness, and a drift: what the straight motion of a step has left beside
/// it, as a body that turns about a joint leaves its circle by r (w dt)^2 / 2 in every step. At an even step the law takes the drift
/// back with a part of the force that holds the body on its circle. A step that is shorter by a factor s would take all of it back
/// in its shorter time, with 1 / s^2 times that force, and a stiff joint would yield at rest. So it meets s^2 of the drift, what it
/// will leave itself. The rest is withheld, and each later step meets s^2 of what is left, until all of it has been taken back.
/// What is more than turns leave is none: somebody has put a body elsewhere.
///
/// A step meets no more of it than its own turn will leave. Where a blow has stopped the turn no force holds bodies on a circle any more: to
/// take the drift back would set them in motion, or wedge them between what they touch. It stays.
void JointStep::withholdDrift()
{
	const btElasticPlasticState& state = m_model.m_state;
	const btScalar last = state.m_lastStep;
	const bool isShorter = m_dt < last && !m_model.m_isPaper;
	if (!isShorter && state.m_withheldStep == 0)
	{
		m_withheldStep = 0;
		for (btScalar& withheld : m_withheld)
			withheld = 0;
		return;
	}
	m_withheldStep = isShorter ? btMax(last, state.m_withheldStep) : state.m_withheldStep;
	const btScalar met = m_withheldStep > m_dt ? m_dt / m_withheldStep * (m_dt / m_withheldStep) : btScalar(1);
	// What turned then may have been stopped since.
	const btScalar now[2] = {m_spin0[0].length(), m_spin0[1].length()},
				   before[2] = {btMax(now[0], state.m_spin[0]), btMax(now[1], state.m_spin[1])};
	const Drift left = driftOf(before, m_withheldStep), ahead = driftOf(now, m_dt);
	bool isAnyLeft = false;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		m_withheld[i] = state.m_withheld[i];
		const bool isBorne = m_model.isElasticPlastic(i), isRigid = m_model.m_capacity.isRigidPlastic(i);
		if (isShorter && isBorne)
		{
			// What was withheld before is so still, whatever has become of the turn that left it.
			const btScalar most = btMax(left.of(i), btFabs(state.m_withheld[i])), strain = m_kinematics.m_strain[i];
			// What rigid rows have left open has gathered over steps, each of which closes a part of it.
			m_withheld[i] = isRigid ? strain : btClamped(strain - m_model.elasticDeformation(i), -most, most);
		}
		const btScalar share = m_withheld[i] * met,
					   taken = isRigid ? share : btClamped(share, -ahead.of(i), ahead.of(i));
		m_withheld[i] = isBorne ? m_withheld[i] - taken : btScalar(0);
		m_kinematics.m_strain[i] -= m_withheld[i];
		isAnyLeft |= m_withheld[i] != 0;
	}
	if (!isAnyLeft)
		m_withheldStep = 0;
}

bool JointStep::carriesWaves(int r, btScalar diagonal) const
{
	const int dof = m_row[r].m_dof;
	return !m_model.m_isPaper && (m_usesFibres || !m_model.m_isByMode) && !m_model.m_capacity.isRigidPlastic(dof) &&
		   m_model.m_capacity.m_stiffness[dof] * m_dt * m_dt * diagonal > WELL_RESOLVED;
}

/// Whether what a row has done so far is next to nothing beside what the step begins with: then its past is the same in steps of any length.
bool JointStep::isAtRest(int r) const
{
	const DofState s = dofState(r);
	const btScalar coming = s.m_stiffness * m_dt * btFabs(m_row[r].m_velocity0),
				   gone = btMax(btMax(btFabs(s.m_applied[0] - s.m_force), btFabs(s.m_applied[1] - s.m_force)),
								btFabs(s.m_forceRate) * m_model.m_state.m_lastStep);
	return gone <= SHARE_AT_REST * coming;
}

DofState JointStep::dofState(int r) const
{
	const btElasticPlasticState& state = m_model.m_state;
	const int dof = m_row[r].m_dof;
	DofState s = {m_model.m_capacity.m_stiffness[dof],
				  yieldOf(dof),
				  m_kinematics.m_strain[dof],
				  state.m_force[dof],
				  state.m_forceRate[dof],
				  {state.m_applied[dof], state.m_appliedBefore[dof]}};
	m_damping.addTo(s, state.m_branch, dof);
	return s;
}

PaperLaw JointStep::paperLaw(int dof) const
{
	const btRigidBody &A = m_model.bodyA(), &B = m_model.bodyB();
	if (m_model.m_constraint.getConstraintType() == D6_SPRING_CONSTRAINT_TYPE)
		return {PaperLaw::MOTOR, 0};
	if (dof < 3)
		return {PaperLaw::SPRING, btMax(A.getInvMass(), B.getInvMass())};
	const btVector3& axis = m_kinematics.m_axis[dof - 3];
	return {PaperLaw::SPRING,
			btMax((A.getInvInertiaTensorWorld() * axis).length(), (B.getInvInertiaTensorWorld() * axis).length())};
}

SoftRow JointStep::makeRow(int r, btScalar diagonal, btScalar erp, bool isForStock)
{
	Row& row = m_row[r];
	const int dof = row.m_dof;
	const DofState s = dofState(r);
	SoftRow soft;
	if (m_model.m_capacity.isRigidPlastic(dof))
		soft = rigidRow(s.m_yield, s.m_strain, erp, m_dt);
	else if (m_model.m_isPaper)
		soft = paperLaw(dof).row(s, m_dt);
	else if (isForStock)
		soft = stockRow(s, diagonal, m_dt);
	else
	{
		const btScalar a = s.m_stiffness * m_dt * m_dt * diagonal;
		soft = implicitRow(s, meanForce(r, a), a, m_dt);
	}
	m_erp = erp;
	row.m_isForStock = isForStock;
	row.m_lower = soft.m_lower;
	row.m_upper = soft.m_upper;
	return soft;
}

/// Couples the rows of shear and bending whose compliance is coupled, for a solver that solves them together.
void JointStep::couple(JointRows& rows)
{
	for (int r = 0; r < m_numRows; ++r)
	{
		const int dof = m_row[r].m_dof, other = btElasticPlasticCapacity::coupledWith(dof);
		const btScalar coupling = dof < 3 ? m_model.m_capacity.couplingCompliance(dof) : btScalar(0);
		if (coupling == 0)
			continue;
		int partner = 0;
		while (m_row[partner].m_dof != other)
			++partner;
		const int pair[2] = {r, partner};
		const bool areOfWaves = m_row[r].m_isOfWaves && m_row[partner].m_isOfWaves,
				   areAtRest = m_row[r].m_isAtRest && m_row[partner].m_isAtRest;
		m_row[r].m_isOfWaves = m_row[partner].m_isOfWaves = areOfWaves;
		m_row[r].m_isAtRest = m_row[partner].m_isAtRest = areAtRest;
		const DofState states[2] = {dofState(r), dofState(partner)};
		const btScalar step = m_dt * m_dt, a[2] = {states[0].m_stiffness * rows.m_row[r].m_diagonal * step,
												   states[1].m_stiffness * rows.m_row[partner].m_diagonal * step};
		SoftRow soft[2];
		// Of one scheme, by row that of the stiffer one.
		const btScalar between = coupledRows(states, meanForce(r, btMax(a[0], a[1])), a, coupling, m_dt, soft);
		for (int i = 0; i < 2; ++i)
		{
			Row& row = m_row[pair[i]];
			row.m_lower = soft[i].m_lower;
			row.m_upper = soft[i].m_upper;
			row.m_isForStock = false;
			row.m_partner = static_cast<signed char>(pair[1 - i]);
			row.m_coupling = coupling;
			rows.m_row[pair[i]].m_soft = soft[i];
			rows.m_row[pair[i]].m_partner = pair[1 - i];
			rows.m_row[pair[i]].m_coupling = between;
		}
	}
}

void JointStep::makeRows(btScalar erp, JointRows& rows)
{
	if (!m_usesFibres && !m_model.m_isPaper)
		couple(rows);
	for (int r = 0; r < rows.m_numRows; ++r)
		if (m_row[r].m_partner < 0)
			rows.m_row[r].m_soft = makeRow(r, rows.m_row[r].m_diagonal, erp, false);
}

/// Whether all rows may be those of springs by row, and so be computed side by side.
bool JointStep::areAlike() const
{
	return m_model.isElasticPlasticThroughout() && m_numRows == BT_EP_DOF_COUNT && !m_model.m_isPaper &&
		   (m_usesFibres || !m_model.m_isByMode) && SpringLanes::areSprings(m_model.m_capacity);
}

/// What fibres add up to is among them, and nobody asks for it: it never yields.
SpringLanes JointStep::findSprings() const
{
	if (!m_usesFibres)
		return SpringLanes(m_model.m_capacity, m_model.m_state, m_damping, m_kinematics.m_strain, m_yield, true);
	btScalar yield[BT_EP_DOF_COUNT];
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		yield[i] = btElasticPlasticCapacity::isOfFibres(i) ? btScalar(BT_LARGE_FLOAT) : yieldOf(i);
	return SpringLanes(m_model.m_capacity, m_model.m_state, m_damping, m_kinematics.m_strain, yield, false);
}

/// As couple() and makeRow() do it for rows one by one.
void JointStep::makeRowsAlike(btScalar erp, JointRows& rows)
{
	m_erp = erp;
	const SpringLanes springs = findSprings();
	Lanes diagonal;
	int rowOf[BT_EP_DOF_COUNT];
	diagonal.fill(1);
	for (int r = 0; r < rows.m_numRows; ++r)
	{
		rowOf[m_row[r].m_dof] = r;
		diagonal[m_row[r].m_dof] = rows.m_row[r].m_diagonal;
	}
	SpringLanes::Rows made;
	springs.makeRows(diagonal, m_dt, lastStep(), made);
	for (int r = 0; r < rows.m_numRows; ++r)
	{
		Row& row = m_row[r];
		SoftRow& soft = rows.m_row[r].m_soft;
		const int dof = row.m_dof;
		soft.m_compliance = made.m_compliance[dof];
		soft.m_velocity = made.m_velocity[dof];
		row.m_lower = soft.m_lower = made.m_lower[dof];
		row.m_upper = soft.m_upper = made.m_upper[dof];
		row.m_isForStock = false;
	}
	for (int pair = 0; pair < 2; ++pair)
	{
		if (springs.getCoupling(pair) == 0)
			continue;
		const int shear = BT_EP_SHEAR_Y + pair, bending = btElasticPlasticCapacity::coupledWith(shear);
		for (const int dof : {shear, bending})
		{
			const int r = rowOf[dof], partner = rowOf[shear + bending - dof];
			m_row[r].m_partner = static_cast<signed char>(partner);
			m_row[r].m_coupling = springs.getCoupling(pair);
			rows.m_row[r].m_partner = partner;
			rows.m_row[r].m_coupling = made.m_coupling[pair];
		}
	}
}

/// What shears and torsion leave of the fibres and of each other, by the motion with which the step begins.
FibreStep::Motion JointStep::beginShear(const Diagonal& diagonal)
{
	FibreStep::Motion motion = {};
	motion.m_lastStep = lastStep();
	motion.m_turn[0] = diagonal.about(m_kinematics.m_axis[1]);
	motion.m_turn[1] = diagonal.about(m_kinematics.m_axis[2]);
	for (int r = 0; r < m_numRows; ++r)
		motion.m_rate[m_row[r].m_dof] = getRateBefore(r);
	m_fibres.beginShear(motion, m_dt);
	return motion;
}

void JointStep::makeFibres(const FibreStep::Motion& motion, const Diagonal& diagonal, JointRows& rows)
{
	const Kinematics& k = m_kinematics;
	const btVector3& axis = k.m_axis[0];
	m_fibres.begin(k.m_strain, motion, diagonal.along(k.armA(0).cross(axis), k.armB(0).cross(axis)), m_dt, rows);
}

/// By how far the past of what fibres add up to is as of steps of this length, see MeanForce::tauOfWaves().
btScalar JointStep::tauOfFibres(bool hasOtherPast)
{
	bool areAtRest = hasOtherPast;
	for (int r = getNumPlainRows(); r < m_numRows && areAtRest; ++r)
		areAtRest = isAtRest(r);
	for (int r = getNumPlainRows(); r < m_numRows; ++r)
		m_row[r].m_isAtRest = areAtRest;
	return MeanForce::tauOfWaves(m_dt, areAtRest ? m_dt : lastStep());
}

/// What fibres add up to, and what is coupled with them, is of their scheme.
void JointStep::takeScheme()
{
	const int numPlain = getNumPlainRows();
	for (int r = 0; r < m_numRows; ++r)
		if (r >= numPlain || m_fibres.isCoupled(r))
		{
			m_row[r].m_isOfWaves = m_fibres.areOfWaves();
			m_row[r].m_isAtRest = m_row[m_numRows - 1].m_isAtRest;
		}
}

void JointStep::beginFibres(JointRows& rows)
{
	const Diagonal diagonal(m_model.bodyA(), m_model.bodyB());
	rows.m_numRows = 0;
	makeFibres(beginShear(diagonal), diagonal, rows);
}

bool JointStep::begin(btScalar dt, btScalar erp, StepKind kind, JointRows& rows)
{
	if (m_numRows == 0 || !evaluate(dt, kind.m_share))
		return false;
	const Kinematics& k = rows.m_kinematics = m_kinematics;
	const Diagonal diagonal(m_model.bodyA(), m_model.bodyB());
	FibreStep::Motion motion = {};
	if (m_usesFibres)
		motion = beginShear(diagonal);
	if (m_model.m_isPaper)
		rows.m_damping = TensionDamping();
	else
		rows.m_damping = TensionDamping::of(m_model, k, m_isTensionKnown ? m_tension : lastForce(), dt);
	m_tensionDamping = rows.m_damping.getSum();
	motion.m_isInner = kind.m_share < 1;
	// In whole steps waves may grow in what is taut.
	motion.m_keepsSwings = kind.m_keepsSwings && (motion.m_isInner || m_tensionDamping == 0);
	rows.m_numRows = getNumPlainRows();
	rows.m_numFibres = 0;
	rows.m_coupledShear[0] = rows.m_coupledShear[1] = -1;
	const bool hasOtherPast = motion.m_keepsSwings && !(MeanForce::tauOfWaves(dt, m_model.m_state.m_lastStep) > 0);
	for (int r = 0; r < rows.m_numRows; ++r)
	{
		JointRows::Row& row = rows.m_row[r];
		row.m_dof = m_row[r].m_dof;
		const btVector3& axis = k.m_axis[row.m_dof % 3];
		row.m_diagonal = row.m_dof < 3 ? diagonal.along(k.armA(row.m_dof).cross(axis), k.armB(row.m_dof).cross(axis))
									   : diagonal.about(axis);
		m_row[r].m_isOfWaves = motion.m_keepsSwings && carriesWaves(r, row.m_diagonal);
		m_row[r].m_isAtRest = hasOtherPast && isAtRest(r);
		row.m_bound = m_lastBound[row.m_dof];
		row.m_partner = -1;
		row.m_coupling = 0;
	}
	m_areAlike = !motion.m_keepsSwings && areAlike();
	if (m_areAlike)
		makeRowsAlike(erp, rows);
	else
		makeRows(erp, rows);
	if (m_usesFibres)
	{
		motion.m_tau = tauOfFibres(hasOtherPast);
		makeFibres(motion, diagonal, rows);
		takeScheme();
	}
	return true;
}

/// By which the step's tension is foreseen.
const btScalar* JointStep::lastForce() const
{
	return m_model.m_isByMode ? m_model.m_state.m_applied : m_model.m_state.m_force;
}

bool JointStep::foreseeTension()
{
	if (m_numRows == 0 || m_model.m_isPaper)
		return false;
	btScalar force[3] = {0, 0, 0}, now = 0, before = 0;
	for (int r = 0; r < m_numRows; ++r)
		if (m_row[r].m_dof < 3)
			force[m_row[r].m_dof] = m_row[r].m_impulse / m_dt;
	for (int i = 0; i < 3; ++i)
	{
		now += force[i] * force[i];
		before += lastForce()[i] * lastForce()[i];
	}
	// Most forces are what they were.
	if (!(now > 4 * before))
		return false;
	const btScalar damping = TensionDamping::of(m_model, m_kinematics, force, m_dt).getSum();
	const bool isRope = m_model.bendingWithinARadian() * m_dt * m_dt < damping * btScalar(0.05);
	if (!(damping > 2 * m_tensionDamping) || !(isRope || m_model.m_state.m_lastStep == 0))
		return false;
	for (int i = 0; i < 3; ++i)
		m_tension[i] = force[i];
	m_isTensionKnown = true;
	return true;
}
}  // namespace btElasticPlastic
