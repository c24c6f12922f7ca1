// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Condensation.h"

#include <algorithm>

#include "Jacobian.h"

namespace btElasticPlastic
{
namespace
{
/// More than this share of the bodies inside gains nothing: the border's matrix is dense.
const int LEAST_OUTSIDE = 3;
/// Rings end when they have added so many bodies: in a solid a few of them hold as many as many do in a wall.
const int ENOUGH = 80;

/// Calls f with the two bodies of each unit and single row.
template <class F>
void forEachPair(const SystemInput& input, F f)
{
	for (const SystemInput::Unit& unit : input.m_units)
		f(unit.m_body);
	for (const SystemInput::SingleRow& row : input.m_singleRows)
		f(row.m_body);
}
}  // namespace

bool Condensation::isWorthIt(const SystemInput& input) const
{
	return m_numInside > 0 && LEAST_OUTSIDE * m_numInside < input.getNumBodies();
}

bool Condensation::choose(const SystemInput& input, const std::vector<int>& bodies, int rings)
{
	const size_t n = input.m_bodies.size();
	m_inside.assign(n, 0);
	m_numInside = 0;
	m_start.assign(n + 2, 0);
	forEachPair(input,
				[&](const int body[2])
				{
					for (int side = 0; side < 2 && body[0] >= 0 && body[1] >= 0; ++side)
						++m_start[size_t(body[side]) + 2];
				});
	for (size_t i = 2; i < m_start.size(); ++i)
		m_start[i] += m_start[i - 1];
	m_neighbours.resize(size_t(m_start.back()));
	forEachPair(input,
				[&](const int body[2])
				{
					for (int side = 0; side < 2 && body[0] >= 0 && body[1] >= 0; ++side)
						m_neighbours[size_t(m_start[size_t(body[side]) + 1]++)] = body[1 - side];
				});
	return enlarge(input, bodies, rings);
}

bool Condensation::enlarge(const SystemInput& input, const std::vector<int>& bodies, int rings)
{
	addRings(bodies, rings);
	if (isWorthIt(input))
		return true;
	clear();
	return false;
}

/// \param bodies  may be named many times, as they are where many points touch
void Condensation::addRings(std::vector<int> bodies, int rings)
{
	std::sort(bodies.begin(), bodies.end());
	bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
	std::vector<char> isNamed(m_inside.size(), 0);
	for (const int body : bodies)
		isNamed[size_t(body)] = 1;
	std::vector<int> next;
	const int enough = m_numInside + ENOUGH;
	for (int ring = 0; ring <= rings && (ring < 2 || m_numInside < enough); ++ring)
	{
		next.clear();
		for (const int body : bodies)
		{
			m_numInside += !m_inside[size_t(body)];
			m_inside[size_t(body)] = 1;
			for (int i = m_start[size_t(body)]; i < m_start[size_t(body) + 1]; ++i)
			{
				const int neighbour = m_neighbours[size_t(i)];
				if (!m_inside[size_t(neighbour)] && !isNamed[size_t(neighbour)])
					next.push_back(neighbour);
				isNamed[size_t(neighbour)] = 1;
			}
		}
		bodies.swap(next);
	}
}

/// Parts bodies and rows. A row of bodies inside only, and of what does not move, is inside.
void Condensation::split(const SystemInput& input)
{
	const size_t n = input.m_bodies.size();
	const auto isInside = [&](const int body[2])
	{ return (body[0] < 0 || m_inside[size_t(body[0])]) && (body[1] < 0 || m_inside[size_t(body[1])]); };
	m_input.clear();
	m_outer.clear();
	m_bodies.clear();
	m_outerBodies.clear();
	m_innerIndex.assign(n, -1);
	m_outerIndex.assign(n, -1);
	for (size_t b = 0; b < n; ++b)
		if (!m_inside[b])
		{
			m_outerIndex[b] = m_outer.getNumBodies();
			m_outer.addBody() = input.m_bodies[b];
			m_outerBodies.push_back(int(b));
		}
	std::vector<char> isAtBorder(n, 0);
	forEachPair(input,
				[&](const int body[2])
				{
					for (int side = 0; side < 2 && !isInside(body); ++side)
						if (body[side] >= 0 && m_inside[size_t(body[side])])
							isAtBorder[size_t(body[side])] = 1;
				});
	std::vector<int>& border = m_input.m_condensed.m_bodies;
	for (size_t b = 0; b < n; ++b)
	{
		if (!m_inside[b])
			continue;
		m_innerIndex[b] = m_input.getNumBodies();
		m_bodies.push_back(int(b));
		SystemInput::Body& body = m_input.addBody();
		body = input.m_bodies[b];
		if (!isAtBorder[b])
			continue;
		// Its mass is in what is condensed.
		border.push_back(m_innerIndex[b]);
		m_outerIndex[b] = m_outer.getNumBodies();
		m_outer.addBody() = input.m_bodies[b];
		m_outerBodies.push_back(int(b));
		std::fill(body.m_mass, body.m_mass + 3, 0.);
		std::fill(body.m_inertia, body.m_inertia + 9, 0.);
	}
	m_rows.clear();
	m_outerRows.clear();
	m_isRowInside.assign(input.m_rows.size(), 0);
	const auto place = [&](const std::vector<int>& index, const int from[2], int to[2])
	{
		for (int side = 0; side < 2; ++side)
			to[side] = from[side] < 0 ? -1 : index[size_t(from[side])];
	};
	for (const SystemInput::Unit& from : input.m_units)
	{
		const bool inside = isInside(from.m_body);
		SystemInput& to = inside ? m_input : m_outer;
		SystemInput::Unit& unit = to.addUnit(from.m_numRows, from.m_numFibres);
		const int firstRow = unit.m_firstRow, firstFibre = unit.m_firstFibre;
		unit = from;
		unit.m_firstRow = firstRow;
		unit.m_firstFibre = firstFibre;
		for (int i = 0; i < from.m_numFibres; ++i)
			to.m_fibres[size_t(firstFibre + i)] = input.m_fibres[size_t(from.m_firstFibre + i)];
		if (from.m_bundle >= 0)
		{
			SystemInput::Bundle bundle = input.m_bundles[size_t(from.m_bundle)];
			bundle.m_unit = int(to.m_units.size()) - 1;
			for (int& row : bundle.m_shearRow)
				row += row >= 0 ? firstRow - from.m_firstRow : 0;
			bundle.m_firstCoupling = int(to.m_couplings.size());
			to.m_couplings.resize(to.m_couplings.size() + size_t(from.m_numFibres));
			unit.m_bundle = int(to.m_bundles.size());
			to.m_bundles.push_back(bundle);
		}
		place(inside ? m_innerIndex : m_outerIndex, from.m_body, unit.m_body);
		for (int r = 0; r < from.m_numRows; ++r)
		{
			(inside ? m_rows : m_outerRows).push_back(from.m_firstRow + r);
			m_isRowInside[size_t(from.m_firstRow + r)] = inside;
		}
	}
	std::vector<int> singleRowOf(input.m_singleRows.size(), -1);
	for (size_t i = 0; i < input.m_singleRows.size(); ++i)
	{
		const SystemInput::SingleRow& from = input.m_singleRows[i];
		const bool inside = isInside(from.m_body);
		SystemInput& to = inside ? m_input : m_outer;
		singleRowOf[i] = to.getNumSingleRows();
		SystemInput::SingleRow& row = to.addSingleRow();
		const int index = row.m_row;
		row = from;
		row.m_row = index;
		// A normal's row comes before its friction's, between the same bodies.
		row.m_normal = from.m_normal >= 0 ? singleRowOf[size_t(from.m_normal)] : -1;
		place(inside ? m_innerIndex : m_outerIndex, from.m_body, row.m_body);
		(inside ? m_rows : m_outerRows).push_back(from.m_row);
		m_isRowInside[size_t(from.m_row)] = inside;
	}
}

/// Takes the rows' terms, and the bounds at which those outside stay.
void Condensation::fillRows(const SystemInput& input, const AdmissibleBox& box)
{
	const auto fill = [&](const std::vector<int>& rows, SystemInput& to)
	{
		for (size_t i = 0; i < rows.size(); ++i)
			m_place[size_t(rows[i])] = int(i);
		for (size_t i = 0; i < rows.size(); ++i)
		{
			to.m_rows[i] = input.m_rows[size_t(rows[i])];
			// A row's partner is of the same unit or of the same bodies, so it is on the same side.
			if (to.m_rows[i].m_partner >= 0)
				to.m_rows[i].m_partner = m_place[size_t(to.m_rows[i].m_partner)];
			to.m_guess[i] = {box.getImpulse(rows[i]), *box.getBounds(rows[i])};
		}
	};
	m_place.resize(input.m_rows.size());
	fill(m_rows, m_input);
	fill(m_outerRows, m_outer);
	// Bundles, and their couplings, are in the order of their units on either side.
	size_t next[2] = {0, 0};
	for (const SystemInput::Bundle& bundle : input.m_bundles)
	{
		const SystemInput::Unit& unit = input.m_units[size_t(bundle.m_unit)];
		const bool isInside = isRowInside(unit.m_firstRow);
		SystemInput& to = isInside ? m_input : m_outer;
		for (int i = 0; i < unit.m_numFibres; ++i)
			to.m_couplings[next[isInside]++] = input.m_couplings[size_t(bundle.m_firstCoupling + i)];
	}
	m_outerBox.begin(m_outer);
	m_outerBox.holdBounds(m_outer);
}

/// What the rows outside give to the border.
bool Condensation::findMomentum()
{
	m_momentum.assign(6 * m_outer.m_bodies.size(), 0.);
	addImpulses(m_outer, m_outerBox.getImpulses(0), m_momentum);
	m_still = m_momentum;
	if (!m_linearSolver.solve(m_still))
		return false;
	const size_t first = 6 * (m_outer.m_bodies.size() - m_input.m_condensed.m_bodies.size());
	const std::vector<double>& matrix = m_input.m_condensed.m_matrix;
	std::vector<double>& momentum = m_input.m_condensed.m_momentum;
	const size_t size = m_still.size() - first;
	momentum.assign(size, 0.);
	for (size_t j = 0; j < size; ++j)
		for (size_t i = 0; i < size; ++i)
			momentum[i] += matrix[j * size + i] * m_still[first + j];
	return true;
}

bool Condensation::condense(const SystemInput& input, const AdmissibleBox& box, int64_t operations)
{
	split(input);
	const double border = 6 * double(m_input.m_condensed.m_bodies.size());
	// Each step of the search inside takes the border's factor.
	if (border * border * border / 3 > double(operations))
		return false;
	fillRows(input, box);
	m_matrix.begin(m_outer, 0, 1, int(m_input.m_condensed.m_bodies.size()));
	m_matrix.assembleAnew(m_outer, m_outerBox);
	std::vector<double> nothing(6 * m_outer.m_bodies.size(), 0.);
	if (!m_linearSolver.solve(nothing))
		return false;
	m_linearSolver.getComplement(m_input.m_condensed.m_matrix);
	return findMomentum();
}

bool Condensation::condenseAgain(const SystemInput& input, const AdmissibleBox& box)
{
	fillRows(input, box);
	return findMomentum();
}

void Condensation::expand(const std::vector<double>& inside, std::vector<double>& velocity)
{
	const std::vector<int>& border = m_input.m_condensed.m_bodies;
	const std::vector<double>& matrix = m_input.m_condensed.m_matrix;
	const size_t size = 6 * border.size(), first = m_still.size() - size;
	// The force that moves the border as the bodies inside have moved it, on top of its motion without them.
	m_motion = m_momentum;
	for (size_t j = 0; j < size; ++j)
	{
		const double motion = inside[6 * size_t(border[j / 6]) + j % 6] - m_still[first + j];
		for (size_t i = 0; i < size; ++i)
			m_motion[first + i] += matrix[j * size + i] * motion;
	}
	m_linearSolver.solve(m_motion);
	for (size_t b = 0; b < m_outerBodies.size(); ++b)
		for (size_t i = 0; i < 6; ++i)
			velocity[6 * size_t(m_outerBodies[b]) + i] = m_motion[6 * b + i];
	for (size_t b = 0; b < m_bodies.size(); ++b)
		for (size_t i = 0; i < 6; ++i)
			velocity[6 * size_t(m_bodies[b]) + i] = inside[6 * b + i];
}
}  // namespace btElasticPlastic
