// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_INTERIOR_POINT_H
#define BT_ELASTIC_PLASTIC_INTERIOR_POINT_H

#include <vector>

#include "AugmentedContacts.h"
#include "SystemMatrix.h"

namespace btElasticPlastic
{
/// Solves a System from within the bounds, for steps in which hundreds of rows reach or leave a bound at once.
///
/// Newton's method (System) goes from kink to kink there, and hundreds of its steps may be needed. Here all bounds are kept off by a
/// barrier mu that falls to zero. With zl and zu, what the bounds push with, the solution has
///
///     M dv = sum J^T lambda,   C lambda + J dv - b = zl - zu,   zl (lambda - lower) = zu (upper - lambda) = mu,
///
/// and a Newton step of these equations is a solution with M + sum J^T (C + D)^-1 J, D = zl / (lambda - lower) + zu / (upper -
/// lambda): the same graph and plan as of H, and no row changes sides. Each factor is used twice, to predict and to correct
/// (S. Mehrotra, On the implementation of a primal-dual interior point method, SIAM J. Optim. 2 (1992) 575-601). Contacts take part
/// without their softening, and friction's bounds follow the normal impulses from iteration to iteration.
///
/// It begins with all impulses in the middle of their bounds, where zl - zu is right at once, and with a barrier well above what
/// rows beyond their bounds have: from there a dozen iterations are enough where hundreds of rows flow.
class InteriorPoint
{
public:
	explicit InteriorPoint(btElasticPlasticStatistics& statistics) : m_statistics(statistics) {}

	/// As btElasticPlasticSolverSettings::m_measuresTime.
	void measureTime(bool isMeasured) { m_measuresTime = isMeasured; }

	/// \param velocity  dv to begin with; gets the solution, of a few digits
	/// \param workEnd   of the statistics' count of work, at which iterations end early; 0: never
	/// \return false if there is nothing to solve, or no number comes out: velocity is as it was
	bool solve(const SystemInput& input, const AugmentedContacts& contacts, SystemMatrix& matrix, LinearSolver& solver,
			   std::vector<double>& velocity, int maxIterations, long long workEnd);

	/// The impulses of the solution, strictly between their bounds; by row.
	const std::vector<double>& getImpulses() const { return m_impulse; }

	/// The upper bounds to which friction has been held; by row.
	const std::vector<double>& getUpperBounds() const { return m_upper; }

private:
	/// A barrier's tangents, for SystemMatrix.
	struct Tangents;

	/// Rows with coupled compliance.
	struct Pair
	{
		int m_row[2];
		double m_coupling;
	};

	template <class F>
	static void forEachFibre(const SystemInput& input, const SystemInput::Bundle& bundle, F f);
	void addCoupling(const SystemInput& input, double factor, std::vector<double>& to) const;
	void beginRows(const SystemInput& input, const AugmentedContacts& contacts);
	void beginAtCentre(const SystemInput& input);
	void weigh(const SystemInput& input);
	void weighBundles(const SystemInput& input);
	void addBundles(const SystemInput& input, const std::vector<double>& from, std::vector<double>& to) const;
	void moveFriction(const SystemInput& input);
	void sumBarrier();
	bool solveStep(const SystemInput& input, LinearSolver& solver);
	bool predict(const SystemInput& input, LinearSolver& solver);
	double correct(const SystemInput& input, LinearSolver& solver);
	double frictionBound(const SystemInput::SingleRow& friction, const SystemInput& input) const;

	btElasticPlasticStatistics& m_statistics;
	bool m_measuresTime = false;
	double m_mu = 0;                 // mean of what the bounds push with, times their distance
	double m_pairs = 0;              // rows with bounds, twice
	double m_centring = 0;           // the share of mu that a step aims at
	std::vector<double> m_momentum;  // J^T lambda - M dv, what is left of it
	std::vector<double> m_change;    // of dv
	// By row.
	std::vector<double> m_target, m_compliance, m_lower, m_upper;
	std::vector<Pair> m_pairsOfRows;
	std::vector<CoupledBundle::Matrix> m_bundles;  // inverses by the shears of each, see CoupledBundle
	std::vector<double> m_isOpen;                  // 1; 0 where both bounds are the same
	std::vector<double> m_impulse, m_lowerPush, m_upperPush;
	std::vector<double> m_overBelow, m_overAbove;  // 1 / distance to the bounds; 0 where both are the same
	std::vector<double> m_along;                   // J dv
	std::vector<double> m_tangent, m_beside;       // (C + D)^-1, on its diagonal and with the row's partner
	std::vector<double> m_right, m_impulseChange, m_lowerChange, m_upperChange;
	std::vector<double> m_work, m_rest;
	std::vector<int> m_friction;  // single rows
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_INTERIOR_POINT_H
