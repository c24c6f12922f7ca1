// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The end of a joint's step: from impulses and bounds to the next state.

#include "JointStep.h"

#include <math.h>

#include "BodyGate.h"
#include "BodyLoad.h"
#include "JoinedVelocity.h"

namespace btElasticPlastic
{
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
		const btScalar spin = spinOf(body).length() + (m_hasRecovery ? m_recoverySpin[side] : btScalar(0));
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
