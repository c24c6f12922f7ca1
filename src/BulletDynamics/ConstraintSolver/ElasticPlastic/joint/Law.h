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
// Let e be the elastic deformation (total minus plastic), f = k e the force that pulls back, clamped to the yield value F.
// A row has the Jacobian J with J v = -de/dt, and A = J M^-1 J^T. The solver finds the impulse lambda of the row
//
//     J v1 + C lambda = r,   lower <= lambda <= upper.                                                           (1)
//
// Over a step dt the row applies the mean force  lambda / dt = c + alpha f*,  with f* = k (e_n + dt de1/dt) the force at the
// end of the step and c what is known at its start. Newmark's family in terms of forces (the force's rate g_n = df/dt stands
// for k de0/dt, so that the step may change) gives
//
//     c = (1 - alpha) f_n - beta dt g_n.
//
// Insert f* = k e_n - k dt J v1:
//
//     lambda / dt = c + alpha k e_n - alpha k dt J v1    =>    C = 1 / (alpha k dt^2),   r = (k e_n + c / alpha) / (k dt).
//
// Yield is |f*| <= F, so lower, upper = dt (c -+ alpha F): the solver's clamping of lambda *is* the return mapping of an
// elastic-perfectly plastic spring, implicit and for all rows together.
//
// With a = k dt^2 A, the square of frequency times step, and gamma = 1/2 + a / (a + 4),
//
//     alpha = (gamma + 1/2)^2 / 4,   beta = 1/2 + alpha - gamma:
//
// a spring that the step resolves (a << 1) gets the trapezoidal rule, second order and without dissipation; a stiff one
// (a >> 1) becomes backward Euler; nothing switches in between. alpha >= beta and alpha + beta >= 1/2 hold for every a, so
// the linear scheme is stable at any constant step (Hughes, The Finite Element Method, section 9.1, for beta_N = alpha, gamma_N = gamma).

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
	btScalar m_stiffness;     ///< k > 0
	btScalar m_yield;         ///< F >= 0
	btScalar m_strain;        ///< e_n, measured
	btScalar m_force;         ///< f_n, committed
	btScalar m_forceRate;     ///< g_n = (f_n - f_(n-1)) / dt_n, committed
	btScalar m_lastStep = 0;  ///< dt_n, 0: none
};

/// k e_n within the yield value.
inline btScalar clampedForce(const DofState& s)
{
	return btMax(-s.m_yield, btMin(s.m_yield, s.m_stiffness * s.m_strain));
}

/// alpha and beta of a step.
struct Newmark
{
	btScalar m_alpha, m_beta;

	/// \param a         square of frequency times step
	/// \param lastStep  0: none
	Newmark(btScalar a, btScalar dt, btScalar lastStep)
	{
		// a / (a + 4) written so that a = infinity is no NaN.
		// Steps that change in phase with an oscillation would feed energy into it; therefore a changed step dissipates.
		const btScalar change = lastStep > 0 ? btFabs(dt - lastStep) / (dt + lastStep) : btScalar(0);
		const btScalar gamma = btScalar(0.5) + btMin(btScalar(1), (a > 1 ? 1 / (1 + 4 / a) : a / (a + 4)) + change);
		m_alpha = (gamma + btScalar(0.5)) * (gamma + btScalar(0.5)) / 4;
		m_beta = btScalar(0.5) + m_alpha - gamma;
	}

	/// c
	btScalar known(const DofState& s, btScalar dt) const
	{
		return (1 - m_alpha) * s.m_force - m_beta * dt * s.m_forceRate;
	}
};

/// Row of the default scheme, for a solver that adds C to the diagonal (btElasticPlasticConstraintSolver).
inline SoftRow implicitRow(const DofState& s, const Newmark& scheme, btScalar dt)
{
	const btScalar alpha = scheme.m_alpha, c = scheme.known(s, dt);
	SoftRow row;
	row.m_compliance = 1 / (alpha * s.m_stiffness * dt * dt);
	row.m_velocity = s.m_strain / dt + c / (alpha * s.m_stiffness * dt);
	row.m_lower = dt * (c - alpha * s.m_yield);
	row.m_upper = dt * (c + alpha * s.m_yield);
	return row;
}

inline SoftRow implicitRow(const DofState& s, btScalar diagonal, btScalar dt)
{
	return implicitRow(s, Newmark(s.m_stiffness * dt * dt * diagonal, dt, s.m_lastStep), dt);
}

