/*
Bullet Elastic-Plastic: joints for Bullet Physics that bend before they break
Copyright (c) 2026 Bullet Elastic-Plastic contributors

This software is provided 'as-is', without any express or implied warranty.
In no event will the authors be held liable for any damages arising from the use of this software.
Permission is granted to anyone to use this software for any purpose,
including commercial applications, and to alter it and redistribute it freely,
subject to the following restrictions:

1. The origin of this software must not be misrepresented; you must not claim that you wrote the original software. If you use this software in a product, an acknowledgment in the product documentation would be appreciated but is not required.
2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the original software.
3. This notice may not be removed or altered from any source distribution.
*/

#include "btElasticPlasticSystem.h"

#include <math.h>
#include <string.h>

#include <algorithm>

namespace
{
/// Plans kept: islands that fall asleep and wake, or come in batches, find theirs again.
const size_t MAX_PLANS = 32;
}  // namespace

void btElasticPlasticSystem::clear()
{
	m_mass.clear();
	m_rows.clear();
}

int btElasticPlasticSystem::addBody(const double mass[36])
{
	m_mass.insert(m_mass.end(), mass, mass + 36);
	return getNumBodies() - 1;
}

btElasticPlasticSystem::Row& btElasticPlasticSystem::addRow()
{
	m_rows.emplace_back();
	return m_rows.back();
}

btElasticPlasticSystem::Plan& btElasticPlasticSystem::findPlan()
{
	// Rows of one joint follow each other: one edge for all of them.
	m_edges.clear();
	for (Row& row : m_rows)
	{
		row.m_edge = -1;
		if (row.m_bodyA < 0 || row.m_bodyB < 0)
			continue;
		const size_t n = m_edges.size();
		if (n < 2 || m_edges[n - 2] != row.m_bodyA || m_edges[n - 1] != row.m_bodyB)
		{
			m_edges.push_back(row.m_bodyA);
			m_edges.push_back(row.m_bodyB);
		}
		row.m_edge = int(m_edges.size() / 2) - 1;
	}
	Plan* oldest = nullptr;
	for (Plan& plan : m_plans)
	{
		if (plan.m_numBodies == getNumBodies() && plan.m_edges == m_edges)
			return plan;
		if (!oldest || plan.m_lastUse < oldest->m_lastUse)
			oldest = &plan;
	}
	if (m_plans.size() < MAX_PLANS)
	{
		m_plans.emplace_back();
		oldest = &m_plans.back();
	}
	oldest->m_numBodies = getNumBodies();
	oldest->m_edges = m_edges;
	oldest->m_matrix.setPattern(getNumBodies(), reinterpret_cast<const int(*)[2]>(m_edges.data()),
								int(m_edges.size() / 2));
	oldest->m_factor.analyse(oldest->m_matrix);
	++m_statistics.m_analyses;
	return *oldest;
}

// ---- the matrix

namespace
{
/// block += w x y^T; from = 3 where only the angular parts are not zero.
void addProduct(double* block, double w, const double* x, const double* y, int from)
{
	for (int column = from; column < 6; ++column)
	{
		const double wy = w * y[column];
		for (int row = from; row < 6; ++row)
			block[6 * column + row] += wy * x[row];
	}
}
}  // namespace

void btElasticPlasticSystem::assemble()
{
	btElasticPlasticBlockMatrix& matrix = m_plan->m_matrix;
	matrix.setZero();
	for (int i = 0; i < getNumBodies(); ++i)
		memcpy(matrix.diagonal(i), &m_mass[36 * size_t(i)], 36 * sizeof(double));
	m_changedBodies.clear();
	for (Row& row : m_rows)
	{
		const bool isIn = row.m_bound == 0;
		if (isIn)
			addToMatrix(row, 1 / row.m_compliance);
		if (isIn != row.m_isInMatrix)
			for (int body : {row.m_bodyA, row.m_bodyB})
				if (body >= 0)
					m_changedBodies.push_back(body);
		row.m_isInMatrix = isIn;
	}
	m_matrixIsCurrent = true;
	m_factorIsCurrent = false;
}

