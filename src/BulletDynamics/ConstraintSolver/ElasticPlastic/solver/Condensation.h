// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CONDENSATION_H
#define BT_ELASTIC_PLASTIC_CONDENSATION_H

#include <stdint.h>
#include <vector>

#include "AdmissibleBox.h"
#include "SystemMatrix.h"

namespace btElasticPlastic
{
/// Makes a small problem of a large one in which rows reach or leave their bounds in one place only.
///
/// Some bodies are inside, around that place. All rows with a body outside are taken as linear, at or between the bounds at which they
/// are, so bodies outside can be eliminated once and for all: what they leave is a mass and a momentum of the bodies inside that have
/// rows to the outside (static condensation). The search then runs inside, with a matrix as small as the place. Afterwards the motion
/// of the bodies outside follows, and whether their rows have kept to their bounds.
class Condensation
{
public:
	/// \param buffers  see LinearSolver
	explicit Condensation(btElasticPlasticStatistics& statistics, BufferPool* buffers = nullptr)
		: m_linearSolver(statistics, buffers), m_matrix(m_linearSolver)
	{
	}

	void setSettings(const btElasticPlasticSolverSettings& settings) { m_linearSolver.setSettings(settings); }
	void beginStep(bool isOneOfMany) { m_linearSolver.beginStep(isOneOfMany); }

	/// Forgets what is inside.
	void clear()
	{
		m_inside.clear();
		m_matrix.lendBuffers();
	}
	bool isEmpty() const { return m_inside.empty(); }

	/// Chooses what is inside: some bodies, and those that rows lead to from there.
	/// \param rings  how many rows away at most
	/// \return false if that would be too much of the whole to gain anything: then there is nothing inside
	bool choose(const SystemInput& input, const std::vector<int>& bodies, int rings);

	/// Adds to what is inside. \return as choose()
	bool enlarge(const SystemInput& input, const std::vector<int>& bodies, int rings);

	/// Eliminates the bodies outside.
	/// \param box         its bounds are those at which rows outside stay
	/// \param operations  of a factor of the whole
	/// \return false if that fails, or if the border is so long that its matrix, which is dense, would take too much of that
	bool condense(const SystemInput& input, const AdmissibleBox& box, int64_t operations);

	/// The same after the rows' targets have changed; bodies, Jacobians and bounds have not.
	bool condenseAgain(const SystemInput& input, const AdmissibleBox& box);

	/// The problem inside.
	SystemInput& getInput() { return m_input; }

	/// The motion of all bodies for that of those inside.
	/// \param inside  6 doubles by body inside
	void expand(const std::vector<double>& inside, std::vector<double>& velocity);

	/// Of the whole problem, by row of the problem inside.
	const std::vector<int>& getRows() const { return m_rows; }
	/// The terms of a row inside as the whole problem has them.
	SystemInput::Bounded getTerms(int rowInside) const
	{
		SystemInput::Bounded terms = m_input.m_rows[size_t(rowInside)];
		if (terms.m_partner >= 0)
			terms.m_partner = m_rows[size_t(terms.m_partner)];
		return terms;
	}
	/// Of the whole problem.
	bool isRowInside(int row) const { return m_isRowInside[size_t(row)] != 0; }

private:
	bool isWorthIt(const SystemInput& input) const;
	void split(const SystemInput& input);
	void fillRows(const SystemInput& input, const AdmissibleBox& box);
	bool findMomentum();
	void addRings(std::vector<int> bodies, int rings);

	LinearSolver m_linearSolver;
	SystemMatrix m_matrix;
	std::vector<char> m_inside;  // by body
	int m_numInside = 0;
	SystemInput m_input;  // the problem inside
	SystemInput m_outer;  // the bodies outside, then those at the border, and the rows that are linear
	std::vector<int> m_bodies, m_outerBodies;  // of the whole problem, by body of these two
	std::vector<int> m_rows, m_outerRows;      // the same by row
	std::vector<char> m_isRowInside;
	std::vector<int> m_innerIndex, m_outerIndex;  // by body of the whole problem, -1: none
	std::vector<int> m_place;                     // by row of the whole problem: its row inside, or outside
	AdmissibleBox m_outerBox;                     // with the bounds at which rows outside stay
	std::vector<double> m_still;                  // by body of m_outer: their motion if nothing inside did anything
	std::vector<double> m_momentum, m_motion;
	// Bodies' neighbours.
	std::vector<int> m_start, m_neighbours;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_CONDENSATION_H