/// Rows of two degrees of freedom with coupled compliance K^-1, which have one alpha and beta, of the stiffer one: with
/// lambda / dt = c + alpha K (e_n - dt J v1) of both together
///
///     C = K^-1 / (alpha dt^2),   r = e_n / dt + K^-1 c / (alpha dt),   the bounds as for one.
///
/// \param diagonal  A of both
/// \param coupling  beside the diagonal of K^-1
/// \return beside the diagonal of C
inline btScalar coupledRows(const DofState s[2], const btScalar diagonal[2], btScalar coupling, btScalar dt,
							SoftRow rows[2])
{
	const btScalar a = dt * dt * btMax(s[0].m_stiffness * diagonal[0], s[1].m_stiffness * diagonal[1]);
	const Newmark scheme(a, dt, s[0].m_lastStep);
	for (int i = 0; i < 2; ++i)
	{
		rows[i] = implicitRow(s[i], scheme, dt);
		rows[i].m_velocity += coupling * scheme.known(s[1 - i], dt) / (scheme.m_alpha * dt);
	}
	return coupling / (scheme.m_alpha * dt * dt);
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
	btScalar m_force;         ///< at the end of the step, |m_force| <= yield
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

	/// Whether the impulse is at the bound that opposes the trial deformation. A direct solver knows this; with an iterative
	/// one the impulse may differ from the bound by a thousandth of the yield impulse.
	bool isAtBound(btScalar yieldImpulse) const
	{
		if (m_isBoundKnown)
			return m_trial > 0 ? m_bound > 0 : m_bound < 0;
		const btScalar slack = btScalar(1e-3) * yieldImpulse;
		if (isUnloaded(yieldImpulse))
			return false;
		return m_trial > 0 ? m_impulse >= m_upper - slack : m_impulse <= m_lower + slack;
	}
};

/// Return mapping of the trial deformation e* = e_n - dt J v1.
/// \param atBound  whether the row's impulse is at its bound in the direction of e*. If not, a force beyond yield is a
///           solver's error: the force is clamped, and nothing flows.
inline ReturnMapping returnMap(btScalar stiffness, btScalar yield, btScalar strain, bool atBound)
{
	const btScalar trial = stiffness * strain;
	ReturnMapping r;
	r.m_force = btMax(-yield, btMin(yield, trial));
	r.m_increment = atBound && btFabs(trial) > yield ? strain - r.m_force / stiffness : btScalar(0);
	return r;
}

/// Return mapping of two degrees of freedom with coupled compliance, see coupledRows().
/// \param strains  trial deformations
/// \param solved   the bounds at which the impulses are: -1, 0 or 1. Nothing flows where this is not the law's bound
inline void returnMapCoupled(const DofState s[2], btScalar coupling, const btScalar strains[2],
							 const signed char solved[2], ReturnMapping mapped[2])
{
	const CoupledPair<btScalar> pair = {{1 / s[0].m_stiffness, 1 / s[1].m_stiffness}, coupling};
	const btScalar lower[2] = {-s[0].m_yield, -s[1].m_yield}, upper[2] = {s[0].m_yield, s[1].m_yield};
	btScalar force[2];
	signed char bound[2];
	pair.project(strains, lower, upper, force, bound);
	for (int i = 0; i < 2; ++i)
	{
		mapped[i].m_force = force[i];
		mapped[i].m_increment = bound[i] != 0 && solved[i] == bound[i]
									? strains[i] - force[i] * pair.m_compliance[i] - coupling * force[1 - i]
									: btScalar(0);
	}
}

/// Return mapping of a rigid-plastic degree of freedom: at its bound, all motion in the direction of the force is plastic.
inline ReturnMapping rigidReturnMap(btScalar impulse, btScalar strain, bool atBound, btScalar dt)
{
	ReturnMapping r;
	r.m_force = impulse / dt;
	r.m_increment = atBound ? strain : btScalar(0);
	return r;
}

/// The default law: an elastic-perfectly plastic spring, implicit.
struct ImplicitLaw
{
	/// \param isForStock  the row is for one of Bullet's own solvers, which leave compliance out of the diagonal
	SoftRow row(const DofState& s, btScalar diagonal, btScalar dt, bool isForStock) const
	{
		return isForStock ? stockRow(s, diagonal, dt) : implicitRow(s, diagonal, dt);
	}

	/// Return mapping of the trial deformation: the part beyond yield is plastic, if the solver has ended with the row at its
	/// bound.
	ReturnMapping returnMap(const DofState& s, const RowOutcome& outcome, btScalar dt) const
	{
		const bool isBeyond = btFabs(s.m_stiffness * outcome.m_trial) > s.m_yield;
		ReturnMapping mapped = btElasticPlastic::returnMap(s.m_stiffness, s.m_yield, outcome.m_trial,
														   isBeyond && outcome.isAtBound(s.m_yield * dt));
		if (isBeyond && outcome.isUnloaded(s.m_yield * dt))
			mapped.m_unloaded = outcome.m_trial - mapped.m_force / s.m_stiffness;
		return mapped;
	}
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_LAW_H