void btElasticPlasticSystem::addToMatrix(const Row& row, double weight)
{
	btElasticPlasticBlockMatrix& matrix = m_plan->m_matrix;
	const double *a = row.m_J, *b = row.m_J + 6;
	const int from = row.m_isAngular ? 3 : 0;
	if (row.m_bodyA >= 0)
		addProduct(matrix.diagonal(row.m_bodyA), weight, a, a, from);
	if (row.m_bodyB >= 0)
		addProduct(matrix.diagonal(row.m_bodyB), weight, b, b, from);
	if (row.m_edge < 0)
		return;
	bool transposed;
	double* block = matrix.offDiagonal(row.m_edge, transposed);
	transposed ? addProduct(block, weight, b, a, from) : addProduct(block, weight, a, b, from);
}

/// Is a factor so much more expensive than a solution that iterating with an old one pays?
bool btElasticPlasticSystem::isWorthKeeping() const
{
	const btElasticPlasticBlockFactor& factor = m_plan->m_factor;
	return double(factor.getNumOperations()) > 8. * 144 * double(factor.getNumBlocks());
}

/// Where few bounds have changed since a factorisation of the same solve(), only what depends on them is done again.
bool btElasticPlasticSystem::factorise()
{
	btElasticPlasticBlockFactor& factor = m_plan->m_factor;
	++m_statistics.m_factorisations;
	m_factorIsCurrent = m_factorIsOfThisSolve && 8 * m_changedBodies.size() < size_t(getNumBodies())
							? factor.factorise(m_plan->m_matrix, m_changedBodies.data(), int(m_changedBodies.size()))
							: factor.factorise(m_plan->m_matrix);
	m_factorIsOfThisSolve = m_factorIsCurrent;
	return m_factorIsCurrent;
}

/// x = H^-1 x for the rows' present bounds.
bool btElasticPlasticSystem::solveLinear(std::vector<double>& x)
{
	if (!m_matrixIsCurrent)
		assemble();
	if (!m_factorIsCurrent && !m_factorIsOfThisSolve && m_plan->m_factor.hasFactor() && m_maxIterations > 0 &&
		isWorthKeeping())
	{
		if (m_plan->m_patience > 0)
			--m_plan->m_patience;
		else if (iterate(x))
			return true;
		else
			m_plan->m_patience = 8;
	}
	if (!m_factorIsCurrent && !factorise())
		return false;
	m_plan->m_factor.solve(x.data());
	++m_statistics.m_solutions;
	return true;
}

namespace
{
double dot(const std::vector<double>& x, const std::vector<double>& y)
{
	double sum = 0;
	for (size_t i = 0; i < x.size(); ++i)
		sum += x[i] * y[i];
	return sum;
}
}  // namespace

/// Conjugate gradients, preconditioned with a factor that H has left behind a little. Leaves x as it was if it takes too long.
bool btElasticPlasticSystem::iterate(std::vector<double>& x)
{
	const btElasticPlasticBlockMatrix& matrix = m_plan->m_matrix;
	const btElasticPlasticBlockFactor& factor = m_plan->m_factor;
	const size_t n = x.size();
	const double enough = m_iterationTolerance * m_iterationTolerance * dot(x, x);
	m_rest = x;
	m_product.resize(n);
	m_preconditioned = m_rest;
	factor.solve(m_preconditioned.data());
	++m_statistics.m_solutions;
	m_search = m_preconditioned;
	m_solution.assign(n, 0.);
	double rz = dot(m_rest, m_preconditioned), before = dot(x, x);
	for (int i = 0; i < m_maxIterations; ++i)
	{
		matrix.multiply(m_search.data(), m_product.data());
		++m_statistics.m_iterations;
		const double alpha = rz / dot(m_search, m_product);
		double rest = 0;
		for (size_t k = 0; k < n; ++k)
		{
			m_solution[k] += alpha * m_search[k];
			m_rest[k] -= alpha * m_product[k];
			rest += m_rest[k] * m_rest[k];
		}
		if (rest <= enough)
		{
			x.swap(m_solution);
			return true;
		}
		// Give up when the way is too long: each iteration gains about what the last one did.
		if (!(rest < before) || pow(rest / before, m_maxIterations - 1 - i) * rest > enough)
			return false;
		before = rest;
		m_preconditioned = m_rest;
		factor.solve(m_preconditioned.data());
		++m_statistics.m_solutions;
		const double next = dot(m_rest, m_preconditioned);
		for (size_t k = 0; k < n; ++k)
			m_search[k] = m_preconditioned[k] + next / rz * m_search[k];
		rz = next;
	}
	return false;
}

