// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "JointStep.h"

#include <math.h>

#include "BodyGate.h"
#include "BodyLoad.h"
#include "Diagonal.h"

namespace btElasticPlastic
{
namespace
{
/// Steps of this share of the world's step and less are those of a blow. With a sixteenth, plates that ring after one would take twice the steps.
const btScalar SHARE_OF_A_BLOW = btScalar(1) / 32;
/// Below this square of frequency times step a row is by row in them, too: that damps its own swing by 0.4 % of the critical.
const btScalar WELL_RESOLVED = btScalar(0.1);
/// What a row has done before a blow does not count below this share of what it does in the first step.
const btScalar SHARE_AT_REST = btScalar(1e-3);
/// The least and the most that bodies turn by as one in a step for that to be left out of what the step leaves open [rad]: of less there is nothing to be left out.
const btScalar LEAST_TURN_AS_ONE = btScalar(1e-6), MOST_TURN_AS_ONE = btScalar(0.35);
}  // namespace

// ---- pose and step -> rows

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
		linear += A.getVelocityInLocalPoint(m_kinematics.m_rA);
		angular += A.getAngularVelocity();
	}
	if (B.isKinematicObject())
	{
		linear -= B.getVelocityInLocalPoint(m_kinematics.m_rB);
		angular -= B.getAngularVelocity();
	}
	btScalar moved[BT_EP_DOF_COUNT];
	m_kinematics.projectMotion(linear, angular, moved);
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		m_kinematics.m_strain[i] += m_dt * moved[i];
}

