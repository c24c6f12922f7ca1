// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The six springs of a joint side by side: what the law says of each row, to the bit. By -ffast-math compilers add in another
// order side by side than one by one: there, to the rounding of what is added.

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/SpringLanes.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticCapacity.h"
#include "support/Precision.h"

namespace testSpringLanes
{
using namespace btElasticPlastic;

/// The same number, which is a sum of terms of a size.
void expectSame(btScalar expected, btScalar actual, btScalar terms)
{
#ifdef __FAST_MATH__
	// Some ten terms, each rounded a few times.
	EXPECT_NEAR(expected, actual, terms * 32 * FLOAT_ROUNDING * SIMD_EPSILON);
#else
	(void)terms;
	EXPECT_EQ(expected, actual);
#endif
}

/// A joint as chance has it: soft and stiff springs, with coupled pairs and without, damped or not.
struct AnyJoint
{
	explicit AnyJoint(unsigned seed) : m_random(seed)
	{
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		{
			m_capacity.set(i, power(-3, 9), power(0, 5), btScalar(0.1));
			m_state.m_force[i] = m_capacity.m_yield[i] * between(-1, 1);
			m_state.m_forceRate[i] = m_state.m_force[i] * between(-100, 100);
			for (auto& branch : m_state.m_branch)
				branch[i] = btScalar(0.02) * m_capacity.m_yield[i] * between(-1, 1);
			m_strain[i] = m_state.m_force[i] / m_capacity.m_stiffness[i] * between(btScalar(0.9), btScalar(1.1));
			m_diagonal[i] = power(-4, 2);
		}
		for (btScalar& coupling : m_capacity.m_coupling)
			coupling = seed % 2 ? between(btScalar(-0.9), btScalar(0.9)) : btScalar(0);
		m_dt = 1 / between(30, 240);
		m_lastStep = seed % 3 == 0 ? btScalar(0) : seed % 3 == 1 ? m_dt : m_dt * between(btScalar(0.5), 2);
		m_damping = MaterialDamping(seed % 5 ? btScalar(0.01) : btScalar(0), m_dt);
	}

	btScalar between(btScalar a, btScalar b)
	{
		return a + (b - a) * btScalar(double(m_random()) / double(std::mt19937::max()));
	}
	btScalar power(btScalar a, btScalar b) { return btScalar(std::pow(10., double(between(a, b)))); }

	SpringLanes lanes() const
	{
		return SpringLanes(m_capacity, m_state, m_damping, m_strain.m_at, m_capacity.m_yield, true);
	}

	DofState dofState(int dof) const
	{
		DofState s = {m_capacity.m_stiffness[dof], m_capacity.m_yield[dof],  m_strain[dof],
					  m_state.m_force[dof],        m_state.m_forceRate[dof], {0, 0}};
		m_damping.addTo(s, m_state.m_branch, dof);
		return s;
	}

	/// Size of the deformations whose sum a row's is.
	btScalar deformations(int dof) const
	{
		const int partner = partnerOf(dof);
		const auto forces = [this](int i) { return m_capacity.m_yield[i] + btFabs(m_state.m_forceRate[i] * m_dt); };
		return forces(dof) / m_capacity.m_stiffness[dof] +
			   (partner < 0 ? 0 : btFabs(m_capacity.couplingCompliance(dof)) * forces(partner));
	}

	/// Size of the forces whose sum a row's is.
	btScalar forces(int dof) const
	{
		const btScalar stiffness = m_capacity.m_stiffness[dof], own = deformations(dof);
		const int partner = partnerOf(dof);
		if (partner < 0)
			return stiffness * own;
		const btScalar coupling = btFabs(m_capacity.couplingCompliance(dof)), other = m_capacity.m_stiffness[partner];
		return stiffness * (own + coupling * other * deformations(partner)) /
			   (1 - coupling * coupling * stiffness * other);
	}

	int partnerOf(int dof) const
	{
		return m_capacity.couplingCompliance(dof) != 0 ? btElasticPlasticCapacity::coupledWith(dof) : -1;
	}

