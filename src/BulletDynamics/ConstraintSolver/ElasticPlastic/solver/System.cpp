// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "System.h"

#include <math.h>

#include <algorithm>

#include "../linear/ScopedTimer.h"
#include "../linear/Vector3.h"

namespace btElasticPlastic
{
void System::clear()
{
	m_bodies.clear();
	m_laws.clear();
	m_joints.clear();
	m_rows.clear();
}

System::Body& System::addBody()
{
	m_bodies.emplace_back();
	return m_bodies.back();
}

System::Joint& System::addJoint(int numLaws)
{
	m_joints.emplace_back();
	Joint& joint = m_joints.back();
	joint.m_firstLaw = int(m_laws.size());
	joint.m_numLaws = numLaws;
	m_laws.resize(m_laws.size() + numLaws);
	return joint;
}

System::Row& System::addRow()
{
	m_rows.emplace_back();
	m_rows.back().m_law = int(m_laws.size());
	m_laws.emplace_back();
	return m_rows.back();
}

// ---- rows and bodies

namespace
{
const double AT_REST[6] = {};

inline void addScaled(double factor, const double* a, double* to)
{
	for (int i = 0; i < 3; ++i)
		to[i] += factor * a[i];
}
}  // namespace

/// J v of all rows.
void System::project(const std::vector<double>& velocity, std::vector<double>& along) const
{
	along.resize(m_laws.size());
	const auto of = [&velocity](int body) { return body >= 0 ? &velocity[6 * size_t(body)] : AT_REST; };
	for (const Joint& joint : m_joints)
	{
		const double *a = of(joint.m_body[0]), *b = of(joint.m_body[1]);
		double turnA[3], turnB[3], relative[2][3];
		cross(a + 3, joint.m_arm[0], turnA);
		cross(b + 3, joint.m_arm[1], turnB);
		for (int i = 0; i < 3; ++i)
		{
			relative[0][i] = a[i] + turnA[i] - b[i] - turnB[i];
			relative[1][i] = a[3 + i] - b[3 + i];
		}
		double* to = &along[joint.m_firstLaw];
		for (int l = 0; l < joint.m_numLaws; ++l)
		{
			const int dof = joint.m_dof[l];
			to[l] = dof < 3 ? dot(joint.m_axis[dof], relative[0])
							: dot(joint.m_axis[dof - 3], relative[1]);
		}
	}
	for (const Row& row : m_rows)
	{
		const double *a = of(row.m_body[0]), *b = of(row.m_body[1]);
		along[row.m_law] = dot(row.m_J, a) + dot(row.m_J + 3, a + 3) +
						   dot(row.m_J + 6, b) + dot(row.m_J + 9, b + 3);
	}
}

/// momentum += sum J^T lambda.
void System::addImpulses(std::vector<double>& momentum) const
{
	double onGround[6] = {};
	const auto of = [&](int body) { return body >= 0 ? &momentum[6 * size_t(body)] : onGround; };
	for (const Joint& joint : m_joints)
	{
		double sum[2][3] = {}, moment[3];
		for (int l = 0; l < joint.m_numLaws; ++l)
		{
			const int dof = joint.m_dof[l];
			addScaled(m_laws[joint.m_firstLaw + l].m_impulse, joint.m_axis[dof % 3], sum[dof / 3]);
		}
		for (int side = 0; side < 2; ++side)
		{
			double* to = of(joint.m_body[side]);
			const double sign = side == 0 ? 1 : -1;
			cross(joint.m_arm[side], sum[0], moment);
			addScaled(sign, sum[0], to);
			addScaled(sign, moment, to + 3);
			addScaled(sign, sum[1], to + 3);
		}
	}
	for (const Row& row : m_rows)
	{
		const double impulse = m_laws[row.m_law].m_impulse;
		for (int side = 0; side < 2; ++side)
		{
			double* to = of(row.m_body[side]);
			addScaled(impulse, row.m_J + 6 * side, to);
			addScaled(impulse, row.m_J + 6 * side + 3, to + 3);
		}
	}
}

void System::multiplyMass(const std::vector<double>& x, std::vector<double>& y) const
{
	for (size_t b = 0; b < m_bodies.size(); ++b)
		for (int i = 0; i < 3; ++i)
		{
			y[6 * b + i] = m_bodies[b].m_mass[i] * x[6 * b + i];
			y[6 * b + 3 + i] = dot(&m_bodies[b].m_inertia[3 * i], &x[6 * b + 3]);
		}
}

/// x = H^-1 x for the rows' present bounds.
bool System::solveLinear(std::vector<double>& x)
{
	if (!m_matrixIsCurrent)
		assemble();
	return m_linearSolver.solve(x);
}

// ---- the function

/// Impulses and bounds of all rows at dv.
void System::evaluate()
{
	const ScopedTimer lap("elastic-plastic search", m_statistics.m_searchTime);
	project(m_velocity, m_along);
	m_boundsChanged = false;
	for (size_t l = 0; l < m_laws.size(); ++l)
	{
		Law& law = m_laws[l];
		const double impulse = (law.m_target - m_along[l]) / law.m_compliance;
		// Bounds without room between them, of friction where nothing presses, leave nothing to choose: on which side an impulse
		// of rounding's size lies must not count as a change.
		const signed char bound = impulse > law.m_upper || law.m_lower == law.m_upper ? 1
								  : impulse < law.m_lower                             ? -1
																					  : 0;
		law.m_impulse = bound > 0 ? law.m_upper : bound < 0 ? law.m_lower : impulse;
		m_boundsChanged |= bound != law.m_bound;
		law.m_bound = bound;
	}
	if (m_boundsChanged)
		m_matrixIsCurrent = false;
}

/// The residual that belongs to the last evaluate(). \return phi
double System::findResidual()
{
	const ScopedTimer lap("elastic-plastic search", m_statistics.m_searchTime);
	double phi = 0;
	m_phiTerms = 0;
	for (size_t l = 0; l < m_laws.size(); ++l)
	{
		// psi is u^2 / 2C between the bounds and goes on straight beyond them.
		const Law& law = m_laws[l];
		const double term = law.m_impulse * (law.m_target - m_along[l] - 0.5 * law.m_compliance * law.m_impulse);
		phi += term;
		m_phiTerms += fabs(term);
	}
	multiplyMass(m_velocity, m_residual);
	for (size_t i = 0; i < m_residual.size(); ++i)
	{
		const double term = 0.5 * m_velocity[i] * m_residual[i];
		phi += term;
		m_phiTerms += fabs(term);
		m_residual[i] = -m_residual[i];
	}
	addImpulses(m_residual);
	return phi;
}

// ---- the search

/// dv for the rows' present bounds as if they were right.
bool System::guess()
{
	for (Law& law : m_laws)
		law.m_impulse = law.m_bound == 0  ? law.m_target / law.m_compliance
						: law.m_bound > 0 ? law.m_upper
										  : law.m_lower;
	std::fill(m_velocity.begin(), m_velocity.end(), 0.);
	addImpulses(m_velocity);
	return solveLinear(m_velocity);
}

bool System::newton()
{
	evaluate();
	// With the bounds that were guessed, dv solves a linear problem, exactly.
	if (!m_boundsChanged)
		return true;
	double phi = findResidual();
	int roundings = 0;
	for (int step = 0; step < m_maxNewtonSteps; ++step)
	{
		m_step = m_residual;
		if (!solveLinear(m_step))
			return false;
		++m_statistics.m_newtonSteps;
		double slope = 0;
		for (size_t i = 0; i < m_step.size(); ++i)
			slope -= m_residual[i] * m_step[i];
		// What is left to gain is less than phi is rounded by. Rows that are all but at a bound may then change sides for ever:
		// some steps more for exactness, and it is found.
		if (-slope <= 1e-12 * m_phiTerms && ++roundings > 3)
			return true;
		m_start = m_velocity;
		move(1);
		evaluate();
		// So does a full step that changes no bound.
		if (!m_boundsChanged)
			return true;
		const double before = phi;
		phi = findResidual();
		if (phi <= before + 1e-4 * slope + 1e-14 * fabs(before))
			continue;
		move(exactLength());
		evaluate();
		phi = findResidual();
		if (!(phi == phi))
			return false;
	}
	return false;
}

void System::move(double length)
{
	for (size_t i = 0; i < m_step.size(); ++i)
		m_velocity[i] = m_start[i] + length * m_step[i];
}

/// Where phi is least along the step from the start, between 0 and 1. Its derivative there is monotonous and piecewise linear,
/// with a kink wherever a row reaches a bound: Newton's method, kept in the bracket, ends exactly. Halving the step would not
/// do: rows of little compliance bend phi almost like an edge, and the search would zigzag along it.
double System::exactLength()
{
	const ScopedTimer lap("elastic-plastic search", m_statistics.m_searchTime);
	m_work.resize(m_step.size());
	multiplyMass(m_step, m_work);
	double along0 = 0, along1 = 0;
	for (size_t i = 0; i < m_step.size(); ++i)
	{
		along0 += m_work[i] * m_start[i];
		along1 += m_work[i] * m_step[i];
	}
	project(m_start, m_alongStart);
	project(m_step, m_along);
	double low = 0, high = 1, t = 1;
	for (int i = 0; i < 60 && high - low > 1e-15; ++i)
	{
		double derivative = along0 + t * along1, second = along1;
		for (size_t l = 0; l < m_laws.size(); ++l)
		{
			const Law& law = m_laws[l];
			const double impulse = (law.m_target - m_alongStart[l] - t * m_along[l]) / law.m_compliance;
			derivative -= m_along[l] * std::max(law.m_lower, std::min(law.m_upper, impulse));
			if (impulse > law.m_lower && impulse < law.m_upper)
				second += m_along[l] * m_along[l] / law.m_compliance;
		}
		(derivative > 0 ? high : low) = t;
		const double next = t - derivative / second;
		if (fabs(next - t) <= 1e-14)
			break;
		t = next > low && next < high ? next : (low + high) / 2;
	}
	return t;
}

/// One loop of the augmented Lagrangian: multipliers follow impulses, friction's bounds follow normal impulses. What a loop
/// leaves of the slip is about c / (c + A), with A of the contact in the structure, where a light foot may carry thousands of
/// times its weight: contacts that hardly gain after some loops are made harder. All of them from the start would make Newton
/// crawl from one to the next.
/// \return whether anything changed that matters
bool System::tightenContacts(int loop)
{
	double slip = 0, fastest = 1e-9, frictionChange = 0, strongest = 1e-12;
	for (const Row& row : m_rows)
		fastest = std::max(fastest, row.m_isContact ? fabs(row.m_target) : 0.);
	for (Row& row : m_rows)
	{
		if (!row.m_isContact)
			continue;
		Law& law = m_laws[row.m_law];
		const double rest = row.m_softening * fabs(law.m_impulse - row.m_multiplier);
		slip = std::max(slip, rest);
		row.m_multiplier = law.m_impulse;
		if (loop > 4 && rest > 0.5 * row.m_slip && rest > m_contactTolerance * fastest &&
			row.m_softening > row.m_leastSoftening)
		{
			law.m_compliance -= 0.9 * row.m_softening;
			row.m_softening *= 0.1;
			m_matrixIsCurrent = false;
		}
		row.m_slip = rest;
		law.m_target = row.m_target + row.m_softening * row.m_multiplier;
	}
	for (const Row& row : m_rows)
	{
		if (row.m_normal < 0)
			continue;
		Law& law = m_laws[row.m_law];
		double bound = row.m_friction * std::max(0., m_laws[m_rows[row.m_normal].m_law].m_impulse);
		if (row.m_frictionMax > 0)
			bound = std::min(bound, row.m_frictionMax);
		frictionChange = std::max(frictionChange, fabs(bound - law.m_upper));
		strongest = std::max(strongest, bound);
		law.m_upper = bound;
		law.m_lower = -bound;
	}
	return slip > m_contactTolerance * fastest || frictionChange > 0.01 * strongest;
}

bool System::search()
{
	bool hasContacts = false;
	for (Row& row : m_rows)
		if (row.m_isContact)
		{
			hasContacts = true;
			row.m_target = m_laws[row.m_law].m_target;
			row.m_leastSoftening = 1e-6 * row.m_softening;
			row.m_slip = 0;
		}
	if (hasContacts)
		tightenContacts(0);
	bool solved = guess() && newton();
	bool open = hasContacts && tightenContacts(1);
	for (int loop = 0; solved && open && loop < m_maxContactLoops; ++loop)
	{
		++m_statistics.m_contactLoops;
		// The right sides have changed: even with the same bounds there is a step to make.
		solved = guess() && newton();
		open = tightenContacts(loop + 2);
	}
	m_statistics.m_looseContacts += open;
	for (double v : m_velocity)
		solved = solved && fabs(v) < 1e30;
	return solved;
}

bool System::solve(int& ticket)
{
	++m_statistics.m_islands;
	m_statistics.m_rows += int(m_laws.size());
	findEdges();
	m_linearSolver.begin(getNumBodies(), m_edges, ticket);
	ticket = m_linearSolver.getTicket();
	m_matrixIsCurrent = false;
	m_velocity.assign(6 * size_t(getNumBodies()), 0.);
	m_residual.resize(m_velocity.size());
	return search();
}
}  // namespace btElasticPlastic
