// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "System.h"

#include <math.h>

#include <algorithm>

#include "../linear/ScopedTimer.h"
#include "../linear/Vector3.h"

namespace btElasticPlastic
{
namespace
{
// ---- when the search ends, relative to the sum of the absolute values of phi's terms

/// A predicted gain below this is smaller than the rounding of phi.
const double ROUNDING = 1e-12;
/// The number of steps that are still made when the predicted gain is only rounding, for exactness. More would not help: rows
/// whose impulses differ from a bound by rounding may change sides for ever.
const int ROUNDING_STEPS = 3;
/// Hard rows make the step itself inexact: two sets of bounds may take turns a little above that. After so many steps below this
/// gain the last one is as good as any.
const double TURNING = 1e-10;
const int TURNING_STEPS = 10;

// ---- the line search

/// A full step is taken if it gains this share of what its slope promises (Armijo's rule), up to the rounding of phi.
const double SUFFICIENT_GAIN = 1e-4, PHI_ROUNDING = 1e-14;
/// The exact search ends at this share of the step, or when Newton's method has moved by less.
const double LENGTH_TOLERANCE = 1e-15, LENGTH_STEP = 1e-14;
/// The most iterations of the exact search; bisection alone would need 50.
const int MAX_LENGTH_STEPS = 60;

/// A solution with a larger velocity [m/s], [rad/s] counts as not converged.
const double FASTEST = 1e30;

// ---- velocities and impulses

const double AT_REST[6] = {};

inline void addScaled(double factor, const double* a, double* to)
{
	for (int i = 0; i < 3; ++i)
		to[i] += factor * a[i];
}

/// J v of all rows.
void project(const SystemInput& input, const std::vector<double>& velocity, std::vector<double>& along)
{
	along.resize(input.m_rows.size());
	const auto of = [&velocity](int body) { return body >= 0 ? &velocity[6 * size_t(body)] : AT_REST; };
	for (const SystemInput::Unit& unit : input.m_units)
	{
		const double *a = of(unit.m_body[0]), *b = of(unit.m_body[1]);
		double turnA[3], turnB[3], relative[2][3];
		cross(a + 3, unit.m_arm[0], turnA);
		cross(b + 3, unit.m_arm[1], turnB);
		for (int i = 0; i < 3; ++i)
		{
			relative[0][i] = a[i] + turnA[i] - b[i] - turnB[i];
			relative[1][i] = a[3 + i] - b[3 + i];
		}
		double* to = &along[unit.m_firstRow];
		for (int r = 0; r < unit.m_numRows; ++r)
		{
			const int dof = unit.m_dof[r];
			to[r] = dof < 3 ? dot(unit.m_axis[dof], relative[0]) : dot(unit.m_axis[dof - 3], relative[1]);
		}
	}
	for (const SystemInput::SingleRow& row : input.m_singleRows)
	{
		const double *a = of(row.m_body[0]), *b = of(row.m_body[1]);
		along[row.m_row] = dot(row.m_J, a) + dot(row.m_J + 3, a + 3) + dot(row.m_J + 6, b) + dot(row.m_J + 9, b + 3);
	}
}

/// momentum += sum J^T lambda.
void addImpulses(const SystemInput& input, const BoxLaw& law, std::vector<double>& momentum)
{
	double onGround[6] = {};
	const auto of = [&](int body) { return body >= 0 ? &momentum[6 * size_t(body)] : onGround; };
	for (const SystemInput::Unit& unit : input.m_units)
	{
		double sum[2][3] = {}, moment[3];
		const double* impulses = law.getImpulses(unit.m_firstRow);
		for (int r = 0; r < unit.m_numRows; ++r)
		{
			const int dof = unit.m_dof[r];
			addScaled(impulses[r], unit.m_axis[dof % 3], sum[dof / 3]);
		}
		for (int side = 0; side < 2; ++side)
		{
			double* to = of(unit.m_body[side]);
			const double sign = side == 0 ? 1 : -1;
			cross(unit.m_arm[side], sum[0], moment);
			addScaled(sign, sum[0], to);
			addScaled(sign, moment, to + 3);
			addScaled(sign, sum[1], to + 3);
		}
	}
	for (const SystemInput::SingleRow& row : input.m_singleRows)
	{
		const double impulse = law.getImpulse(row.m_row);
		for (int side = 0; side < 2; ++side)
		{
			double* to = of(row.m_body[side]);
			addScaled(impulse, row.m_J + 6 * side, to);
			addScaled(impulse, row.m_J + 6 * side + 3, to + 3);
		}
	}
}

/// y = M x
void multiplyMass(const SystemInput& input, const std::vector<double>& x, std::vector<double>& y)
{
	for (size_t b = 0; b < input.m_bodies.size(); ++b)
		for (int i = 0; i < 3; ++i)
		{
			y[6 * b + i] = input.m_bodies[b].m_mass[i] * x[6 * b + i];
			y[6 * b + 3 + i] = dot(&input.m_bodies[b].m_inertia[3 * i], &x[6 * b + 3]);
		}
}
}  // namespace

void System::setSettings(const btElasticPlasticSolverSettings& settings)
{
	m_settings = settings;
	m_linearSolver.setSettings(settings);
}

/// x = H^-1 x for the rows' present bounds.
bool System::solveLinear(const SystemInput& input, std::vector<double>& x)
{
	if (!m_matrixIsCurrent)
	{
		const ScopedTimer timer("elastic-plastic assemble", m_statistics.m_assemblyTime);
		m_matrix.assemble(input, m_law);
		m_matrixIsCurrent = true;
	}
	return m_linearSolver.solve(x);
}

// ---- the function

/// Impulses and bounds of all rows at dv.
void System::evaluate(const SystemInput& input)
{
	const ScopedTimer timer("elastic-plastic search", m_statistics.m_searchTime);
	project(input, m_velocity, m_along);
	m_boundsChanged = m_law.project(input, m_along);
	if (m_boundsChanged)
		m_matrixIsCurrent = false;
}

/// The residual that belongs to the last evaluate(). \return phi
double System::findResidual(const SystemInput& input)
{
	const ScopedTimer timer("elastic-plastic search", m_statistics.m_searchTime);
	double phi = 0;
	m_phiTerms = 0;
	m_law.addPotential(input, m_along, phi, m_phiTerms);
	multiplyMass(input, m_velocity, m_residual);
	for (size_t i = 0; i < m_residual.size(); ++i)
	{
		const double term = 0.5 * m_velocity[i] * m_residual[i];
		phi += term;
		m_phiTerms += fabs(term);
		m_residual[i] = -m_residual[i];
	}
	addImpulses(input, m_law, m_residual);
	return phi;
}

// ---- the search

/// dv for the rows' present bounds as if they were right.
bool System::guess(const SystemInput& input)
{
	m_law.holdBounds(input);
	std::fill(m_velocity.begin(), m_velocity.end(), 0.);
	addImpulses(input, m_law, m_velocity);
	return solveLinear(input, m_velocity);
}

bool System::newton(const SystemInput& input)
{
	evaluate(input);
	// dv solves the linear problem for the guessed bounds exactly: if no bound changes, the guess was right.
	if (!m_boundsChanged)
		return true;
	double phi = findResidual(input);
	int roundings = 0, turns = 0;
	for (int step = 0; step < m_settings.m_maxNewtonSteps; ++step)
	{
		m_step = m_residual;
		if (!solveLinear(input, m_step))
			return false;
		++m_statistics.m_newtonSteps;
		double slope = 0;
		for (size_t i = 0; i < m_step.size(); ++i)
			slope -= m_residual[i] * m_step[i];
		if (-slope <= ROUNDING * m_phiTerms && ++roundings > ROUNDING_STEPS)
			return true;
		if (-slope <= TURNING * m_phiTerms && ++turns > TURNING_STEPS)
			return true;
		m_start = m_velocity;
		move(1);
		evaluate(input);
		// A full step that changes no bound has found the solution, too.
		if (!m_boundsChanged)
			return true;
		const double before = phi;
		phi = findResidual(input);
		if (phi <= before + SUFFICIENT_GAIN * slope + PHI_ROUNDING * fabs(before))
			continue;
		move(exactLength(input));
		evaluate(input);
		phi = findResidual(input);
		if (!btElasticPlasticIsNumber(phi))
			return false;
	}
	return false;
}

void System::move(double length)
{
	for (size_t i = 0; i < m_step.size(); ++i)
		m_velocity[i] = m_start[i] + length * m_step[i];
}

/// Finds the share of the step, between 0 and 1, at which phi is least. The derivative of phi along the step is monotonic and
/// piecewise linear, with a kink wherever a row reaches a bound: Newton's method, kept within the bracket, ends exactly.
/// Halving the step would not be enough: rows of little compliance give phi almost an edge, along which the search would
/// zigzag.
double System::exactLength(const SystemInput& input)
{
	const ScopedTimer timer("elastic-plastic search", m_statistics.m_searchTime);
	m_work.resize(m_step.size());
	multiplyMass(input, m_step, m_work);
	double along0 = 0, along1 = 0;
	for (size_t i = 0; i < m_step.size(); ++i)
	{
		along0 += m_work[i] * m_start[i];
		along1 += m_work[i] * m_step[i];
	}
	project(input, m_start, m_alongStart);
	project(input, m_step, m_along);
	double low = 0, high = 1, t = 1;
	for (int i = 0; i < MAX_LENGTH_STEPS && high - low > LENGTH_TOLERANCE; ++i)
	{
		double derivative = along0 + t * along1, second = along1;
		m_law.addDerivatives(input, m_alongStart, m_along, t, derivative, second);
		(derivative > 0 ? high : low) = t;
		const double next = t - derivative / second;
		if (fabs(next - t) <= LENGTH_STEP)
			break;
		t = next > low && next < high ? next : (low + high) / 2;
	}
	return t;
}

bool System::search(SystemInput& input)
{
	const auto tighten = [&](int loop)
	{
		const AugmentedContacts::Progress progress =
			m_contacts.tighten(input, m_law, loop, m_settings.m_contactTolerance);
		m_matrixIsCurrent &= !progress.m_hasChangedMatrix;
		return progress.m_isOpen;
	};
	const bool hasContacts = m_contacts.begin(input, m_law);
	bool solved = guess(input) && newton(input);
	bool open = hasContacts && tighten(1);
	for (int loop = 0; solved && open && loop < m_settings.m_maxContactLoops; ++loop)
	{
		++m_statistics.m_contactLoops;
		// The contacts' targets have changed, so the solution changes even if no bound does.
		solved = guess(input) && newton(input);
		open = tighten(loop + 2);
	}
	m_statistics.m_looseContacts += open;
	for (double v : m_velocity)
		solved = solved && fabs(v) < FASTEST;
	return solved;
}

bool System::solveAgain(SystemInput& input)
{
	m_matrixIsCurrent = false;
	return search(input);
}

SystemResult System::getResult() const
{
	SystemResult result;
	result.m_velocity = m_velocity;
	m_law.getResult(result.m_impulses, result.m_bounds);
	return result;
}

void System::setResult(const SystemResult& result)
{
	m_velocity = result.m_velocity;
	m_law.setResult(result.m_impulses, result.m_bounds);
}

bool System::solve(SystemInput& input, int& islandId)
{
	++m_statistics.m_islands;
	m_statistics.m_rows += input.getNumRows();
	m_matrix.begin(input, islandId);
	islandId = m_linearSolver.getIslandId();
	m_matrixIsCurrent = false;
	m_law.begin(input);
	m_velocity.assign(6 * size_t(input.getNumBodies()), 0.);
	m_residual.resize(m_velocity.size());
	return search(input);
}
}  // namespace btElasticPlastic
