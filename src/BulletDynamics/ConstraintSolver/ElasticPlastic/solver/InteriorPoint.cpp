// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "InteriorPoint.h"

#include <math.h>

#include <algorithm>

#include "../linear/ScopedTimer.h"
#include "Jacobian.h"
#include "UnitTangent.h"

namespace btElasticPlastic
{
namespace
{
/// The first barrier over the mean of what rows are beyond their bounds, measured on walls, frames, towers and lattices that are hit:
/// with 1 they take a quarter more iterations, with 1000 the search that follows takes more steps than are saved.
const double FIRST_BARRIER = 100;
/// The iterations end at this share of the first barrier, and of the first momentum that is not balanced. Newton's method ends the
/// search from there in a step or two.
const double BARRIER_END = 1e-8, MOMENTUM_END = 1e-7;
/// Nominal work of an iteration beside the linear solver's, see btElasticPlasticStatistics::m_work.
const double ITERATION_A_ROW = 30;
/// The share of the way to the nearest bound that a step may go.
const double MOST_OF_THE_WAY = 0.995;
/// The first impulse of a contact, as a share of what would stop its bodies by themselves.
const double FIRST_CONTACT = 1;
/// Velocity [m/s] at which contacts count as approaching at least.
const double SLOWEST_CONTACT = 0.1;
/// The least normal impulse [N s] by which friction is bounded: its bounds must not meet within the iterations.
const double LEAST_NORMAL = 1e-9;
/// Friction's bounds follow down to this share of the first barrier: by then normal impulses have two or three digits, and with bounds
/// that moved for ever the iterations would not end.
const double LAST_FRICTION = 1e-5;
/// Further from an impulse than this there is no bound: it would only take digits.
const double NO_BOUND = 1e20;

double largest(const std::vector<double>& elements)
{
	double most = 0;
	for (const double element : elements)
		most = std::max(most, fabs(element));
	return most;
}
}  // namespace

struct InteriorPoint::Tangents
{
	const std::vector<double>&m_tangent, &m_beside;
	const std::vector<CoupledBundle::Matrix>& m_bundles;

