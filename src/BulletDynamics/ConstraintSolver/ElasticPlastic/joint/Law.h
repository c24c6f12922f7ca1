// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_LAW_H
#define BT_ELASTIC_PLASTIC_LAW_H

#include "CoupledPair.h"
#include "LinearMath/btMinMax.h"
#include "LinearMath/btScalar.h"

namespace btElasticPlastic
{
// The law of one elastic-plastic degree of freedom: pure functions, no rigid bodies.
//
// Let e be the elastic deformation (total minus plastic) and f the force that pulls back: k e, and what the material's internal
// damping adds (MaterialDamping.h). A row has the Jacobian J with J v = -de/dt, and A = J M^-1 J^T. The solver finds the impulse
// lambda of the row
//
//     J v1 + C lambda = r,   lower <= lambda <= upper.                                                           (1)
//
// Over a step dt the row applies the mean force  lambda / dt = c + alpha f*,  with f* the force at the end of the step,
// linear in the deformation there: f* = s e* + b with e* = e_n - dt J v1. c is what is known at the step's start, see MeanForce.
// Insert f*:
//
//     lambda / dt = c + alpha (s e_n + b) - alpha s dt J v1   =>   C = 1 / (alpha s dt^2),   r = e_n / dt + (c / alpha + b) / (s dt).
//
// Bounds of lambda are yield, see MeanForce::bound(): the solver's clamping of lambda *is* the return mapping of an elastic-perfectly
// plastic spring, implicit and for all rows together.

/// One row as the solver gets it, see (1). Impulses in N s or N m s, velocities in m/s or rad/s.
struct SoftRow
{
	btScalar m_compliance = 0;  ///< C [m/(N s)], [rad/(N m s)], >= 0
	btScalar m_velocity = 0;    ///< r [m/s], [rad/s]
	btScalar m_lower = 0;       ///< bounds of lambda
	btScalar m_upper = 0;
};

/// A degree of freedom at the start of a step.
struct DofState
{
	btScalar m_stiffness;       ///< k > 0
	btScalar m_yield;           ///< F >= 0
	btScalar m_strain;          ///< e_n, measured
	btScalar m_force;           ///< f_n, committed
	btScalar m_forceRate;       ///< g_n = (f_n - f_(n-1)) / dt_n, committed
	btScalar m_applied[2];      ///< mean forces of the last step and of the one before it
	btScalar m_stiffening = 0;  ///< s / k - 1, by the material's damping
	btScalar m_carried = 0;     ///< b, likewise

	btScalar withinYield(btScalar force) const { return btMax(-m_yield, btMin(m_yield, force)); }

	/// f* of an elastic deformation that no other is coupled with.
	/// (The stiffness may be the largest number there is.)
	btScalar forceAt(btScalar strain) const { return m_stiffness * strain * (1 + m_stiffening) + m_carried; }

	/// The part k e of f*.
	btScalar springForce(btScalar force) const { return (force - m_carried) / (1 + m_stiffening); }
};

/// k e_n within the yield value.
inline btScalar clampedForce(const DofState& s) { return s.withinYield(s.m_stiffness * s.m_strain); }

/// The mean force of a step, c + alpha f*, by one of two schemes.
///
/// By row: Newmark's family in terms of forces (the force's rate g_n stands for k de0/dt, so that the step may change),
///
///     c = (1 - alpha) f_n - beta dt g_n.
///
/// With a = k dt^2 A, the square of frequency times step, and gamma = 1/2 + a / (a + 4),
///
///     alpha = (gamma + 1/2)^2 / 4,   beta = 1/2 + alpha - gamma:
///
/// a spring that the step resolves (a << 1) gets the trapezoidal rule, second order and without dissipation; a stiff one
/// (a >> 1) becomes backward Euler; nothing switches in between. alpha >= beta and alpha + beta >= 1/2 hold for every a, so
/// the linear scheme is stable at any constant step (Hughes, The Finite Element Method, section 9.1, for beta_N = alpha, gamma_N = gamma).
/// Yield is |f*| <= F.
///
/// By mode: Bullet moves bodies by the velocity at the end of a step, so that the mean force F of the step from n to n + 1 stands for
/// the force at its beginning. With w for one step back,
///
///     f_(n+1) = D(w) F_(n+1),   D = 1 + tau ((1 - w) + (1 - w)^2 / 2):
///
/// the first term is this shift, the second one damps what the step does not resolve. The coefficients are the same for all rows, of
/// whatever stiffness. Therefore it acts on each mode of a structure by the mode's own frequency, however finely a member is divided, and
/// no mix of elastic rows gains energy: Im(exp(i theta) / D) is proportional to sin(theta) ((1 - tau) + 2 tau (1 - cos(theta))^2) >= 0.
/// With tau = 1 a swing of 50 steps has a damping ratio of 2e-5, one of 12 steps 0.5 %, of 3 steps 16 %; what has a tenth of a step a period
/// keeps an eighth of itself from step to step. tau = 0 is backward Euler.
///
/// In the many short steps of a blow (JointStep::begin()) rows that these do not resolve well and those of fibres are by mode, all others by row. Either
/// kind takes energy from any oscillation of an even step, so that no mix of elastic rows gains any.
///
/// Steps that change in phase with an oscillation would feed energy into it; therefore a changed step dissipates, by either.
struct MeanForce
{
	btScalar m_alpha;

