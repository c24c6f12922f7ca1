// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "SpringLanes.h"

#include "../../btElasticPlasticCapacity.h"
#include "../../btElasticPlasticState.h"

namespace btElasticPlastic
{
namespace
{
/// The degrees of freedom of a pair that may be coupled: a shear, and the bending in its plane.
void findPair(int pair, int dofs[2])
{
	dofs[0] = BT_EP_SHEAR_Y + pair;
	dofs[1] = btElasticPlasticCapacity::coupledWith(dofs[0]);
}
}  // namespace

bool SpringLanes::areSprings(const btElasticPlasticCapacity& capacity)
{
	bool are = true;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		are &= capacity.isElasticPlastic(i) && !capacity.isRigidPlastic(i);
	return are;
}

SpringLanes::SpringLanes(const btElasticPlasticCapacity& capacity, const btElasticPlasticState& state,
						 const MaterialDamping& damping, const btScalar strain[BT_EP_DOF_COUNT],
						 const btScalar yield[BT_EP_DOF_COUNT], bool areCoupled)
	: m_stiffening(damping.isNone() ? btScalar(0) : damping.getStiffening())
{
	m_stiffness.load(capacity.m_stiffness);
	m_yield.load(yield);
	m_strain.load(strain);
	m_force.load(state.m_force);
	m_forceRate.load(state.m_forceRate);
	m_carried.fill(0);
	if (!damping.isNone())
	{
		// In the order of MaterialDamping::addTo().
		for (int i = 0; i < Lanes::COUNT; ++i)
			m_carried[i] = -m_stiffening * m_force[i];
		for (int b = 0; b < MaterialDamping::BRANCHES; ++b)
		{
			Lanes branch;
			branch.load(state.m_branch[b]);
			const btScalar kept = damping.getKept(b);
			for (int i = 0; i < Lanes::COUNT; ++i)
			{
				m_carried[i] += kept * branch[i];
				m_force[i] += branch[i];
			}
		}
	}
	for (int pair = 0; pair < 2; ++pair)
		m_coupling[pair] = areCoupled && capacity.m_coupling[pair] != 0
							   ? capacity.couplingCompliance(BT_EP_SHEAR_Y + pair)
							   : btScalar(0);
}

inline DofState SpringLanes::at(int i) const
{
	return {m_stiffness[i], m_yield[i], m_strain[i], m_force[i], m_forceRate[i], {0, 0}, m_stiffening, m_carried[i]};
}

void SpringLanes::makeRows(const Lanes& diagonal, btScalar dt, btScalar lastStep, Rows& rows) const
{
	Lanes a, alpha, known;
	for (int i = 0; i < Lanes::COUNT; ++i)
		a[i] = m_stiffness[i] * dt * dt * diagonal[i];
	// A pair has one scheme, that of the stiffer one.
	for (int pair = 0; pair < 2; ++pair)
	{
		if (m_coupling[pair] == 0)
			continue;
		int dofs[2];
		findPair(pair, dofs);
		btScalar own[2];
		for (int k = 0; k < 2; ++k)
			own[k] = m_stiffness[dofs[k]] * diagonal[dofs[k]] * (dt * dt);
		a[dofs[0]] = a[dofs[1]] = btMax(own[0], own[1]);
	}
	// Loops of their own: compilers would make branches of what may not be needed, and take apart what is often the same.
	Lanes ofStiff, ofSoft, damping;
	for (int i = 0; i < Lanes::COUNT; ++i)
	{
		ofStiff[i] = MeanForce::shareOfStiff(a[i]);
		ofSoft[i] = MeanForce::shareOfSoft(a[i]);
	}
	const btScalar change = MeanForce::changeOf(dt, lastStep);
	for (int i = 0; i < Lanes::COUNT; ++i)
		damping[i] = MeanForce::dampingOf(MeanForce::isStiff(a[i]) ? ofStiff[i] : ofSoft[i], change);
	for (int i = 0; i < Lanes::COUNT; ++i)
	{
		const DofState s = at(i);
		const MeanForce mean = MeanForce::byRow(damping[i]);
		const SoftRow row = implicitRow(s, mean, a[i], dt);
		alpha[i] = mean.m_alpha;
		known[i] = mean.known(s, dt);
		rows.m_compliance[i] = row.m_compliance;
		rows.m_velocity[i] = row.m_velocity;
		rows.m_lower[i] = row.m_lower;
		rows.m_upper[i] = row.m_upper;
	}
	for (int pair = 0; pair < 2; ++pair)
	{
		rows.m_coupling[pair] = 0;
		if (m_coupling[pair] == 0)
			continue;
		int dofs[2];
		findPair(pair, dofs);
		// As coupledRows().
		const btScalar share = alpha[dofs[0]] * (1 + m_stiffening);
		for (int k = 0; k < 2; ++k)
		{
			const int other = dofs[1 - k];
			rows.m_velocity[dofs[k]] +=
				m_coupling[pair] * (known[other] + alpha[other] * m_carried[other]) / (share * dt);
		}
		rows.m_coupling[pair] = m_coupling[pair] / (share * dt * dt);
	}
}

bool SpringLanes::mapElastic(const Lanes& trial, Lanes& force) const
{
	Lanes whole;  // with what the material's damping adds
	for (int i = 0; i < Lanes::COUNT; ++i)
		whole[i] = at(i).forceAt(trial[i]);
	for (int pair = 0; pair < 2; ++pair)
	{
		if (m_coupling[pair] == 0)
			continue;
		int dofs[2];
		findPair(pair, dofs);
		// As returnMapCoupled().
		const CoupledPair<btScalar> both = {{1 / m_stiffness[dofs[0]], 1 / m_stiffness[dofs[1]]}, m_coupling[pair]};
		btScalar strains[2];
		for (int k = 0; k < 2; ++k)
			strains[k] = (1 + m_stiffening) * trial[dofs[k]] + both.m_compliance[k] * m_carried[dofs[k]] +
						 both.m_coupling * m_carried[dofs[1 - k]];
		both.free(strains, &whole[dofs[0]], &whole[dofs[1]]);
	}
	for (int i = 0; i < Lanes::COUNT; ++i)
		force[i] = at(i).springForce(whole[i]);
	int numBeyond = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		numBeyond += int(!(btFabs(whole[i]) <= m_yield[i])) + int(!(m_yield[i] > 0));
	return numBeyond == 0;
}
}  // namespace btElasticPlastic