	bool addTangent(const SystemInput& input, const SystemInput::Unit& unit, double linear[9], double angular[9],
					double mixed[9]) const
	{
		return addUnitTangent(*this, input, unit, linear, angular, mixed);
	}
	double getTangentWithPartner(const SystemInput&, int row) const { return m_beside[size_t(row)]; }
	double getTangent(const SystemInput&, int row) const { return m_tangent[size_t(row)]; }
	CoupledBundle::Matrix getBundleInverse(const SystemInput&, int bundle) const { return m_bundles[size_t(bundle)]; }
};

double InteriorPoint::frictionBound(const SystemInput::SingleRow& friction, const SystemInput& input) const
{
	const int normal = input.m_singleRows[size_t(friction.m_normal)].m_row;
	return friction.getFrictionBound(std::max(LEAST_NORMAL, m_impulse[size_t(normal)]));
}

/// Calls f with each fibre's row, its coupling and the rows of its bundle's shears.
template <class F>
void InteriorPoint::forEachFibre(const SystemInput& input, const SystemInput::Bundle& bundle, F f)
{
	const SystemInput::Unit& unit = input.m_units[size_t(bundle.m_unit)];
	for (int i = 0; i < unit.m_numFibres; ++i)
		f(size_t(unit.getFirstFibreRow() + i), input.m_couplings[size_t(bundle.m_firstCoupling + i)].m_shear);
}

/// to += factor times what the partners' impulses add to C lambda.
void InteriorPoint::addCoupling(const SystemInput& input, double factor, std::vector<double>& to) const
{
	for (const SystemInput::Bundle& bundle : input.m_bundles)
		for (int s = 0; s < 2; ++s)
		{
			const int shear = bundle.m_shearRow[s];
			if (shear >= 0)
				forEachFibre(input, bundle,
							 [&](size_t fibre, const double coupling[2])
							 {
								 to[fibre] += factor * coupling[s] * m_impulse[size_t(shear)];
								 to[size_t(shear)] += factor * coupling[s] * m_impulse[fibre];
							 });
		}
	for (const Pair& pair : m_pairsOfRows)
		for (int k = 0; k < 2; ++k)
			to[size_t(pair.m_row[k])] += factor * pair.m_coupling * m_impulse[size_t(pair.m_row[1 - k])];
}

/// Impulses in the middle of their bounds, those of contacts at what stops the approach.
void InteriorPoint::beginRows(const SystemInput& input, const AugmentedContacts& contacts)
{
	const size_t n = input.m_rows.size();
	m_pairsOfRows.clear();
	for (std::vector<double>* terms : {&m_target, &m_compliance, &m_lower, &m_upper, &m_isOpen, &m_impulse})
		terms->resize(n);
	for (std::vector<double>* terms : {&m_lowerPush, &m_upperPush, &m_lowerChange, &m_upperChange, &m_impulseChange})
		terms->assign(n, 0.);
	for (size_t i = 0; i < n; ++i)
	{
		const SystemInput::Bounded& row = input.m_rows[i];
		m_target[i] = row.m_target;
		m_compliance[i] = row.m_compliance;
		m_lower[i] = std::max(row.m_lower, -NO_BOUND);
		m_upper[i] = std::min(row.m_upper, NO_BOUND);
		m_isOpen[i] = m_upper[i] > m_lower[i] ? 1 : 0;
		m_impulse[i] = 0.5 * (m_lower[i] + m_upper[i]);
		if (row.m_partner > int(i))
			m_pairsOfRows.push_back({{int(i), row.m_partner}, row.m_coupling});
	}
	m_friction.clear();
	for (int i = 0; i < input.getNumSingleRows(); ++i)
	{
		const SystemInput::SingleRow& single = input.m_singleRows[size_t(i)];
		if (!single.m_isContact)
			continue;
		const size_t r = size_t(single.m_row);
		const double softened = m_compliance[r];
		const SystemInput::Bounded hard = contacts.getHardRow(input, i);
		m_target[r] = hard.m_target;
		m_compliance[r] = hard.m_compliance;
		if (single.m_normal < 0)
		{
			const double approach = std::max(fabs(m_target[r] - m_along[r]), SLOWEST_CONTACT);
			m_impulse[r] =
				std::max(m_lower[r], 0.) + FIRST_CONTACT * approach / (100 * softened) + input.m_guess[r].m_impulse;
			continue;
		}
		m_friction.push_back(i);
		m_upper[r] = frictionBound(single, input);
		m_lower[r] = -m_upper[r];
		m_isOpen[r] = m_upper[r] > 0 ? 1 : 0;
		m_impulse[r] = 0;
	}
	// Rows without bounds are linear.
	for (size_t i = 0; i < n; ++i)
		if (m_lower[i] <= -NO_BOUND && m_upper[i] >= NO_BOUND)
			m_impulse[i] = (m_target[i] - m_along[i]) / m_compliance[i];
}

/// What the bounds push with: it balances the row, with the barrier beside it.
void InteriorPoint::beginAtCentre(const SystemInput& input)
{
	const size_t n = m_impulse.size();
	double beyond = 0;
	m_pairs = 0;
	m_rest.resize(n);
	for (size_t i = 0; i < n; ++i)
		m_rest[i] = m_compliance[i] * m_impulse[i] + m_along[i] - m_target[i];
	addCoupling(input, 1, m_rest);
	for (size_t i = 0; i < n; ++i)
	{
		const double open = m_isOpen[i];
		const double below = m_impulse[i] - m_lower[i], above = m_upper[i] - m_impulse[i];
		const double rest = m_rest[i];
		const double gap = std::min(below, above);
		m_pairs += 2 * open;
		if (gap < NO_BOUND / 2)
			beyond += open * fabs(rest) * gap;
	}
	const double barrier = FIRST_BARRIER * 2 * beyond / std::max(m_pairs, 1.);
	double sum = 0;
	for (size_t i = 0; i < n; ++i)
	{
		if (m_isOpen[i] == 0)
			continue;
		const double below = m_impulse[i] - m_lower[i], above = m_upper[i] - m_impulse[i];
		const double rest = m_rest[i];
		m_lowerPush[i] = barrier / below + (below < NO_BOUND / 2 ? std::max(rest, 0.) : 0.);
		m_upperPush[i] = barrier / above + (above < NO_BOUND / 2 ? std::max(-rest, 0.) : 0.);
		sum += m_lowerPush[i] * below + m_upperPush[i] * above;
	}
	m_mu = sum / std::max(m_pairs, 1.);
}

/// The tangents of all rows.
void InteriorPoint::weigh(const SystemInput& input)
{
	const size_t n = m_impulse.size();
	m_tangent.resize(n);
	m_overBelow.resize(n);
	m_overAbove.resize(n);
	for (size_t i = 0; i < n; ++i)
	{
		const double open = m_isOpen[i], shut = 1 - open;
		m_overBelow[i] = open / (m_impulse[i] - m_lower[i] + shut);
		m_overAbove[i] = open / (m_upper[i] - m_impulse[i] + shut);
		m_tangent[i] = open / (m_compliance[i] + m_lowerPush[i] * m_overBelow[i] + m_upperPush[i] * m_overAbove[i]);
	}
	m_beside.assign(n, 0.);
	for (const Pair& pair : m_pairsOfRows)
	{
		// The inverse of [ 1 / a, c; c, 1 / b ]; a row that is shut has a = 0, and takes no part.
		double &a = m_tangent[size_t(pair.m_row[0])], &b = m_tangent[size_t(pair.m_row[1])];
		const double share = 1 / (1 - pair.m_coupling * pair.m_coupling * a * b);
		m_beside[size_t(pair.m_row[0])] = m_beside[size_t(pair.m_row[1])] = -pair.m_coupling * a * b * share;
		a *= share;
		b *= share;
	}
	weighBundles(input);
}

/// Of the shears of bundles, whose own tangents become 0: their part is in the inverse.
void InteriorPoint::weighBundles(const SystemInput& input)
{
	m_bundles.resize(input.m_bundles.size());
	for (size_t b = 0; b < m_bundles.size(); ++b)
	{
		const SystemInput::Bundle& bundle = input.m_bundles[b];
		CoupledBundle::Matrix matrix = {{1, 0, 1}};
		bool isOpen[2] = {};
		for (int s = 0; s < 2; ++s)
		{
			const int row = bundle.m_shearRow[s];
			isOpen[s] = row >= 0 && m_isOpen[size_t(row)] != 0;
			if (!isOpen[s])
				continue;
			matrix.m_elements[2 * s] = 1 / m_tangent[size_t(row)];
			m_tangent[size_t(row)] = 0;
		}
		forEachFibre(input, bundle,
					 [&](size_t fibre, const double coupling[2]) { matrix.subtract(m_tangent[fibre], coupling); });
		m_bundles[b] = matrix.inverse(isOpen[0], isOpen[1]);
	}
}

/// to += (C + D)^-1 from, beyond what the rows' own tangents give.
void InteriorPoint::addBundles(const SystemInput& input, const std::vector<double>& from, std::vector<double>& to) const
{
	for (size_t b = 0; b < m_bundles.size(); ++b)
	{
		const SystemInput::Bundle& bundle = input.m_bundles[b];
		double right[2] = {};
		for (int s = 0; s < 2; ++s)
			if (bundle.m_shearRow[s] >= 0)
				right[s] = from[size_t(bundle.m_shearRow[s])];
		forEachFibre(input, bundle,
					 [&](size_t fibre, const double coupling[2])
					 {
						 for (int s = 0; s < 2; ++s)
							 right[s] -= coupling[s] * m_tangent[fibre] * from[fibre];
					 });
		const double shear[2] = {m_bundles[b].multiply(0, right), m_bundles[b].multiply(1, right)};
		for (int s = 0; s < 2; ++s)
			if (bundle.m_shearRow[s] >= 0)
				to[size_t(bundle.m_shearRow[s])] += shear[s];
		forEachFibre(input, bundle,
					 [&](size_t fibre, const double coupling[2])
					 { to[fibre] -= m_tangent[fibre] * (coupling[0] * shear[0] + coupling[1] * shear[1]); });
	}
}

/// Finds the change of dv, and of all impulses, for m_right.
bool InteriorPoint::solveStep(const SystemInput& input, LinearSolver& solver)
{
	const size_t n = m_impulse.size();
	for (size_t i = 0; i < n; ++i)
		m_work[i] = m_right[i] * m_tangent[i];
	for (const Pair& pair : m_pairsOfRows)
		for (int k = 0; k < 2; ++k)
			m_work[size_t(pair.m_row[k])] += m_right[size_t(pair.m_row[1 - k])] * m_beside[size_t(pair.m_row[k])];
	addBundles(input, m_right, m_work);
	m_change = m_momentum;
	addImpulses(input, m_work.data(), m_change);
	if (!solver.solve(m_change))
		return false;
	project(input, m_change, m_work);
	for (size_t i = 0; i < n; ++i)
		m_impulseChange[i] = (m_right[i] - m_work[i]) * m_tangent[i];
	for (const Pair& pair : m_pairsOfRows)
		for (int k = 0; k < 2; ++k)
		{
			const size_t i = size_t(pair.m_row[k]), partner = size_t(pair.m_row[1 - k]);
			m_impulseChange[i] += (m_right[partner] - m_work[partner]) * m_beside[i];
		}
	if (!m_bundles.empty())
	{
		m_rest.resize(n);
		for (size_t i = 0; i < n; ++i)
			m_rest[i] = m_right[i] - m_work[i];
		addBundles(input, m_rest, m_impulseChange);
	}
	return true;
}

/// The predictor's step aims at no barrier. Along it the products of pushes and distances are known in closed form.
bool InteriorPoint::predict(const SystemInput& input, LinearSolver& solver)
{
	const size_t n = m_impulse.size();
	m_right.resize(n);
	m_work.resize(n);
	for (size_t i = 0; i < n; ++i)
		m_right[i] = m_isOpen[i] * (m_target[i] - m_along[i] - m_compliance[i] * m_impulse[i]);
	addCoupling(input, -1, m_right);
	if (!solveStep(input, solver))
		return false;
	double most = 1;   // the greatest of what falls in the step, over what there is of it
	double curve = 0;  // what the products have in the square of the step's share
	for (size_t i = 0; i < n; ++i)
	{
		const double change = m_impulseChange[i];
		const double towardsLower = -change * m_overBelow[i], towardsUpper = change * m_overAbove[i];
		most = std::max(most,
						std::max(std::max(towardsLower, 1 - towardsLower), std::max(towardsUpper, 1 - towardsUpper)));
		curve -= change * (m_lowerPush[i] * (1 - towardsLower) - m_upperPush[i] * (1 - towardsUpper));
	}
	// Mehrotra's rule: the cube of what the longest step would leave of the barrier.
	const double share = 1 / most, left = 1 - share + share * share * curve / (m_pairs * m_mu);
	m_centring = left * left * left;
	return true;
}

/// The corrector's step aims at m_centring of the barrier, with the predictor's products of changes.
/// \return the longest share of it that keeps within all bounds; 0 if there is none
double InteriorPoint::correct(const SystemInput& input, LinearSolver& solver)
{
	const size_t n = m_impulse.size();
	const double aim = m_centring * m_mu;
	for (size_t i = 0; i < n; ++i)
	{
		const double predicted = m_impulseChange[i];
		const double towardsLower = -predicted * m_overBelow[i], towardsUpper = predicted * m_overAbove[i];
		// What the pushes change by if the impulse does not.
		m_lowerChange[i] = (aim + predicted * m_lowerPush[i] * (1 - towardsLower)) * m_overBelow[i] - m_lowerPush[i];
		m_upperChange[i] = (aim - predicted * m_upperPush[i] * (1 - towardsUpper)) * m_overAbove[i] - m_upperPush[i];
		m_right[i] += m_isOpen[i] * (m_lowerChange[i] + m_lowerPush[i] - m_upperChange[i] - m_upperPush[i]);
	}
	if (!solveStep(input, solver))
		return 0;
	double most = 1;
	for (size_t i = 0; i < n; ++i)
	{
		const double change = m_impulseChange[i];
		const double towardsLower = -change * m_overBelow[i], towardsUpper = change * m_overAbove[i];
		m_lowerChange[i] += m_lowerPush[i] * towardsLower;
		m_upperChange[i] += m_upperPush[i] * towardsUpper;
		most = std::max(most, std::max(towardsLower, towardsUpper));
		// A push that is zero belongs to a row that is shut, and stays.
		const double lower = m_lowerChange[i] + most * m_lowerPush[i], upper = m_upperChange[i] + most * m_upperPush[i];
		if (lower < 0)
			most = -m_lowerChange[i] / m_lowerPush[i];
		if (upper < 0)
			most = std::max(most, -m_upperChange[i] / m_upperPush[i]);
	}
	return 1 / most;
}

/// Friction's bounds follow the normal impulses, and its impulses their bounds.
void InteriorPoint::moveFriction(const SystemInput& input)
{
	for (const int i : m_friction)
	{
		const SystemInput::SingleRow& friction = input.m_singleRows[size_t(i)];
		const size_t r = size_t(friction.m_row);
		const double bound = frictionBound(friction, input);
		if (m_isOpen[r] == 0)
			continue;
		const double change = m_impulse[r] * (bound / m_upper[r] - 1);
		m_impulse[r] += change;
		addImpulse(friction.m_body, friction.m_J, change, m_momentum);
		m_upper[r] = bound;
		m_lower[r] = -bound;
	}
}

void InteriorPoint::sumBarrier()
{
	double sum = 0;
	const size_t n = m_impulse.size();
	for (size_t i = 0; i < n; ++i)
		sum +=
			m_isOpen[i] * (m_lowerPush[i] * (m_impulse[i] - m_lower[i]) + m_upperPush[i] * (m_upper[i] - m_impulse[i]));
	m_mu = sum / m_pairs;
}

bool InteriorPoint::solve(const SystemInput& input, const AugmentedContacts& contacts, SystemMatrix& matrix,
						  LinearSolver& solver, std::vector<double>& velocity, int maxIterations, long long workEnd)
{
	const std::vector<double> start = velocity;
	project(input, velocity, m_along);
	beginRows(input, contacts);
	beginAtCentre(input);
	m_momentum.assign(velocity.size(), 0.);
	multiplyMass(input, velocity, m_momentum);
	for (double& element : m_momentum)
		element = -element;
	addImpulses(input, m_impulse.data(), m_momentum);
	addCondensedMomentum(input, m_momentum);
	const double barrierEnd = BARRIER_END * m_mu, momentumEnd = MOMENTUM_END * largest(m_momentum),
				 lastFriction = LAST_FRICTION * m_mu;
	if (!(m_mu > 0))
		return false;
	long long stepWork = 0;
	for (int i = 0; i < maxIterations && (m_mu > barrierEnd || largest(m_momentum) > momentumEnd) &&
					!(workEnd > 0 && m_statistics.m_work + stepWork > workEnd);
		 ++i)
	{
		const long long workBefore = m_statistics.m_work;
		m_statistics.m_work += (long long)(ITERATION_A_ROW * double(input.getNumRows()));
		++m_statistics.m_interiorIterations;
		{
			const ScopedTimer timer("elastic-plastic assemble", m_statistics.m_assemblyTime, m_measuresTime);
			weigh(input);
			matrix.assembleAnew(input, Tangents{m_tangent, m_beside, m_bundles});
		}
		if (!predict(input, solver))
			break;
		const double share = std::min(1., MOST_OF_THE_WAY * correct(input, solver));
		if (!(share > 0))
			break;
		const size_t n = m_impulse.size();
		for (size_t r = 0; r < n; ++r)
		{
			m_impulse[r] += share * m_impulseChange[r];
			m_lowerPush[r] += share * m_lowerChange[r];
			m_upperPush[r] += share * m_upperChange[r];
			m_along[r] += share * m_work[r];
		}
		for (size_t k = 0; k < velocity.size(); ++k)
		{
			velocity[k] += share * m_change[k];
			m_momentum[k] *= 1 - share;
		}
		if (m_mu > lastFriction)
			moveFriction(input);
		sumBarrier();
		stepWork = m_statistics.m_work - workBefore;
		if (!(m_mu > 0 && m_mu < 1e300))
		{
			velocity = start;
			return false;
		}
	}
	return true;
}
}  // namespace btElasticPlastic