// ---- the function

double btElasticPlasticSystem::along(const Row& row, const std::vector<double>& velocity) const
{
	double sum = 0;
	if (row.m_bodyA >= 0)
		for (int i = 0; i < 6; ++i)
			sum += row.m_J[i] * velocity[6 * size_t(row.m_bodyA) + i];
	if (row.m_bodyB >= 0)
		for (int i = 0; i < 6; ++i)
			sum += row.m_J[6 + i] * velocity[6 * size_t(row.m_bodyB) + i];
	return sum;
}

void btElasticPlasticSystem::addTo(std::vector<double>& momentum, const Row& row, double impulse) const
{
	if (row.m_bodyA >= 0)
		for (int i = 0; i < 6; ++i)
			momentum[6 * size_t(row.m_bodyA) + i] += row.m_J[i] * impulse;
	if (row.m_bodyB >= 0)
		for (int i = 0; i < 6; ++i)
			momentum[6 * size_t(row.m_bodyB) + i] += row.m_J[6 + i] * impulse;
}

void btElasticPlasticSystem::multiplyMass(const std::vector<double>& x, std::vector<double>& y) const
{
	for (int b = 0; b < getNumBodies(); ++b)
		for (int row = 0; row < 6; ++row)
		{
			double sum = 0;
			for (int column = 0; column < 6; ++column)
				sum += m_mass[36 * size_t(b) + 6 * column + row] * x[6 * size_t(b) + column];
			y[6 * size_t(b) + row] = sum;
		}
}

/// At dv: impulses and bounds of all rows, the residual, and phi.
double btElasticPlasticSystem::evaluate()
{
	multiplyMass(m_velocity, m_residual);
	double phi = 0;
	for (size_t i = 0; i < m_residual.size(); ++i)
	{
		phi += 0.5 * m_velocity[i] * m_residual[i];
		m_residual[i] = -m_residual[i];
	}
	m_boundsChanged = false;
	for (Row& row : m_rows)
	{
		const double u = row.m_target + row.m_compliance * row.m_multiplier - along(row, m_velocity);
		double impulse = u / row.m_compliance;
		signed char bound = 0;
		if (impulse > row.m_upper)
		{
			impulse = row.m_upper;
			bound = 1;
		}
		else if (impulse < row.m_lower)
		{
			impulse = row.m_lower;
			bound = -1;
		}
		// psi is u^2 / 2C between the bounds and goes on straight beyond them.
		phi += impulse * (u - 0.5 * row.m_compliance * impulse);
		m_boundsChanged |= bound != row.m_bound;
		row.m_bound = bound;
		row.m_impulse = impulse;
		addTo(m_residual, row, impulse);
	}
	if (m_boundsChanged)
		m_matrixIsCurrent = false;
	return phi;
}

// ---- the search

/// dv for the rows' present bounds as if they were right.
bool btElasticPlasticSystem::guess()
{
	std::fill(m_velocity.begin(), m_velocity.end(), 0.);
	for (const Row& row : m_rows)
		addTo(m_velocity, row,
			  row.m_bound == 0  ? row.m_target / row.m_compliance + row.m_multiplier
			  : row.m_bound > 0 ? row.m_upper
								: row.m_lower);
	return solveLinear(m_velocity);
}

bool btElasticPlasticSystem::newton()
{
	double phi = evaluate();
	// With the bounds that were guessed, dv solves a linear problem, exactly.
	for (int step = 0; m_boundsChanged; ++step)
	{
		m_step = m_residual;
		if (step == m_maxNewtonSteps || !solveLinear(m_step))
			return false;
		++m_statistics.m_newtonSteps;
		double slope = 0;
		for (size_t i = 0; i < m_step.size(); ++i)
			slope -= m_residual[i] * m_step[i];
		m_start = m_velocity;
		move(1);
		const double phi0 = phi;
		phi = evaluate();
		if (phi <= phi0 + 1e-4 * slope + 1e-14 * fabs(phi0))
			// A full step that changes no bound has solved the linear problem of these bounds.
			continue;
		move(0);
		move(exactLength());
		phi = evaluate();
		if (!(phi == phi))
			return false;
		m_boundsChanged = true;
	}
	return true;
}

