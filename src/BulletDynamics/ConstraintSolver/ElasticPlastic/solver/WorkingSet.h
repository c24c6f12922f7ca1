// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_WORKING_SET_H
#define BT_ELASTIC_PLASTIC_WORKING_SET_H

#include <vector>

#include "../linear/LinearSolver.h"
#include "AdmissibleBox.h"
#include "SystemInput.h"

namespace btElasticPlastic
{
/// Finds which rows are at their bounds where few differ from a guess, with the guess's factor alone.
///
/// The guess makes each row's impulse linear, lambda = T u + h with u = b - J dv, and H = M + J^T T J has been factorised for it. A row
/// that does not keep to the guess deviates from that by an impulse delta. Of rows S that may deviate
///
///     u = u_0 - W delta,   lambda = lambda_0 + (1 - T W) delta,   W = J_S H^-1 J_S^T,                                   (1)
///
/// and each of them either has what it asks for, C lambda = u, or is at a bound: a small linear complementarity problem. W takes half of a
/// solution by row. The problem is solved by block principal pivoting (Judice and Pires 1994): the rows that are not as they
/// should be change sides, all at once as long as that leaves fewer of them than ever before now and then, and else the last one of
/// them only, which ends. Then all rows are looked at, those that have left the guess join the set, and so on.
///
/// In a structure that collapses 10 to 60 of some thousand rows reach or leave a bound in a step. Newton's steps become short there, as
/// each of them sees the ones that come next, and each takes a factor; here none does.
class WorkingSet
{
public:
	explicit WorkingSet(btElasticPlasticStatistics& statistics) : m_statistics(statistics) {}

	/// As btElasticPlasticSolverSettings::m_measuresTime.
	void measureTime(bool isMeasured) { m_measuresTime = isMeasured; }

	/// Begins a problem at the solution for a guess, before the rows are asked what they make of it.
	void begin(const AdmissibleBox& box, const std::vector<double>& velocity);

	/// Takes the rows in that have left the guess, and solves for them.
	/// \param box       after project() at the last velocity: which rows have left
	/// \param along     J dv of all rows at that velocity
	/// \param solver    with the guess's factor
	/// \param velocity  dv for the guess before the first call; gets that of the set
	/// \return whether it has been solved; false: too many rows, or no end in sight
	bool solve(const SystemInput& input, const AdmissibleBox& box, const std::vector<double>& along,
			   LinearSolver& solver, std::vector<double>& velocity);

	/// The most that the next call of solve() may take, as btElasticPlasticStatistics::m_work, beside the linear solver's.
	long long getMostWork() const;

	/// Whether the rows' bounds are those for which the last velocity has been found, but for rounding in the set: then the search has ended.
	bool isRight(const AdmissibleBox& box) const;

private:
	struct Member
	{
		int m_row;
		int m_partner;  ///< of the set, -1: none
		signed char m_guess, m_bound;
		int m_body[2];
		double m_J[12];
		double m_u, m_impulse;    ///< for the guess
		double m_along, m_delta;  ///< W delta, delta
		HalfSolution m_half;
	};
	typedef CoupledPair<double> Pair;

	bool choose(const SystemInput& input, const AdmissibleBox& box, const std::vector<double>& along);
	bool takeIn(const SystemInput& input, const AdmissibleBox& box, LinearSolver& solver);
	void add(const SystemInput& input, int row);
	Pair pairOf(const SystemInput& input, const Member& member) const;
	static double boundOf(const SystemInput::Bounded& row, signed char bound);
	void linearise(const SystemInput& input, Member& member) const;
	double answer(size_t i, size_t j) const { return m_answers[i < j ? j * (j + 1) / 2 + i : i * (i + 1) / 2 + j]; }
	double withTangent(const SystemInput& input, size_t i, size_t j) const;
	double withoutTangent(const SystemInput& input, size_t i, size_t j) const;
	bool isAsGuessed(const Member& member) const { return member.m_bound == member.m_guess; }
	bool hasChanged(const Member& member) const
	{
		return !isAsGuessed(member) || (member.m_partner >= 0 && !isAsGuessed(m_members[size_t(member.m_partner)]));
	}
	bool solveFor(const SystemInput& input);
	static double workOf(size_t numChanged);
	bool eliminate(size_t n);
	void findBounds(const SystemInput& input);
	bool pivot(const SystemInput& input);

	std::vector<signed char> m_guess;  // by row
	std::vector<double> m_velocity;    // for the guess
	std::vector<Member> m_members;
	std::vector<double> m_answers;  // W, its lower triangle by rows
	std::vector<char> m_isMember;   // by row
	btElasticPlasticStatistics& m_statistics;
	bool m_measuresTime = false;
	// Work space.
	struct Leaving
	{
		double m_gain;
		int m_row;
	};
	std::vector<Leaving> m_leaving;
	std::vector<size_t> m_changed;
	std::vector<double> m_matrix, m_right;
	std::vector<signed char> m_bounds;  // by member
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_WORKING_SET_H