	/// \param a         square of frequency times step
	/// \param lastStep  0: none
	static MeanForce byRow(btScalar a, btScalar dt, btScalar lastStep)
	{
		return byRow(dampingOf(isStiff(a) ? shareOfStiff(a) : shareOfSoft(a), changeOf(dt, lastStep)));
	}

	// The parts of it, for loops over rows.

	/// a / (a + 4): of a row with a above 1 by the inverse, so that a = infinity is no NaN.
	static bool isStiff(btScalar a) { return a > 1; }
	static btScalar shareOfStiff(btScalar a) { return 1 / (1 + 4 / a); }
	static btScalar shareOfSoft(btScalar a) { return a / (a + 4); }

	/// How much a step differs from the last one, 0 to 1. \param lastStep  0: none
	static btScalar changeOf(btScalar dt, btScalar lastStep)
	{
		return lastStep > 0 ? btFabs(dt - lastStep) / (dt + lastStep) : btScalar(0);
	}

	/// gamma - 1/2, at most 1.
	static btScalar dampingOf(btScalar share, btScalar change)
	{
		const btScalar sum = share + change;
		return 1 < sum ? btScalar(1) : sum;
	}

	/// \param damping  gamma - 1/2
	static MeanForce byRow(btScalar damping)
	{
		const btScalar gamma = btScalar(0.5) + damping;
		MeanForce mean;
		mean.m_alpha = (gamma + btScalar(0.5)) * (gamma + btScalar(0.5)) / 4;
		mean.m_beta = btScalar(0.5) + mean.m_alpha - gamma;
		return mean;
	}

	static MeanForce byMode(btScalar dt, btScalar lastStep)
	{
		return byMode(btMax(btScalar(0), 1 - 2 * changeOf(dt, lastStep)));
	}

	/// tau of the rows that are by mode among others by row: a step of another length is no past of waves, but that of a frame time that wavers a little is.
	/// \param lastStep  0: none
	static btScalar tauOfWaves(btScalar dt, btScalar lastStep)
	{
		const btScalar change = changeOf(dt, lastStep);
		return lastStep > 0 && change < btScalar(0.1) ? 1 - 2 * change : btScalar(0);
	}

	/// \param tau  0: backward Euler, which gives no energy whatever was before
	static MeanForce byMode(btScalar tau)
	{
		MeanForce mean;
		mean.m_isByMode = true;
		mean.m_middle = btScalar(0.5);
		mean.m_alpha = 1 / (1 + btScalar(1.5) * tau);
		mean.m_share[0] = 2 * tau * mean.m_alpha;
		mean.m_share[1] = btScalar(-0.5) * tau * mean.m_alpha;
		return mean;
	}