bool JointStep::evaluate(btScalar dt)
{
	m_model.measure(m_kinematics);
	if (!m_kinematics.isUsable() || !(dt > 0) || !btElasticPlasticIsFinite(dt))
	{
		revert();
		return false;
	}
	btScalar velocity[BT_EP_DOF_COUNT];
	projectVelocities(velocity);
	m_spin0[0] = m_model.bodyA().getAngularVelocity();
	m_spin0[1] = m_model.bodyB().getAngularVelocity();
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

/// Whether the past of what fibres add up to is as of steps of this length.
bool JointStep::areFibresEven(bool hasOtherPast)
{
	bool areAtRest = hasOtherPast;
	for (int r = getNumPlainRows(); r < m_numRows && areAtRest; ++r)
		areAtRest = isAtRest(r);
	for (int r = getNumPlainRows(); r < m_numRows; ++r)
		m_row[r].m_isAtRest = areAtRest;
	return areAtRest || lastStep() == m_dt;
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

bool JointStep::begin(btScalar dt, btScalar erp, btScalar share, JointRows& rows)
{
	if (m_numRows == 0 || !evaluate(dt))
		return false;
	const Kinematics& k = rows.m_kinematics = m_kinematics;
	const Diagonal diagonal(m_model.bodyA(), m_model.bodyB());
	FibreStep::Motion motion = {};
	if (m_usesFibres)
		motion = beginShear(diagonal);
	motion.m_isInner = share < 1;
	motion.m_isOfBlow = share <= SHARE_OF_A_BLOW;
	rows.m_numRows = getNumPlainRows();
	rows.m_numFibres = 0;
	rows.m_coupledShear[0] = rows.m_coupledShear[1] = -1;
	const bool isOfBlow = motion.m_isOfBlow, hasOtherPast = isOfBlow && m_model.m_state.m_lastStep != dt;
	for (int r = 0; r < rows.m_numRows; ++r)
	{
		JointRows::Row& row = rows.m_row[r];
		row.m_dof = m_row[r].m_dof;
		const btVector3& axis = k.m_axis[row.m_dof % 3];
		row.m_diagonal = row.m_dof < 3 ? diagonal.along(k.armA(row.m_dof).cross(axis), k.armB(row.m_dof).cross(axis))
									   : diagonal.about(axis);
		m_row[r].m_isOfWaves = isOfBlow && carriesWaves(r, row.m_diagonal);
		m_row[r].m_isAtRest = hasOtherPast && isAtRest(r);
		row.m_bound = m_lastBound[row.m_dof];
		row.m_partner = -1;
		row.m_coupling = 0;
	}
	m_areAlike = !isOfBlow && areAlike();
	if (m_areAlike)
		makeRowsAlike(erp, rows);
	else
		makeRows(erp, rows);
	if (m_usesFibres)
	{
		motion.m_isEven = areFibresEven(hasOtherPast);
		makeFibres(motion, diagonal, rows);
		takeScheme();
	}
	if (m_model.m_isPaper)
		rows.m_damping = TensionDamping();
	else
		rows.m_damping = TensionDamping::of(m_model, k, m_isTensionKnown ? m_tension : lastForce(), dt);
	m_tensionDamping = rows.m_damping.getSum();
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

// ---- impulses and bounds -> the next state

void JointStep::getLoad(btVector3& force, btVector3& torque) const
{
	btVector3 sum[2] = {btVector3(0, 0, 0), btVector3(0, 0, 0)};
	for (int r = 0; r < m_numRows; ++r)
	{
		const btVector3 own = m_kinematics.m_axis[m_row[r].m_dof % 3] * m_row[r].m_impulse;
		sum[m_row[r].m_dof / 3] += own;
		if (m_row[r].m_dof == BT_EP_AXIAL)
			sum[1] += m_kinematics.armOfBow().cross(own);
	}
	force = sum[0] / m_dt;
	torque = sum[1] / m_dt;
}

void JointStep::setSolution(const double* impulses, const signed char* bounds)
{
	const int numPlain = getNumPlainRows();
	for (int r = 0; r < numPlain; ++r)
		setImpulse(r, btScalar(impulses[r]), bounds ? bounds[r] : 0);
	if (!m_usesFibres)
		return;
	btScalar resultant[3];
	m_fibres.setSolution(impulses + numPlain, bounds ? bounds + numPlain : nullptr, m_isCut, resultant);
	for (int k = 0; k < 3; ++k)
		setImpulse(numPlain + k, resultant[k], 0);
}

void JointStep::setFibres(const double* impulses, const signed char* bounds)
{
	btScalar resultant[3];
	m_fibres.setSolution(impulses, bounds, false, resultant);
}

void JointStep::setRecovery(const btVector3 linear[2], const btVector3 angular[2])
{
	m_hasRecovery = true;
	for (int side = 0; side < 2; ++side)
		m_recoverySpin[side] = angular[side].length();
	m_kinematics.projectMotion(
		linear[0] + angular[0].cross(m_kinematics.m_rA) - linear[1] - angular[1].cross(m_kinematics.m_rB),
		angular[0] - angular[1], m_recovery);
}

RowOutcome JointStep::outcomeOf(int r) const
{
	const Row& row = m_row[r];
	RowOutcome outcome;
	outcome.m_impulse = row.m_impulse;
	outcome.m_lower = row.m_lower;
	outcome.m_upper = row.m_upper;
	outcome.m_trial = trialOf(r);
	outcome.m_bound = m_lastBound[row.m_dof];
	outcome.m_isBoundKnown = row.m_isBoundKnown;
	outcome.m_isForStock = row.m_isForStock;
	return outcome;
}

ReturnMapping JointStep::returnMap(int r) const
{
	const Row& row = m_row[r];
	const DofState s = dofState(r);
	const RowOutcome outcome = outcomeOf(r);
	if (m_model.m_capacity.isRigidPlastic(row.m_dof))
		return rigidReturnMap(outcome.m_impulse, outcome.m_trial, outcome.isAtBound(outcome.side(), s.m_yield * m_dt),
							  m_dt);
	if (m_model.m_isPaper)
		return paperLaw(row.m_dof).returnMap(s, outcome, m_dt);
	return row.m_isForStock ? stockReturnMap(s, outcome, m_dt)
							: btElasticPlastic::returnMap(s, meanForce(r, 0), outcome, m_dt);
}

/// As returnMap(), of a row and the one with which it is coupled.
void JointStep::returnMapPair(int r, ReturnMapping mapped[BT_EP_DOF_COUNT]) const
{
	const int pair[2] = {r, m_row[r].m_partner};
	const DofState states[2] = {dofState(pair[0]), dofState(pair[1])};
	const RowOutcome outcomes[2] = {outcomeOf(pair[0]), outcomeOf(pair[1])};
	ReturnMapping both[2];
	returnMapCoupled(states, meanForce(r, 0), m_row[r].m_coupling, outcomes, m_dt, both);
	for (int i = 0; i < 2; ++i)
		mapped[pair[i]] = both[i];
}

/// Maps springs that are alike while none of them flows.
/// \return false if they are not, or one does: then each row has to be mapped by itself
bool JointStep::mapAlike(const btScalar velocity1[BT_EP_DOF_COUNT], ReturnMapping mapped[BT_EP_DOF_COUNT]) const
{
	// What the joint is may have been changed since the step began.
	if (!m_areAlike || !m_row[0].m_isBoundKnown || !areAlike())
		return false;
	Lanes trial, velocity, force;
	trial.load(m_kinematics.m_strain);
	velocity.load(velocity1);
	for (int i = 0; i < Lanes::COUNT; ++i)
		trial[i] -= m_dt * velocity[i];
	if (!findSprings().mapElastic(trial, force))
		return false;
	for (int r = 0, numPlain = getNumPlainRows(); r < numPlain; ++r)
		mapped[r] = {force[m_row[r].m_dof], 0};
	return true;
}

/// Maps all rows but those of fibres one by one.
void JointStep::mapRows(bool isCut, ReturnMapping mapped[BT_EP_DOF_COUNT]) const
{
	for (int r = 0, numPlain = getNumPlainRows(); r < numPlain; ++r)
	{
		if (isCut)
			mapped[r] = mapCut(r);
		else if (m_row[r].m_partner < 0)
			mapped[r] = returnMap(r);
		else if (r < m_row[r].m_partner)
			returnMapPair(r, mapped);
	}
}

/// The spring's force after a search that has been cut, within the bound what it makes with the branches by which the material damps.
btScalar JointStep::cutForce(int r) const
{
	const Row& row = m_row[r];
	const DofState s = dofState(r);
	const btScalar force = s.withinYield(row.m_impulse / m_dt);
	return m_model.m_capacity.isRigidPlastic(row.m_dof) ? force : s.springForce(force);
}

/// What a search that has been cut leaves: a force that is less than the deformation's. The deformation beyond it is plastic where the
/// row flows, with this force's work; elsewhere it is given up, so that no energy is stored that nobody has given.
ReturnMapping JointStep::mapCut(int r) const
{
	const Row& row = m_row[r];
	const RowOutcome outcome = outcomeOf(r);
	ReturnMapping mapped;
	mapped.m_force = cutForce(r);
	btScalar beyond = outcome.m_trial;
	if (!m_model.m_capacity.isRigidPlastic(row.m_dof))
		beyond -= mapped.m_force / m_model.m_capacity.m_stiffness[row.m_dof];
	if (row.m_partner >= 0)
		beyond -= row.m_coupling * cutForce(row.m_partner);
	const bool flows = outcome.m_bound != 0 && beyond * mapped.m_force > 0;
	mapped.m_increment = flows ? beyond : btScalar(0);
	mapped.m_unloaded = flows || m_model.m_capacity.isRigidPlastic(row.m_dof) ? btScalar(0) : beyond;
	return mapped;
}

/// Flow that a search which has been cut leaves is plastic as far as the bodies have given for it, in this step beyond what the springs have
/// gained, and in all beyond what they hold. The rest is given up.
/// \param work  taken from the bodies since the joint was new [J]
void JointStep::limitFlow(double work, ReturnMapping mapped[BT_EP_DOF_COUNT]) const
{
	double flow = 0, had = 0, holds = 0;
	for (int r = 0; r < m_numRows; ++r)
	{
		const int i = m_row[r].m_dof;
		const ReturnMapping& m = mapped[r];
		flow += fabs(double(m.m_force) * double(m.m_increment));
		if (m_model.m_capacity.isRigidPlastic(i))
			continue;
		const btScalar elastic = outcomeOf(r).m_trial - m.m_increment - m.m_unloaded;
		had += 0.5 * double(m_model.m_state.m_force[i]) * double(m_model.elasticDeformation(i));
		holds += 0.5 * double(m.m_force) * double(elastic);
	}
	const double most = fmax(fmin(work - m_model.m_state.m_work + had, work - m_model.dissipatedEnergy()) - holds, 0);
	if (!(flow > most))
		return;
	const btScalar share = btScalar(most / flow);
	for (int r = 0; r < m_numRows; ++r)
	{
		mapped[r].m_unloaded += (1 - share) * mapped[r].m_increment;
		mapped[r].m_increment *= share;
	}
}

/// The share of the step's flow by which the joint's ductility is spent: it bears nothing that comes later. 1: all of it, the joint holds.
/// Fibres have taken their damage already.
btScalar JointStep::shareUntilBreak(const ReturnMapping mapped[]) const
{
	btScalar damage = 0;
	for (int r = 0, numPlain = getNumPlainRows(); r < numPlain; ++r)
		damage += btFabs(mapped[r].m_increment) / m_model.m_capacity.m_ductility[m_row[r].m_dof];
	if (damage == 0)
		return 1;
	// Rounded up, so that the sum is not a little less than 1.
	const btScalar left = 1 + 8 * SIMD_EPSILON - m_model.damage();
	return damage >= left ? btMax(left, btScalar(0)) / damage : btScalar(1);
}

/// Twice the work of the step's impulses on the bodies: that of each is exactly impulse times mean velocity. It is finite only if all
/// of them are.
/// \param velocity1  J v at the end of the step, of all degrees of freedom
/// \param spin1      the relative angular velocity then
double JointStep::twiceWork(const btScalar velocity1[BT_EP_DOF_COUNT], const btVector3& spin1) const
{
	double work = double(m_dampingImpulse.dot(m_spin0[0] - m_spin0[1] + spin1));
	for (int r = 0; r < m_numRows; ++r)
		work += double(m_row[r].m_impulse) * (double(m_row[r].m_velocity0) + double(velocity1[m_row[r].m_dof]));
	return work;
}

/// Maps the fibres, and what they add up to, the last three rows. After a search that has been cut all flow is given up: what the bodies
/// have given for it is not known by fibre.
FibreStep::Outcome JointStep::commitFibres(ReturnMapping mapped[BT_EP_DOF_COUNT])
{
	btScalar trial[BT_EP_DOF_COUNT];
	RowOutcome outcomes[2];
	const RowOutcome* shears[2] = {};
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		trial[i] = m_kinematics.m_strain[i];
	for (int r = 0; r < m_numRows; ++r)
	{
		const int dof = m_row[r].m_dof, shear = dof - BT_EP_SHEAR_Y;
		trial[dof] = trialOf(r);
		if (shear != 0 && shear != 1)
			continue;
		outcomes[shear] = outcomeOf(r);
		shears[shear] = &outcomes[shear];
	}
	const FibreStep::Outcome outcome = m_fibres.commit(trial, shears, m_isCut);
	const int numPlain = getNumPlainRows();
	for (int r = 0; r < numPlain; ++r)
	{
		const int shear = m_row[r].m_dof - BT_EP_SHEAR_Y;
		if ((shear == 0 || shear == 1) && outcome.m_isCoupled[shear])
			mapped[r] = outcome.m_shear[shear];
		if (!m_isCut)
			continue;
		mapped[r].m_unloaded += mapped[r].m_increment;
		mapped[r].m_increment = 0;
	}
	for (int k = 0; k < 3; ++k)
		mapped[numPlain + k] = {outcome.m_force[k], outcome.m_increment[k]};
	return outcome;
}

void JointStep::projectVelocities(btScalar onAxes[BT_EP_DOF_COUNT]) const
{
	const btRigidBody &A = m_model.bodyA(), &B = m_model.bodyB();
	m_kinematics.projectMotion(
		A.getVelocityInLocalPoint(m_kinematics.m_rA) - B.getVelocityInLocalPoint(m_kinematics.m_rB),
		A.getAngularVelocity() - B.getAngularVelocity(), onAxes);
}

bool JointStep::projectMotion(btScalar before[BT_EP_DOF_COUNT], btScalar after[BT_EP_DOF_COUNT]) const
{
	projectVelocities(after);
	return findMotion(m_numRows, before, after);
}

void JointStep::getMotion(btScalar before[BT_EP_DOF_COUNT], btScalar after[BT_EP_DOF_COUNT]) const
{
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		after[i] = 0;
	for (int r = 0; r < m_numCommittedRows; ++r)
		after[m_row[r].m_dof] = m_row[r].m_velocity1;
	findMotion(m_numCommittedRows, before, after);
}

/// \return whether anything flows
bool JointStep::findMotion(int numRows, btScalar before[BT_EP_DOF_COUNT], btScalar after[BT_EP_DOF_COUNT]) const
{
	bool flows = false;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		before[i] = 0;
	for (int r = 0; r < numRows; ++r)
	{
		before[m_row[r].m_dof] = m_row[r].m_velocity0;
		flows |= isFlowing(r);
	}
	if (!flows)
		leaveTurnOut(before, after);
	return flows;
}

/// Where bodies turn as one, they part at some rate as a step begins, twice as fast if nobody has held them on their circles in the last one, and close by as much in it; but for
/// a share of a turn in any direction. A turn that a blow gives or takes is none, and one that is too fast hides what a blow does.
void JointStep::leaveTurnOut(btScalar before[BT_EP_DOF_COUNT], btScalar after[BT_EP_DOF_COUNT]) const
{
	const auto lasting = [](const btVector3& one, const btVector3& other)
	{ return one.length2() < other.length2() ? one : other; };
	const btVector3 spins[2] = {lasting(m_spin0[0], m_model.bodyA().getAngularVelocity()),
								lasting(m_spin0[1], m_model.bodyB().getAngularVelocity())};
	const btScalar turn = m_dt * btSqrt(btMax(spins[0].length2(), spins[1].length2()));
	if (turn < LEAST_TURN_AS_ONE || turn > MOST_TURN_AS_ONE)
		return;
	const auto towardsMiddle = [](const btVector3& spin, const btVector3& arm) { return spin.cross(spin.cross(arm)); };
	const btVector3 parting =
		(towardsMiddle(spins[0], m_kinematics.m_rA) - towardsMiddle(spins[1], m_kinematics.m_rB)) * (m_dt / 2);
	const btScalar beside = turn * parting.length();
	btScalar ofTurn[BT_EP_DOF_COUNT];
	m_kinematics.projectMotion(parting, btVector3(0, 0, 0), ofTurn);
	const auto without = [&](btScalar rate, int dof, btScalar times)
	{
		const btScalar most = times * ofTurn[dof], slack = btFabs(times) * beside;
		return rate - btClamped(rate, btMin(most, btScalar(0)) - slack, btMax(most, btScalar(0)) + slack);
	};
	for (int i = BT_EP_AXIAL; i <= BT_EP_SHEAR_Z; ++i)
	{
		before[i] = without(before[i], i, 2);
		after[i] = without(after[i], i, -1);
	}
}

/// J v of all degrees of freedom, and the relative angular velocity, with which the bodies were moved: other actions may have changed
/// the present velocities already.
void JointStep::projectEnd(btScalar onAxes[BT_EP_DOF_COUNT], btVector3& spin) const
{
	const Kinematics& k = m_kinematics;
	const btRigidBody &A = m_model.bodyA(), &B = m_model.bodyB();
	// Bullet does not move what is static or frozen, and leaves it the velocities of its last motion.
	const btVector3 still(0, 0, 0);
	const auto moves = [](const btRigidBody& body)
	{ return (!body.isStaticObject() || body.isKinematicObject()) && !isFrozen(body); };
	const auto spinOf = [&](const btRigidBody& body)
	{ return moves(body) ? body.getInterpolationAngularVelocity() : still; };
	const auto velocityOf = [&](const btRigidBody& body)
	{ return moves(body) ? body.getInterpolationLinearVelocity() : still; };
	const btVector3 wA = spinOf(A), wB = spinOf(B);
	spin = wA - wB;
	k.projectMotion(velocityOf(A) + wA.cross(k.m_rA) - velocityOf(B) - wB.cross(k.m_rB), spin, onAxes);
}

/// Whether a joint can go on from what the step has left. One of Bullet's own solvers may have made nothing finite of it.
/// \param work  taken from the bodies since the joint was new
bool JointStep::isUsable(double work) const
{
	const btScalar rate = 1 / m_dt, most = btElasticPlasticCapacity::greatestYield();
	Lanes trial, moved, impulse, yield, stiffness, sums, isBeyond;
	yield.load(m_model.m_capacity.m_yield);
	stiffness.load(m_model.m_capacity.m_stiffness);
	for (Lanes* lanes : {&trial, &moved, &impulse})
		lanes->fill(0);
	for (int r = 0; r < m_numRows; ++r)
	{
		const int dof = m_row[r].m_dof;
		trial[dof] = trialOf(r);
		impulse[dof] = m_row[r].m_impulse;
	}
	if (m_hasRecovery)
		moved.load(m_recovery);
	for (int i = 0; i < Lanes::COUNT; ++i)
	{
		const btScalar way = btFabs(trial[i]), further = btFabs(moved[i]), full = stiffness[i] * way;
		// The force at the end of the step, its rate, and the energy of its flow are not above these.
		const btScalar spring = yield[i] < full ? yield[i] : full,
					   forceRate = (btFabs(impulse[i] * rate) + spring) * rate;
		sums[i] = way + further + forceRate;
		const bool isWithin =
			(way < btScalar(BT_LARGE_FLOAT)) & (further < btScalar(BT_LARGE_FLOAT)) & (forceRate <= most);
		isBeyond[i] = isWithin ? btScalar(0) : btScalar(1);
	}
	bool isBounded = true;
	double sum = work;  // a number only if all of them are
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		sum += double(sums[i]);
		isBounded &= isBeyond[i] == 0;
	}
	for (const btRigidBody* body : {&m_model.bodyA(), &m_model.bodyB()})
	{
		const btVector3 force = forceBesideWeight(*body).absolute(), torque = body->getTotalTorque().absolute();
		for (int k = 0; k < 3; ++k)
		{
			sum += double(force[k]) + double(torque[k]);
			isBounded &= force[k] <= most && torque[k] <= most;
		}
	}
	return isBounded && btElasticPlasticIsFinite(sum);
}

/// Ends the step of the branches by which the material damps, and books what they have dissipated.
/// \param change  of the springs' forces in the step, 0 where there is none
/// \param fibres  what has become of theirs, of a joint whose fibres are in the step
void JointStep::damp(const btScalar change[BT_EP_DOF_COUNT], const FibreStep::Outcome& fibres)
{
	btElasticPlasticState& state = m_model.m_state;
	if (m_damping.isNone() || m_model.m_isPaper || (!m_usesFibres && m_row[0].m_isForStock))
	{
		for (auto& branch : state.m_branch)
			for (btScalar& q : branch)
				q = 0;
		return;
	}
	state.m_dampingEnergy += fibres.m_lost;
	const btScalar rate = 1 / m_dt;
	btScalar coupling[2] = {};
	Lanes changes, compliance, forceRate;
	changes.load(change);
	forceRate.load(state.m_forceRate);
	compliance.fill(0);
	for (int r = 0, numPlain = getNumPlainRows(); r < numPlain; ++r)
	{
		const int i = m_row[r].m_dof;
		compliance[i] = m_model.m_capacity.isRigidPlastic(i) ? btScalar(0) : 1 / m_model.m_capacity.m_stiffness[i];
		if (m_row[r].m_partner >= 0 && i < 3)
			coupling[i - BT_EP_SHEAR_Y] = m_row[r].m_coupling;
	}
	for (int i = BT_EP_SHEAR_Y; i <= BT_EP_SHEAR_Z && (fibres.m_isCoupled[0] || fibres.m_isCoupled[1]); ++i)
		coupling[i - BT_EP_SHEAR_Y] = m_model.m_capacity.couplingCompliance(i);
	for (int b = 0; b < MaterialDamping::BRANCHES; ++b)
	{
		Lanes before, q;
		before.load(state.m_branch[b]);
		const btScalar kept = m_damping.getKept(b), taken = m_damping.getTaken(b);
		for (int i = 0; i < Lanes::COUNT; ++i)
			q[i] = kept * before[i] + taken * changes[i];
		if (m_usesFibres)
		{
			q[BT_EP_AXIAL] = btScalar(fibres.m_branch[b].m_axial);
			q[BT_EP_BENDING_Y] = btScalar(fibres.m_branch[b].m_momentY);
			q[BT_EP_BENDING_Z] = btScalar(fibres.m_branch[b].m_momentZ);
		}
		q.store(state.m_branch[b]);
		double of[Lanes::COUNT];
		for (int i = 0; i < Lanes::COUNT; ++i)
		{
			const double was = before[i], is = q[i];
			of[i] = double(compliance[i]) * (was * (was + is) + is * is);
			forceRate[i] += (q[i] - before[i]) * rate;
		}
		double squares = fibres.m_squares[b];  // q0^2 + q0 q1 + q1^2, over k
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			squares += of[i];
		for (int i = BT_EP_SHEAR_Y; i <= BT_EP_SHEAR_Z; ++i)
		{
			if (coupling[i - BT_EP_SHEAR_Y] == 0)
				continue;
			const int bending = btElasticPlasticCapacity::coupledWith(i);
			const double was[2] = {before[i], before[bending]}, is[2] = {q[i], q[bending]};
			squares += double(coupling[i - BT_EP_SHEAR_Y]) *
					   (was[0] * (was[1] + is[1]) + was[1] * (was[0] + is[0]) + 2 * is[0] * is[1]);
		}
		if (squares > 0)
			state.m_dampingEnergy += squares * double(m_damping.getLoss(b)) / 3;
	}
	forceRate.store(state.m_forceRate);
}

double JointStep::getLoan() const
{
	double loan = 0;
	for (int r = 0; r < m_numRows; ++r)
	{
		const int dof = m_row[r].m_dof;
		if (!m_model.m_capacity.isRigidPlastic(dof))
			continue;
		// The pair of bodies is set in motion to close the gap.
		const btRigidBody &A = m_model.bodyA(), &B = m_model.bodyB();
		const btVector3& axis = m_kinematics.m_axis[dof % 3];
		const double velocity = double(m_erp * m_kinematics.m_strain[dof] / m_dt);
		const btVector3 turning = A.getInvInertiaTensorWorld() * axis + B.getInvInertiaTensorWorld() * axis;
		const double mobility = double(dof < 3 ? A.getInvMass() + B.getInvMass() : axis.dot(turning));
		if (mobility > 0)
			loan += 0.5 * velocity * velocity / mobility;
	}
	return loan;
}

/// What it takes to bring the joint to a strain, flow included [J].
double JointStep::strainEnergy(const btScalar strains[BT_EP_DOF_COUNT]) const
{
	double energy = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		const double stiffness = double(m_model.m_capacity.m_stiffness[i]),
					 yield = double(m_model.m_capacity.m_yield[i]);
		if (!m_model.isElasticPlastic(i) || m_model.m_capacity.isRigidPlastic(i) || !(stiffness > 0))
			continue;
		const double strain = fabs(double(strains[i])), elastic = fmin(strain, yield / stiffness);
		energy += 0.5 * stiffness * elastic * elastic + (strain > elastic ? yield * (strain - elastic) : 0);
	}
	return fmin(energy, btElasticPlasticCapacity::unlimited());
}

double JointStep::getStored() const
{
	const btElasticPlasticState& state = m_model.m_state;
	if (state.m_lastStep == 0)
		return strainEnergy(m_kinematics.m_strain);
	if (state.m_solvedExactly)
		return m_model.springEnergy();
	const double had = state.m_storedEnergy;
	if (state.m_placeEnergy < 0 || m_model.bodyA().isKinematicObject() || m_model.bodyB().isKinematicObject())
		return had;
	btScalar ofPlace[BT_EP_DOF_COUNT];
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		ofPlace[i] = m_kinematics.m_strain[i] + m_withheld[i];
	return had + fmax(strainEnergy(ofPlace) - state.m_placeEnergy, 0);
}

double JointStep::measureWork() const
{
	btVector3 spin;
	btScalar velocity[BT_EP_DOF_COUNT];
	projectEnd(velocity, spin);
	return 0.5 * twiceWork(velocity, spin);
}

double JointStep::getHalfStep() const
{
	double most = 0;
	for (int r = 0; r < m_numCommittedRows; ++r)
		most += 0.5 * fabs(double(m_row[r].m_impulse) * double(m_row[r].m_velocity1));
	return most;
}

void JointStep::rememberPlace()
{
	Kinematics now;
	m_model.measure(now);
	m_model.m_state.m_placeEnergy = strainEnergy(now.m_strain);
}

int JointStep::commit(double share, bool isNew)
{
	m_numCommittedRows = m_numRows;
	if (m_numRows == 0)
		return NOTHING;
	btVector3 spin1;
	btScalar velocity1[BT_EP_DOF_COUNT], increment[BT_EP_DOF_COUNT] = {}, unloaded[BT_EP_DOF_COUNT] = {},
										 change[BT_EP_DOF_COUNT] = {};
	projectEnd(velocity1, spin1);
	btElasticPlasticState& state = m_model.m_state;
	const double work = state.m_work - (m_isWorkKnown ? m_given : 0.5 * twiceWork(velocity1, spin1));
	for (int r = 0, rows = m_numRows; r < rows; ++r)
		m_row[r].m_velocity1 = velocity1[m_row[r].m_dof];
	if (!isUsable(work))
	{
		revert();
		m_numCommittedRows = 0;
		return NOTHING;
	}

	const btScalar rate = 1 / m_dt;
	const double aheadBefore = m_isFree ? m_model.aheadOfWork() : 0;
	bool flowed = false;
	const bool isCut = m_isCut && !m_model.m_isPaper;
	ReturnMapping mappedRows[BT_EP_DOF_COUNT];
	const int numPlain = getNumPlainRows();
	if (isCut || !mapAlike(velocity1, mappedRows))
		mapRows(isCut, mappedRows);
	FibreStep::Outcome fibres;
	if (m_usesFibres)
	{
		fibres = commitFibres(mappedRows);
		state.m_plasticEnergy += fibres.m_plasticEnergy;
		flowed = fibres.m_flowed;
	}
	else if (isCut)
		limitFlow(work, mappedRows);
	const btScalar borne = shareUntilBreak(mappedRows);
	for (int r = 0, rows = m_numRows; r < rows; ++r)
	{
		Row& row = m_row[r];
		const int i = row.m_dof;
		const ReturnMapping& mapped = mappedRows[r];
		const btScalar gained = mapped.m_force - state.m_force[i];
		change[i] = m_model.m_capacity.isRigidPlastic(i) ? btScalar(0) : gained;
		state.m_forceRate[i] = gained * rate;
		state.m_force[i] = mapped.m_force;
		const btScalar applied = row.m_impulse * rate;
		// The mean force of a step of another length is no past of waves.
		state.m_appliedBefore[i] = row.m_isOfWaves && !isEven(r) ? applied : state.m_applied[i];
		state.m_applied[i] = applied;
		unloaded[i] = mapped.m_unloaded - (m_hasRecovery ? m_dt * m_recovery[i] : btScalar(0));
		if (mapped.m_increment == 0)
			continue;
		increment[i] = (r < numPlain ? borne : btScalar(1)) * mapped.m_increment;
		state.m_plastic[i] += increment[i];
		state.m_plasticPath[i] += btFabs(increment[i]);
		if (r >= numPlain)
			continue;
		const double force = isCut ? fabs(double(mapped.m_force)) : double(yieldOf(i));
		state.m_plasticEnergy += force * fabs(double(increment[i]));
		flowed = true;
	}
	const double dampedBefore = state.m_dampingEnergy;
	damp(change, fibres);
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		state.m_withheld[i] = m_withheld[i];
	state.m_withheldStep = m_withheldStep;
	state.m_lastStep = m_dt;
	m_isEven = false;
	for (int side = 0; side < 2; ++side)
	{
		const btRigidBody& body = side == 0 ? m_model.bodyA() : m_model.bodyB();
		const btScalar spin = body.getAngularVelocity().length() + (m_hasRecovery ? m_recoverySpin[side] : btScalar(0));
		state.m_spin[side] = btMin(spin, btScalar(BT_LARGE_FLOAT));
		const btVector3 force = forceBesideWeight(body);
		for (int k = 0; k < 3; ++k)
		{
			state.m_load[side][k] = force[k];
			state.m_load[side][3 + k] = body.getTotalTorque()[k];
		}
	}
	state.m_solvedExactly = m_row[0].m_isBoundKnown;
	state.m_work = work;
	// Springs that a cut search has let go of, or has strained, move their branches as no deformation has done.
	if (isCut)
		state.m_dampingEnergy =
			fmax(fmin(state.m_dampingEnergy, work - state.m_plasticEnergy - m_model.springEnergy()), dampedBefore);
	if (state.m_solvedExactly)
	{
		double power = 0;
		for (int r = 0, rows = m_numRows; r < rows; ++r)
			power -= double(state.m_force[m_row[r].m_dof]) * double(m_row[r].m_velocity1);
		m_model.findOwed(share, isNew, m_dt * power, m_isFree ? &aheadBefore : nullptr);
	}
	revert();
	m_model.moveReference(unloaded);
	if (!m_usesFibres && m_model.usesFibres())
	{
		btScalar damage = 0;
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			if (btElasticPlasticCapacity::isOfFibres(i))
				damage += btFabs(increment[i]) / m_model.m_capacity.m_ductility[i];
		m_model.wearFibres(damage);
		m_model.followFibres();
	}
	if (increment[3] != 0 || increment[4] != 0 || increment[5] != 0)
	{
		const btScalar longer = m_model.turnReference(increment);
		// The step has moved bodies as if all of the turn was about the bow, and what the axial spring would gain by the turn nobody has given: those of
		// a cracked section with a bar on one side would be ten times as fast as they were. Without fibres the axial strain is right however far a hinge
		// turns, see docs/limits.md.
		if (m_usesFibres)
			state.m_initial[BT_EP_AXIAL] += longer;
	}
	m_model.followFreeTurn(m_kinematics);
	if (!flowed)
		return NOTHING;
	const int outcome = state.m_yielded ? NOTHING : YIELDED;
	state.m_yielded = true;
	state.m_broken = borne < 1 || m_model.damage() >= 1;
	return state.m_broken ? outcome | BROKE : outcome;
}
}  // namespace btElasticPlastic