void btElasticPlasticSystem::move(double length)
{
	for (size_t i = 0; i < m_step.size(); ++i)
		m_velocity[i] = m_start[i] + length * m_step[i];
}

/// Where phi is least along the step from the present dv, between 0 and 1. Its derivative there is monotonous and piecewise
/// linear, with a kink wherever a row reaches a bound: Newton's method, kept in the bracket, ends exactly. Halving the step
/// would not do: rows of little compliance bend phi almost like an edge, and the search would zigzag along it.
double btElasticPlasticSystem::exactLength()
{
	m_work.resize(m_step.size());
	multiplyMass(m_step, m_work);
	double along0 = 0, along1 = 0;
	for (size_t i = 0; i < m_step.size(); ++i)
	{
		along0 += m_work[i] * m_velocity[i];
		along1 += m_work[i] * m_step[i];
	}
	m_rowDistance.resize(m_rows.size());
	m_rowSpeed.resize(m_rows.size());
	for (size_t i = 0; i < m_rows.size(); ++i)
	{
		const Row& row = m_rows[i];
		m_rowDistance[i] = row.m_target + row.m_compliance * row.m_multiplier - along(row, m_velocity);
		m_rowSpeed[i] = along(row, m_step);
	}
	double low = 0, high = 1, t = 1;
	for (int i = 0; i < 60 && high - low > 1e-15; ++i)
	{
		double derivative = along0 + t * along1, second = along1;
		for (size_t r = 0; r < m_rows.size(); ++r)
		{
			const Row& row = m_rows[r];
			const double impulse = (m_rowDistance[r] - t * m_rowSpeed[r]) / row.m_compliance;
			derivative -= m_rowSpeed[r] * std::max(row.m_lower, std::min(row.m_upper, impulse));
			if (impulse > row.m_lower && impulse < row.m_upper)
				second += m_rowSpeed[r] * m_rowSpeed[r] / row.m_compliance;
		}
		(derivative > 0 ? high : low) = t;
		const double next = t - derivative / second;
		if (fabs(next - t) <= 1e-14)
			break;
		t = next > low && next < high ? next : (low + high) / 2;
	}
	return t;
}

/// One loop of the augmented Lagrangian: multipliers follow impulses, friction's bounds follow normal impulses.
/// \return whether anything changed that matters
bool btElasticPlasticSystem::tightenContacts()
{
	double slip = 0, fastest = 1e-9, frictionChange = 0, strongest = 1e-12;
	for (Row& row : m_rows)
	{
		if (!row.m_isContact)
			continue;
		slip = std::max(slip, row.m_compliance * fabs(row.m_impulse - row.m_multiplier));
		fastest = std::max(fastest, fabs(row.m_target));
		row.m_multiplier = row.m_impulse;
	}
	for (Row& row : m_rows)
	{
		if (row.m_normal < 0)
			continue;
		double bound = row.m_friction * std::max(0., m_rows[row.m_normal].m_impulse);
		if (row.m_frictionMax > 0)
			bound = std::min(bound, row.m_frictionMax);
		frictionChange = std::max(frictionChange, fabs(bound - row.m_upper));
		strongest = std::max(strongest, bound);
		row.m_upper = bound;
		row.m_lower = -bound;
	}
	return slip > m_contactTolerance * fastest || frictionChange > 0.01 * strongest;
}

bool btElasticPlasticSystem::solve()
{
	++m_statistics.m_systems;
	m_statistics.m_rows += getNumRows();
	m_plan = &findPlan();
	m_plan->m_lastUse = ++m_time;
	m_matrixIsCurrent = m_factorIsCurrent = m_factorIsOfThisSolve = false;
	m_velocity.assign(6 * size_t(getNumBodies()), 0.);
	m_residual.resize(m_velocity.size());

	bool hasContacts = false;
	for (const Row& row : m_rows)
		hasContacts |= row.m_isContact;
	if (hasContacts)
		tightenContacts();
	bool solved = guess() && newton();
	for (int loop = 0; solved && hasContacts && loop < m_maxContactLoops && tightenContacts(); ++loop)
	{
		++m_statistics.m_contactLoops;
		// The right sides have changed: even with the same bounds there is a step to make.
		solved = guess() && newton();
	}
	for (double v : m_velocity)
		solved = solved && fabs(v) < 1e30;
	if (!solved)
		++m_statistics.m_failures;
	return solved;
}