	/// c. By mode, a yield value that has become less since counts for what was before.
	btScalar known(const DofState& s, btScalar dt) const
	{
		if (m_isByMode)
			return m_share[0] * s.withinYield(s.m_applied[0]) + m_share[1] * s.withinYield(s.m_applied[1]);
		return (1 - m_alpha) * s.m_force - m_beta * dt * s.m_forceRate;
	}

	/// By mode, of a force of which only the one at the beginning of the step is kept, the share of that in c; the rest is of the mean forces by which
	/// two steps of a sum that it is part of differ from it.
	btScalar shareOfOwn() const { return m_share[0] + m_share[1]; }
	/// By mode, c of two mean forces less as much of the force at the beginning of the step.
	double beyondOwn(double applied, double appliedBefore, double own) const
	{
		return double(m_share[0]) * (applied - own) + double(m_share[1]) * (appliedBefore - own);
	}

	/// The least and the greatest mean force.
	struct Bounds
	{
		btScalar m_lower, m_upper;
	};

	/// By mode, |eta f* + (1 - eta) lambda / dt| and |lambda / dt| are at most F, and no bound is beyond zero:
	/// a row that the step resolves (eta = 1/2) yields by the force in the middle of the step, where the velocity is that at
	/// its end; a stiff one (eta -> 0) by the mean force.
	/// \param c                     what is known of it
	/// \param tension, compression  F in either direction
	/// \param a                     square of frequency times step
	Bounds bound(btScalar c, btScalar tension, btScalar compression, btScalar a) const
	{
		if (!m_isByMode)
			return {c - m_alpha * compression, c + m_alpha * tension};
		const btScalar eta = m_middle / (1 + a / 16), share = m_alpha / (eta + (1 - eta) * m_alpha),
					   middle = c - share * (1 - eta) * c;
		return {btMax(-compression, btMin(btScalar(0), middle - share * compression)),
				btMin(tension, btMax(btScalar(0), middle + share * tension))};
	}

