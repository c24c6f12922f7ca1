// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_MATERIAL_DAMPING_H
#define BT_ELASTIC_PLASTIC_MATERIAL_DAMPING_H

#include "../../btElasticPlasticDof.h"
#include "../../btElasticPlasticState.h"
#include "Law.h"
#include "LinearMath/btMinMax.h"
#include "LinearMath/btScalar.h"

namespace btElasticPlastic
{
/// Internal damping of a material: of all modes of a structure by the same ratio, whatever their frequency.
///
/// Beside the spring act branches of a spring and a dashpot in a row (generalised Maxwell model), whose forces q follow the elastic
/// deformation's changes and relax:
///
///     dq/dt = g k de/dt - q / T.
///
/// Relaxation times spread evenly over the frequencies' logarithm have a loss factor d that is nearly constant between the first and
/// the last one's frequency; a mode that bends them has the damping ratio d/2. Three branches keep to the ratio within 5 % from 0.3 to
/// 20 Hz. All rows have the same g and T, and so this acts on each mode by itself and no mix of rows gains energy. What is at rest, and what
/// flows, is not damped: q follows elastic deformation only, and relaxes.
///
/// A cause precedes its effect, therefore a loss that is constant over frequencies stiffens with frequency, by the factor
/// (f2 / f1)^(4 ratio / pi) from f1 to f2 (Kramers and Kronig): a spring is k at rest, and its modes of 2 Hz are 2 % faster than by k
/// where the ratio is 1 %.
///
/// Over a step in which e changes evenly, q1 = r q0 + p g k (e1 - e0) with r = exp(-dt/T), p = (1 - r) T / dt. By
/// r = 1 / (1 + x + x^2/2), x = dt/T, that is true to second order, and to first where the step is much longer than T.
class MaterialDamping
{
public:
	enum
	{
		BRANCHES = btElasticPlasticState::BRANCHES
	};

	MaterialDamping() = default;

	/// \param ratio  of critical damping; below a billionth, where its energies are no numbers any more: none
	/// \param dt     of the step [s]
	MaterialDamping(btScalar ratio, btScalar dt) : m_ratio(ratio), m_dt(dt)
	{
		// Frequencies 1 / (2 pi T) [Hz], and what a branch adds to the stiffness per loss factor: fitted.
		const btScalar frequency[BRANCHES] = {btScalar(0.33), btScalar(2.6), 20},
					   weight[BRANCHES] = {btScalar(1.63), btScalar(1.23), btScalar(1.68)};
		const btScalar loss = 2 * ratio / (1 + 2 * ratio / SIMD_PI);
		btScalar stiffness = 1;  // of the slower branches and the spring, over k
		for (int i = 0; i < BRANCHES && !isNone(); ++i)
		{
			const btScalar half = weight[i] * loss / 2, growth = (1 + half) / (1 - half);
			Branch& branch = m_branch[i];
			// For small ratios the difference is all rounding.
			branch.m_gain = (half < btScalar(1e-3) ? 2 * half / (1 - half) : growth - 1) * stiffness;
			branch.m_time = 1 / (SIMD_2_PI * frequency[i] * btSqrt(growth));
			const btScalar x = dt / branch.m_time;
			branch.m_kept = 1 / (1 + x * (1 + x / 2));
			branch.m_taken = branch.m_gain * (1 + x / 2) * branch.m_kept;
			m_stiffening += branch.m_taken;
			stiffness *= growth;
		}
	}

	bool isFor(btScalar ratio, btScalar dt) const { return ratio == m_ratio && dt == m_dt; }
	bool isNone() const { return !(m_ratio > btScalar(1e-9)); }

	/// By which the force at the end of a step grows with the spring's: sum of p g.
	btScalar getStiffening() const { return m_stiffening; }

	/// Adds the branches of a degree of freedom to its spring.
	/// \param q  of all degrees of freedom, at the start of the step
	void addTo(DofState& s, const btScalar q[BRANCHES][BT_EP_DOF_COUNT], int dof) const
	{
		if (isNone())
			return;
		s.m_stiffening = m_stiffening;
		s.m_carried = -m_stiffening * s.m_force;
		for (int i = 0; i < BRANCHES; ++i)
		{
			s.m_carried += m_branch[i].m_kept * q[i][dof];
			s.m_force += q[i][dof];
		}
	}

	/// r and p g of the i-th branch.
	btScalar getKept(int i) const { return m_branch[i].m_kept; }
	btScalar getTaken(int i) const { return m_branch[i].m_taken; }

	/// The i-th branch's force at the end of the step.
	/// \param change  of the spring's force
	btScalar next(int i, btScalar q, btScalar change) const
	{
		return isNone() ? btScalar(0) : m_branch[i].m_kept * q + m_branch[i].m_taken * change;
	}

	/// g of the i-th branch: its energy is q^2 / (2 g k).
	btScalar getGain(int i) const { return m_branch[i].m_gain; }

	/// What the i-th branch's dashpot dissipates in a step over (q0^2 + q0 q1 + q1^2) / (3 k): its force changes evenly.
	btScalar getLoss(int i) const { return m_dt / (m_branch[i].m_gain * m_branch[i].m_time); }

private:
	struct Branch
	{
		btScalar m_gain, m_time;   ///< g, T [s]
		btScalar m_kept, m_taken;  ///< r, p g
	};

	btScalar m_ratio = 0, m_dt = 0, m_stiffening = 0;
	Branch m_branch[BRANCHES] = {};
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_MATERIAL_DAMPING_H
