// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What a joint's step takes and gives, stores and dissipates.

#include "JointStep.h"

#include <math.h>

#include "BodyLoad.h"

namespace btElasticPlastic
{
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
}  // namespace btElasticPlastic