	std::mt19937 m_random;
	btElasticPlasticCapacity m_capacity;
	btElasticPlasticState m_state;
	MaterialDamping m_damping;
	Lanes m_strain, m_diagonal;
	btScalar m_dt, m_lastStep;
};

TEST(SpringLanes, RowsAreThoseOfTheLawToTheBit)
{
	for (unsigned seed = 0; seed < 500; ++seed)
	{
		const AnyJoint joint(seed);
		SpringLanes::Rows rows;
		joint.lanes().makeRows(joint.m_diagonal, joint.m_dt, joint.m_lastStep, rows);
		SoftRow expected[BT_EP_DOF_COUNT];
		const btScalar dt = joint.m_dt, step = dt * dt;
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		{
			const int partner = joint.partnerOf(i);
			if (partner < 0)
			{
				const DofState s = joint.dofState(i);
				const btScalar a = s.m_stiffness * dt * dt * joint.m_diagonal[i];
				expected[i] = implicitRow(s, MeanForce::byRow(a, dt, joint.m_lastStep), a, dt);
			}
			else if (i < partner)
			{
				const int dofs[2] = {i, partner};
				const DofState states[2] = {joint.dofState(i), joint.dofState(partner)};
				const btScalar a[2] = {states[0].m_stiffness * joint.m_diagonal[i] * step,
									   states[1].m_stiffness * joint.m_diagonal[partner] * step};
				SoftRow pair[2];
				const btScalar between =
					coupledRows(states, MeanForce::byRow(std::max(a[0], a[1]), dt, joint.m_lastStep), a,
								joint.m_capacity.couplingCompliance(i), dt, pair);
				expectSame(between, rows.m_coupling[i - BT_EP_SHEAR_Y], btFabs(between));
				for (int k = 0; k < 2; ++k)
					expected[dofs[k]] = pair[k];
			}
		}
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		{
			SCOPED_TRACE(::testing::Message() << "seed " << seed << ", " << i);
			const btScalar impulse = joint.forces(i) * dt;
			expectSame(expected[i].m_compliance, rows.m_compliance[i], expected[i].m_compliance);
			expectSame(expected[i].m_velocity, rows.m_velocity[i], joint.deformations(i) / dt);
			expectSame(expected[i].m_lower, rows.m_lower[i], impulse);
			expectSame(expected[i].m_upper, rows.m_upper[i], impulse);
		}
	}
}

/// Trial deformations at some share of what yields.
void mapAny(AnyJoint& joint, btScalar share, int& numElastic)
{
	Lanes trial, force;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		trial[i] = share * joint.between(-1, 1) * joint.m_capacity.m_yield[i] / joint.m_capacity.m_stiffness[i];
	const bool isElastic = joint.lanes().mapElastic(trial, force);
	numElastic += isElastic;
	bool flows = false;
	ReturnMapping expected[BT_EP_DOF_COUNT];
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		const int partner = joint.partnerOf(i);
		if (partner >= 0 && partner < i)
			continue;
		// At whatever bound the solver has told.
		const int dofs[2] = {i, partner >= 0 ? partner : i};
		DofState states[2];
		RowOutcome outcomes[2];
		for (int k = 0; k < 2; ++k)
		{
			const signed char bound = trial[dofs[k]] > 0 ? 1 : -1;
			states[k] = joint.dofState(dofs[k]);
			outcomes[k] = {0, 0, 0, trial[dofs[k]], bound, true, false};
		}
		const MeanForce mean = MeanForce::byRow(1, joint.m_dt, joint.m_lastStep);
		ReturnMapping mapped[2];
		if (partner < 0)
			mapped[0] = returnMap(states[0], mean, outcomes[0], joint.m_dt);
		else
			returnMapCoupled(states, mean, joint.m_capacity.couplingCompliance(i), outcomes, joint.m_dt, mapped);
		for (int k = 0; k < (partner < 0 ? 1 : 2); ++k)
		{
			expected[dofs[k]] = mapped[k];
			flows |= mapped[k].m_increment != 0;
		}
	}
	for (int i = 0; i < BT_EP_DOF_COUNT && isElastic; ++i)
	{
		expectSame(expected[i].m_force, force[i], joint.forces(i));
		EXPECT_EQ(0, expected[i].m_increment);
	}
	// What flows is never taken for elastic.
	EXPECT_FALSE(flows && isElastic);
}

TEST(SpringLanes, MappingIsThatOfTheLawToTheBit)
{
	int numElastic = 0, numTrials = 0;
	for (unsigned seed = 0; seed < 500; ++seed)
	{
		AnyJoint joint(seed);
		for (const btScalar share : {btScalar(0.3), btScalar(0.9), btScalar(1.1)})
		{
			mapAny(joint, share, numElastic);
			++numTrials;
		}
	}
	// Both kinds are met.
	EXPECT_GT(numElastic, numTrials / 10);
	EXPECT_LT(numElastic, numTrials * 9 / 10);
}

TEST(SpringLanes, WithoutStrengthNothingIsElastic)
{
	AnyJoint joint(1);
	joint.m_capacity.m_yield[BT_EP_AXIAL] = 0;
	Lanes trial, force;
	trial.fill(0);
	EXPECT_FALSE(joint.lanes().mapElastic(trial, force));
#ifndef __FAST_MATH__
	// There compilers compare as if all numbers were finite; solutions that are not are left out by their bits before this.
	trial[BT_EP_TORSION] = btScalar(NAN);
	EXPECT_FALSE(AnyJoint(1).lanes().mapElastic(trial, force));
#endif
}

TEST(SpringLanes, AreForSpringsOnly)
{
	AnyJoint joint(1);
	EXPECT_TRUE(SpringLanes::areSprings(joint.m_capacity));
	btElasticPlasticCapacity capacity = joint.m_capacity;
	capacity.setRigidPlastic(BT_EP_TORSION, 1, 1);
	EXPECT_FALSE(SpringLanes::areSprings(capacity));
	capacity = joint.m_capacity;
	capacity.clear(BT_EP_SHEAR_Y);
	EXPECT_FALSE(SpringLanes::areSprings(capacity));
}
}  // namespace testSpringLanes