	/// f* at one of a row's bounds.
	/// \param side  1: the upper one, -1: the lower one
	btScalar limit(int side, btScalar impulse, const DofState& s, btScalar dt) const
	{
		return m_isByMode ? (impulse / dt - known(s, dt)) / m_alpha : btScalar(side) * s.m_yield;
	}

private:
	btScalar m_beta = 0;           ///< by row
	btScalar m_share[2] = {0, 0};  ///< by mode: of the last mean force and of the one before it
	btScalar m_middle = 0;         ///< by mode: eta of a row that the step resolves, see bound()
	bool m_isByMode = false;
};

/// Row of a spring, for a solver that adds C to the diagonal (btElasticPlasticConstraintSolver).
/// \param a  square of frequency times step, k dt^2 A
inline SoftRow implicitRow(const DofState& s, const MeanForce& mean, btScalar a, btScalar dt)
{
	const btScalar alpha = mean.m_alpha, stiffness = (1 + s.m_stiffening) * s.m_stiffness, c = mean.known(s, dt);
	const MeanForce::Bounds bounds = mean.bound(c, s.m_yield, s.m_yield, a);
	SoftRow row;
	row.m_compliance = 1 / (alpha * stiffness * dt * dt);
	row.m_velocity = s.m_strain / dt + (c + alpha * s.m_carried) / (alpha * stiffness * dt);
	row.m_lower = dt * bounds.m_lower;
	row.m_upper = dt * bounds.m_upper;
	return row;
}

/// Rows of two degrees of freedom with coupled compliance K^-1, which have one alpha: with lambda / dt = c + alpha f* and
/// f* = (1 + g) K e* + b of both together
///
///     C = K^-1 / (alpha (1 + g) dt^2),   r = e_n / dt + K^-1 (c + alpha b) / (alpha (1 + g) dt),   the bounds as for one.
///
/// \param a         of both, see implicitRow()
/// \param coupling  beside the diagonal of K^-1
/// \return beside the diagonal of C
inline btScalar coupledRows(const DofState s[2], const MeanForce& mean, const btScalar a[2], btScalar coupling,
							btScalar dt, SoftRow rows[2])
{
	const btScalar share = mean.m_alpha * (1 + s[0].m_stiffening);
	for (int i = 0; i < 2; ++i)
	{
		const DofState& other = s[1 - i];
		rows[i] = implicitRow(s[i], mean, a[i], dt);
		rows[i].m_velocity += coupling * (mean.known(other, dt) + mean.m_alpha * other.m_carried) / (share * dt);
	}
	return coupling / (share * dt * dt);
}

/// Row that applies a force for the step whatever the velocity: it asks for a velocity that is never reached, within bounds
/// from 0 to the force's impulse. (Both bounds at the impulse would do the same in sequential impulses; but btMLCPSolver
/// solves for Bullet's split impulse with the same bounds, and would push the bodies a second time.)
inline SoftRow explicitRow(btScalar force, btScalar dt)
{
	const btScalar unreachable = btScalar(1e6);
	SoftRow row;
	row.m_velocity = force < 0 ? -unreachable : unreachable;
	row.m_lower = btMin(btScalar(0), dt * force);
	row.m_upper = btMax(btScalar(0), dt * force);
	return row;
}

/// Row for Bullet's own solvers. They multiply the impulse by C / A but leave C out of the diagonal, so that their iteration
/// grows for C >= A, that is for a <= 1: there the spring is resolved by the step, and its force is applied explicitly
/// (symplectic Euler, stable below a = 4). Above, backward Euler with C / A = 1 / a; coupled rows need more distance from 1,
/// so where 1 / a > 1/2 the row gets less compliance with the spring's own force: the same spring, damped more.
inline SoftRow stockRow(const DofState& s, btScalar diagonal, btScalar dt)
{
	if (s.m_stiffness * dt * dt * diagonal < 1)
		return explicitRow(clampedForce(s), dt);
	SoftRow row;
	row.m_compliance = btMin(1 / (s.m_stiffness * dt * dt), btScalar(0.5) * diagonal);
	row.m_velocity = row.m_compliance * s.m_stiffness * dt * s.m_strain;
	row.m_lower = -dt * s.m_yield;
	row.m_upper = dt * s.m_yield;
	return row;
}

/// Row of a rigid-plastic degree of freedom: no motion until the yield value is reached. Motion that a solver's error has let
/// happen is corrected with Bullet's error reduction erp (0 to 1 per step).
inline SoftRow rigidRow(btScalar yield, btScalar strain, btScalar erp, btScalar dt)
{
	SoftRow row;
	row.m_velocity = erp * strain / dt;
	row.m_lower = -dt * yield;
	row.m_upper = dt * yield;
	return row;
}

/// Outcome of the return mapping.
struct ReturnMapping
{
	btScalar m_force;         ///< of the spring, k e, at the end of the step
	btScalar m_increment;     ///< of plastic deformation
	btScalar m_unloaded = 0;  ///< deformation beyond yield that no force has opposed: neither plastic nor elastic
};

/// What a solver has made of a row.
struct RowOutcome
{
	btScalar m_impulse;
	btScalar m_lower;  ///< bounds that the row was given
	btScalar m_upper;
	btScalar m_trial;     ///< deformation if the whole step was elastic: e* = e_n - dt J v1
	signed char m_bound;  ///< -1 at the lower, 1 at the upper bound, 0 between
	bool m_isBoundKnown;  ///< whether the solver told m_bound: a direct one does
	bool m_isForStock;    ///< the row was for one of Bullet's own solvers

	/// The bound of an explicit row is the spring's force at the start of the step, which may be 0: nothing flows without a force.
	bool isUnloaded(btScalar yieldImpulse) const
	{
		return m_isForStock && (m_trial > 0 ? m_upper : -m_lower) <= btScalar(1e-3) * yieldImpulse;
	}

	/// Whether the impulse is at the bound on one side. A direct solver knows this; with an iterative one the impulse may differ from the
	/// bound by a thousandth of the yield impulse.
	/// \param side  1: the upper one, -1: the lower one
	bool isAtBound(int side, btScalar yieldImpulse) const
	{
		if (m_isBoundKnown)
			return m_bound * side > 0;
		const btScalar slack = btScalar(1e-3) * yieldImpulse;
		if (isUnloaded(yieldImpulse))
			return false;
		return side > 0 ? m_impulse >= m_upper - slack : m_impulse <= m_lower + slack;
	}

