// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "WorkingSet.h"

#include <math.h>

#include <algorithm>

#include "../../btElasticPlasticFault.h"
#include "../linear/ScopedTimer.h"
#include "Jacobian.h"

namespace btElasticPlastic
{
namespace
{
/// With more members a factor for what has been found costs less than they do.
const size_t MOST_MEMBERS = 64;
/// So many rows join the set at once.
const size_t MOST_AT_ONCE = 16;
/// Where more rows leave a guess at once, it says next to nothing: the interior point method needs no guess.
const size_t MOST_LEAVING = 400;
/// How often all wrong rows change sides without being fewer than ever before, until one at a time does.
const int TURNS_TOGETHER = 6;
/// The most changes of sides in a call.
const int MOST_PIVOTS = 10;
/// An impulse that is beyond a bound by this share of it is at the bound: what is on the edge would change sides for ever.
const double ON_THE_EDGE = 1e-10;

/// On its way from one bound to the other a row is free for a turn: stiff ones would jump to and fro for ever.
signed char nextBound(signed char now, signed char wanted)
{
	return static_cast<signed char>(now * wanted < 0 ? 0 : wanted);
}

// Nominal work, see btElasticPlasticStatistics::m_work.
const double PRODUCTS_A_NANOSECOND = 2, NANOSECONDS_AN_ELEMENT = 4;
}  // namespace

void WorkingSet::begin(const AdmissibleBox& box, const std::vector<double>& velocity)
{
	m_guess.assign(box.getBounds(0), box.getBounds(0) + box.getImpulses().size());
	m_velocity = velocity;
	m_members.clear();
	m_answers.clear();
	m_isMember.assign(m_guess.size(), 0);
}

bool WorkingSet::solve(const SystemInput& input, const AdmissibleBox& box, const std::vector<double>& along,
					   LinearSolver& solver, std::vector<double>& velocity)
{
	if (!choose(input, box, along) || !takeIn(input, box, solver) || !pivot(input))
		return false;
	std::fill(velocity.begin(), velocity.end(), 0.);
	for (const Member& member : m_members)
		if (member.m_delta != 0)
			addImpulse(member.m_body, member.m_J, member.m_delta, velocity);
	if (!solver.solve(velocity))
		return false;
	double sum = 0;
	for (size_t i = 0; i < velocity.size(); ++i)
	{
		velocity[i] += m_velocity[i];
		sum += velocity[i];
	}
	return btElasticPlasticIsFinite(sum);
}

bool WorkingSet::isRight(const AdmissibleBox& box) const
{
	for (size_t i = 0; i < m_guess.size(); ++i)
		if (*box.getBounds(int(i)) != m_guess[i] && !m_isMember[i])
			return false;
	return true;
}

// ---- the members

/// Of the rows that have left the guess those by which the potential differs most: others leave only because these have not yet.
/// \return false if there is one that this class does not know, or that is not finite
bool WorkingSet::choose(const SystemInput& input, const AdmissibleBox& box, const std::vector<double>& along)
{
	m_leaving.clear();
	for (size_t i = 0; i < m_guess.size(); ++i)
	{
		if (*box.getBounds(int(i)) == m_guess[i] || m_isMember[i])
			continue;
		const SystemInput::Bounded& row = input.m_rows[i];
		if (row.isInBundle())
			return false;
		const double guessed =
			m_guess[i] == 0 ? (row.m_target - along[i]) / row.m_compliance : boundOf(row, m_guess[i]);
		const double beyond = box.getImpulse(int(i)) - guessed, gain = beyond * beyond * row.m_compliance;
		if (!btElasticPlasticIsFinite(gain))
			return false;
		m_leaving.push_back({gain, int(i)});
	}
	if (m_leaving.size() > MOST_LEAVING)
		return false;
	if (m_leaving.size() > MOST_AT_ONCE)
	{
		std::nth_element(m_leaving.begin(), m_leaving.begin() + MOST_AT_ONCE, m_leaving.end(),
						 [](const Leaving& a, const Leaving& b)
						 { return a.m_gain != b.m_gain ? a.m_gain > b.m_gain : a.m_row < b.m_row; });
		m_leaving.resize(MOST_AT_ONCE);
	}
	// In the order of rows, so that neighbours are neighbours.
	std::sort(m_leaving.begin(), m_leaving.end(), [](const Leaving& a, const Leaving& b) { return a.m_row < b.m_row; });
	return true;
}

/// \return false if there are too many
bool WorkingSet::takeIn(const SystemInput& input, const AdmissibleBox& box, LinearSolver& solver)
{
	const size_t before = m_members.size();
	for (const Leaving& leaving : m_leaving)
	{
		if (m_isMember[size_t(leaving.m_row)])
			continue;
		const int partner = input.m_rows[size_t(leaving.m_row)].m_partner;
		if (m_members.size() + (partner >= 0 ? 2 : 1) > MOST_MEMBERS)
			return false;
		add(input, leaving.m_row);
		if (partner < 0)
			continue;
		add(input, partner);
		const size_t n = m_members.size();
		m_members[n - 1].m_partner = int(n - 2);
		m_members[n - 2].m_partner = int(n - 1);
	}
	for (size_t i = before; i < m_members.size(); ++i)
	{
		Member& member = m_members[i];
		member.m_bound = nextBound(member.m_guess, *box.getBounds(member.m_row));
		solver.solveHalf(member.m_body, member.m_J, member.m_half);
		for (size_t j = 0; j <= i; ++j)
			m_answers.push_back(HalfSolution::multiply(member.m_half, m_members[j].m_half));
		m_statistics.m_work +=
			(long long)(double(member.m_half.m_values.size()) * double(i) / (2 * PRODUCTS_A_NANOSECOND));
		linearise(input, member);
	}
	return m_members.size() > before;
}

void WorkingSet::add(const SystemInput& input, int row)
{
	m_isMember[size_t(row)] = 1;
	m_members.emplace_back();
	Member& member = m_members.back();
	member.m_row = row;
	member.m_partner = -1;
	member.m_guess = m_guess[size_t(row)];
	getJacobian(input, row, member.m_body, member.m_J);
	member.m_u = input.m_rows[size_t(row)].m_target;
	for (int side = 0; side < 2; ++side)
		if (member.m_body[side] >= 0)
			for (int i = 0; i < 6; ++i)
				member.m_u -= member.m_J[6 * side + i] * m_velocity[size_t(6 * member.m_body[side] + i)];
}

WorkingSet::Pair WorkingSet::pairOf(const SystemInput& input, const Member& member) const
{
	const SystemInput::Bounded &row = input.m_rows[size_t(member.m_row)],
							   &partner = input.m_rows[size_t(row.m_partner)];
	return {{row.m_compliance, partner.m_compliance}, row.m_coupling};
}

double WorkingSet::boundOf(const SystemInput::Bounded& row, signed char bound)
{
	return bound > 0 ? row.m_upper : row.m_lower;
}

/// The impulse that a member has for the guess.
void WorkingSet::linearise(const SystemInput& input, Member& member) const
{
	const SystemInput::Bounded& row = input.m_rows[size_t(member.m_row)];
	if (member.m_guess != 0)
	{
		member.m_impulse = boundOf(row, member.m_guess);
		return;
	}
	if (member.m_partner < 0)
	{
		member.m_impulse = member.m_u / row.m_compliance;
		return;
	}
	const Member& partner = m_members[size_t(member.m_partner)];
	const double u[2] = {member.m_u, partner.m_u};
	double others;
	if (partner.m_guess == 0)
		pairOf(input, member).free(u, &member.m_impulse, &others);
	else
		member.m_impulse =
			(member.m_u - row.m_coupling * boundOf(input.m_rows[size_t(partner.m_row)], partner.m_guess)) /
			row.m_compliance;
}

// ---- the small problem

/// An element of T W.
double WorkingSet::withTangent(const SystemInput& input, size_t i, size_t j) const
{
	const Member& member = m_members[i];
	if (member.m_guess != 0)
		return 0;
	const double compliance = input.m_rows[size_t(member.m_row)].m_compliance;
	if (member.m_partner < 0 || m_members[size_t(member.m_partner)].m_guess != 0)
		return answer(i, j) / compliance;
	const signed char free[2] = {};
	double diagonal[2], beside;
	pairOf(input, member).getTangent(free, diagonal, beside);
	return diagonal[0] * answer(i, j) + beside * answer(size_t(member.m_partner), j);
}

/// An element of (1 - C T) W.
double WorkingSet::withoutTangent(const SystemInput& input, size_t i, size_t j) const
{
	const Member& member = m_members[i];
	if (member.m_guess == 0)
		return 0;
	if (member.m_partner < 0 || m_members[size_t(member.m_partner)].m_guess != 0)
		return answer(i, j);
	const Pair pair = pairOf(input, member);
	return answer(i, j) - pair.m_coupling / pair.m_compliance[1] * answer(size_t(member.m_partner), j);
}

/// delta for the members' bounds. One that is as in the guess, with its partner, deviates by nothing.
bool WorkingSet::solveFor(const SystemInput& input)
{
	m_changed.clear();
	for (size_t i = 0; i < m_members.size(); ++i)
	{
		m_members[i].m_delta = 0;
		if (hasChanged(m_members[i]))
			m_changed.push_back(i);
	}
	const size_t n = m_changed.size();
	m_matrix.resize(n * n);
	m_right.resize(n);
	for (size_t a = 0; a < n; ++a)
	{
		const size_t i = m_changed[a];
		const Member& member = m_members[i];
		const SystemInput::Bounded& row = input.m_rows[size_t(member.m_row)];
		double* const to = &m_matrix[n * a];
		const bool isFree = member.m_bound == 0;
		for (size_t b = 0; b < n; ++b)
			to[b] = isFree ? withoutTangent(input, i, m_changed[b])
						   : -row.m_compliance * withTangent(input, i, m_changed[b]);
		to[a] += row.m_compliance;
		if (!isFree)
		{
			m_right[a] = row.m_compliance * (boundOf(row, member.m_bound) - member.m_impulse);
			continue;
		}
		m_right[a] = member.m_u - row.m_compliance * member.m_impulse;
		if (member.m_partner < 0)
			continue;
		m_right[a] -= row.m_coupling * m_members[size_t(member.m_partner)].m_impulse;
		to[std::lower_bound(m_changed.begin(), m_changed.end(), size_t(member.m_partner)) - m_changed.begin()] +=
			row.m_coupling;
	}
	m_statistics.m_work += (long long)workOf(n);
	if (!eliminate(n))
		return false;
	for (size_t a = 0; a < n; ++a)
		m_members[m_changed[a]].m_delta = m_right[a];
	for (size_t i = 0; i < m_members.size(); ++i)
	{
		double along = 0;
		for (size_t a = 0; a < n; ++a)
			along += answer(i, m_changed[a]) * m_right[a];
		m_members[i].m_along = along;
	}
	return true;
}

/// Of solveFor().
double WorkingSet::workOf(size_t numChanged)
{
	const double n = double(numChanged);
	return n * n * n / (3 * PRODUCTS_A_NANOSECOND) + NANOSECONDS_AN_ELEMENT * n * n;
}

long long WorkingSet::getMostWork() const
{
	// Partners join along.
	return (long long)(MOST_PIVOTS * workOf(std::min(m_members.size() + 2 * MOST_AT_ONCE, MOST_MEMBERS)));
}

/// m_right = m_matrix^-1 m_right, by Gauss with pivots by rows. \return false if there is no number
bool WorkingSet::eliminate(size_t n)
{
	for (size_t k = 0; k < n; ++k)
	{
		size_t pivot = k;
		for (size_t i = k + 1; i < n; ++i)
			if (fabs(m_matrix[n * i + k]) > fabs(m_matrix[n * pivot + k]))
				pivot = i;
		if (!(fabs(m_matrix[n * pivot + k]) > 0))
			return false;
		if (pivot != k)
		{
			std::swap_ranges(&m_matrix[n * k], &m_matrix[n * k] + n, &m_matrix[n * pivot]);
			std::swap(m_right[k], m_right[pivot]);
		}
		const double* const from = &m_matrix[n * k];
		const double inverse = 1 / from[k];
		for (size_t i = k + 1; i < n; ++i)
		{
			double* const to = &m_matrix[n * i];
			const double factor = to[k] * inverse;
			if (factor == 0)
				continue;
			for (size_t j = k + 1; j < n; ++j)
				to[j] -= factor * from[j];
			m_right[i] -= factor * m_right[k];
		}
	}
	for (size_t k = n; k-- > 0;)
	{
		for (size_t j = k + 1; j < n; ++j)
			m_right[k] -= m_matrix[n * k + j] * m_right[j];
		m_right[k] /= m_matrix[n * k + k];
	}
	return true;
}

/// The bounds at which members are by what they are asked for.
void WorkingSet::findBounds(const SystemInput& input)
{
	m_bounds.resize(m_members.size());
	for (size_t i = 0; i < m_members.size(); ++i)
	{
		const Member& member = m_members[i];
		const SystemInput::Bounded& row = input.m_rows[size_t(member.m_row)];
		if (member.m_partner < 0)
		{
			const double impulse = (member.m_u - member.m_along) / row.m_compliance, tie = ON_THE_EDGE * fabs(impulse);
			const bool isNear = (member.m_bound >= 0 && fabs(impulse - row.m_upper) <= tie) ||
								(member.m_bound <= 0 && fabs(impulse - row.m_lower) <= tie);
			m_bounds[i] = static_cast<signed char>(isNear ? member.m_bound
												   : impulse > row.m_upper || row.m_lower == row.m_upper ? 1
												   : impulse < row.m_lower                               ? -1
																										 : 0);
			continue;
		}
		if (size_t(member.m_partner) < i)
			continue;
		const Member& partner = m_members[size_t(member.m_partner)];
		const SystemInput::Bounded& other = input.m_rows[size_t(partner.m_row)];
		const double u[2] = {member.m_u - member.m_along, partner.m_u - partner.m_along},
					 lower[2] = {row.m_lower, other.m_lower}, upper[2] = {row.m_upper, other.m_upper};
		double impulse[2];
		signed char bound[2];
		pairOf(input, member).project(u, lower, upper, impulse, bound);
		m_bounds[i] = bound[0];
		m_bounds[size_t(member.m_partner)] = bound[1];
	}
}

bool WorkingSet::pivot(const SystemInput& input)
{
	const ScopedTimer timer("elastic-plastic search", m_statistics.m_searchTime, m_measuresTime);
	size_t fewest = m_members.size() + 1;
	int patience = TURNS_TOGETHER;
	for (int turn = 0; turn < MOST_PIVOTS; ++turn)
	{
		if (!solveFor(input))
			return false;
		findBounds(input);
		size_t numWrong = 0, last = 0;
		for (size_t i = 0; i < m_members.size(); ++i)
			if (m_bounds[i] != m_members[i].m_bound)
			{
				++numWrong;
				last = i;
			}
		if (numWrong == 0)
			return true;
		const bool areFewer = numWrong < fewest;
		if (areFewer)
			fewest = numWrong;
		patience = areFewer ? TURNS_TOGETHER : patience - 1;
		for (size_t i = patience >= 0 ? 0 : last; i < m_members.size(); ++i)
			m_members[i].m_bound = nextBound(m_members[i].m_bound, m_bounds[i]);
	}
	return false;
}
}  // namespace btElasticPlastic