	/// The side to which the trial deformation is.
	int side() const { return m_trial > 0 ? 1 : -1; }
};

/// Return mapping by the yield value alone.
/// \param flows  whether deformation beyond it is plastic
inline ReturnMapping returnMap(const DofState& s, btScalar strain, bool flows)
{
	ReturnMapping r;
	r.m_force = s.withinYield(s.m_stiffness * strain);
	r.m_increment =
		flows && btFabs(s.m_stiffness * strain) > s.m_yield ? strain - r.m_force / s.m_stiffness : btScalar(0);
	return r;
}

/// Return mapping of the trial deformation e* = e_n - dt J v1, by the force f* that the row's bounds allow. The deformation beyond is
/// plastic if the row's impulse is at its bound; if not, it is a solver's error: the force is clamped, and nothing flows.
inline ReturnMapping returnMap(const DofState& s, const MeanForce& mean, const RowOutcome& outcome, btScalar dt)
{
	const btScalar trial = s.forceAt(outcome.m_trial), lower = mean.limit(-1, outcome.m_lower, s, dt),
				   upper = mean.limit(1, outcome.m_upper, s, dt);
	ReturnMapping r;
	r.m_force = s.springForce(btMax(lower, btMin(upper, trial)));
	const int side = trial > upper ? 1 : trial < lower ? -1 : 0;
	const bool flows = side != 0 && outcome.isAtBound(side, s.m_yield * dt);
	r.m_increment = flows ? outcome.m_trial - r.m_force / s.m_stiffness : btScalar(0);
	return r;
}

/// Return mapping of a row that one of Bullet's own solvers has solved: the force at the end of the step is at most the yield value.
inline ReturnMapping stockReturnMap(const DofState& s, const RowOutcome& outcome, btScalar dt)
{
	const btScalar yieldImpulse = s.m_yield * dt;
	ReturnMapping r = returnMap(s, outcome.m_trial, outcome.isAtBound(outcome.side(), yieldImpulse));
	if (btFabs(s.m_stiffness * outcome.m_trial) > s.m_yield && outcome.isUnloaded(yieldImpulse))
		r.m_unloaded = outcome.m_trial - r.m_force / s.m_stiffness;
	return r;
}

/// Return mapping of two degrees of freedom with coupled compliance, see coupledRows().
inline void returnMapCoupled(const DofState s[2], const MeanForce& mean, btScalar coupling, const RowOutcome outcome[2],
							 btScalar dt, ReturnMapping mapped[2])
{
	const CoupledPair<btScalar> pair = {{1 / s[0].m_stiffness, 1 / s[1].m_stiffness}, coupling};
	btScalar strains[2], lower[2], upper[2], force[2];
	signed char bound[2];
	for (int i = 0; i < 2; ++i)
	{
		strains[i] = (1 + s[i].m_stiffening) * outcome[i].m_trial + pair.m_compliance[i] * s[i].m_carried +
					 coupling * s[1 - i].m_carried;
		lower[i] = mean.limit(-1, outcome[i].m_lower, s[i], dt);
		upper[i] = mean.limit(1, outcome[i].m_upper, s[i], dt);
	}
	pair.project(strains, lower, upper, force, bound);
	for (int i = 0; i < 2; ++i)
		mapped[i].m_force = s[i].springForce(force[i]);
	for (int i = 0; i < 2; ++i)
		mapped[i].m_increment =
			bound[i] != 0 && outcome[i].isAtBound(bound[i], s[i].m_yield * dt)
				? outcome[i].m_trial - mapped[i].m_force * pair.m_compliance[i] - coupling * mapped[1 - i].m_force
				: btScalar(0);
}

/// Return mapping of a rigid-plastic degree of freedom: at its bound, all motion in the direction of the force is plastic.
inline ReturnMapping rigidReturnMap(btScalar impulse, btScalar strain, bool atBound, btScalar dt)
{
	ReturnMapping r;
	r.m_force = impulse / dt;
	r.m_increment = atBound ? strain : btScalar(0);
	return r;
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_LAW_H
