// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "SystemMatrix.h"

#include <string.h>

#include <algorithm>

#include "../linear/Vector3.h"

namespace btElasticPlastic
{
namespace
{
/// Blocks are computed anew by body where changed rows have this share of all bodies or less between them, one over it. A body may be named twice.
const size_t MOST_CHANGED = 2;
}  // namespace

void SystemMatrix::begin(const SystemInput& input, int islandId, int numSolutions, int numLast)
{
	m_edges.clear();
	m_unitEdge.clear();
	m_singleRowEdge.clear();
	for (const SystemInput::Unit& unit : input.m_units)
		m_unitEdge.push_back(addEdge(unit.m_body));
	for (const SystemInput::SingleRow& row : input.m_singleRows)
		m_singleRowEdge.push_back(addEdge(row.m_body));
	m_condensedEdges.clear();
	const std::vector<int>& condensed = input.m_condensed.m_bodies;
	for (size_t i = 0; i < condensed.size(); ++i)
		for (size_t j = 0; j < i; ++j)
		{
			const int pair[2] = {condensed[i], condensed[j]};
			m_condensedEdges.push_back(addEdge(pair));
		}
	m_solver.begin(input.getNumBodies(), m_edges, islandId, numSolutions, numLast);
	m_isAssembled = false;
	m_isWhole = true;
}

/// Rows between the same bodies that follow each other have one edge.
int SystemMatrix::addEdge(const int body[2])
{
	if (body[0] < 0 || body[1] < 0)
		return -1;
	const size_t n = m_edges.size();
	if (n < 2 || m_edges[n - 2] != body[0] || m_edges[n - 1] != body[1])
		m_edges.insert(m_edges.end(), body, body + 2);
	return int(m_edges.size() / 2) - 1;
}

void SystemMatrix::assemble(const SystemInput& input, AdmissibleBox& box)
{
	m_changedBodies.clear();
	for (const SystemInput::Unit& unit : input.m_units)
		noteChange(unit.m_body, box.noteTangent(unit.m_firstRow, unit.m_numRows));
	for (const SystemInput::SingleRow& row : input.m_singleRows)
		noteChange(row.m_body, box.noteTangent(row.m_row, 1));
	m_isWhole = !beginPart(input);
	if (m_isWhole)
	{
		addMasses(input);
		addCondensed(input.m_condensed);
	}
	addRows(input, box);
	m_isWhole = m_isAssembled = true;
	m_solver.setAssembled(m_changedBodies);
}

/// Sets the blocks of changed bodies, and between them, to the bodies' masses.
/// \return false if so much has changed that all are computed anew
bool SystemMatrix::beginPart(const SystemInput& input)
{
	// What is condensed has a dense block among many bodies.
	if (!m_isAssembled || !input.m_condensed.m_bodies.empty() ||
		MOST_CHANGED * m_changedBodies.size() > input.m_bodies.size())
		return false;
	m_isWhole = false;
	m_isChanged.assign(input.m_bodies.size(), 0);
	for (const int body : m_changedBodies)
		if (!m_isChanged[size_t(body)])
		{
			m_isChanged[size_t(body)] = 1;
			double* const block = m_solver.getMatrix().diagonal(body);
			std::fill(block, block + 36, 0.);
			addMass(input, body);
		}
	for (size_t i = 0; i < input.m_units.size(); ++i)
		setZeroInPart(input.m_units[i].m_body, m_unitEdge[i]);
	for (size_t i = 0; i < input.m_singleRows.size(); ++i)
		setZeroInPart(input.m_singleRows[i].m_body, m_singleRowEdge[i]);
	return true;
}

void SystemMatrix::setZeroInPart(const int body[2], int edge)
{
	if (!isEdgeInPart(body, edge))
		return;
	bool transposed;
	double* const block = m_solver.getMatrix().offDiagonal(edge, transposed);
	std::fill(block, block + 36, 0.);
}

void SystemMatrix::addMasses(const SystemInput& input)
{
	m_solver.setMatrixZero();
	for (int b = 0; b < input.getNumBodies(); ++b)
		addMass(input, b);
}

void SystemMatrix::addMass(const SystemInput& input, int body)
{
	double* const block = m_solver.getMatrix().diagonal(body);
	const SystemInput::Body& from = input.m_bodies[size_t(body)];
	for (int i = 0; i < 3; ++i)
	{
		block[7 * i] = from.m_mass[i];
		memcpy(block + 6 * (3 + i) + 3, &from.m_inertia[3 * i], 3 * sizeof(double));
	}
}

void SystemMatrix::addCondensed(const SystemInput::Condensed& condensed)
{
	BlockMatrix& matrix = m_solver.getMatrix();
	const size_t n = condensed.m_bodies.size(), stride = 6 * n;
	const int* edge = m_condensedEdges.data();
	for (size_t i = 0; i < n; ++i)
		for (size_t j = 0; j <= i; ++j)
		{
			// The block of rows of body i and columns of body j.
			const double* const from = &condensed.m_matrix[6 * j * stride + 6 * i];
			bool transposed = false;
			double* const to =
				i == j ? matrix.diagonal(condensed.m_bodies[i]) : matrix.offDiagonal(*edge++, transposed);
			for (size_t c = 0; c < 6; ++c)
				for (size_t r = 0; r < 6; ++r)
					to[transposed ? 6 * r + c : 6 * c + r] += from[c * stride + r];
		}
}

void SystemMatrix::noteChange(const int body[2], bool hasChanged)
{
	for (int side = 0; hasChanged && side < 2; ++side)
		if (body[side] >= 0)
			m_changedBodies.push_back(body[side]);
}

namespace
{
/// What a unit gives to the blocks of its bodies, 3x3 by columns. With its tangent S along the axes and U about them, L of what is coupled
/// of both, and X the matrix of r x, J^T (d lambda / du) J is
///
///     [ S           S X^T + L                     ]
///     [ X S + L^T   X S X^T + X L + L^T X^T + U   ]
///
/// on a body, and minus [ S, S XB^T + L; XA S + L^T, XA S XB^T + XA L + L^T XB^T + U ] between the two.
class UnitBlocks
{
public:
	/// \param mixed  null: nothing is coupled
	UnitBlocks(const SystemInput::Unit& unit, const double linear[9], const double angular[9], const double* mixed)
		: m_unit(unit), m_linear(linear), m_angular(angular), m_mixed(mixed)
	{
		// As S is symmetric, S X^T is the mirror image of X S, and X S X^T the product of X with that.
		for (int side = 0; side < 2; ++side)
			for (int c = 0; c < 3; ++c)
			{
				double moment[3];
				cross(unit.m_arm[side], linear + 3 * c, moment);
				for (int r = 0; r < 3; ++r)
					m_shear[side][3 * r + c] = moment[r];
				if (mixed)
					cross(unit.m_arm[side], mixed + 3 * c, m_turned[side] + 3 * c);
			}
	}

	/// Adds the block of one side's rows and another's columns, or takes it off.
	template <class Add>
	void addTo(double* block, int row, int column, Add add) const
	{
		const double *const right = m_shear[column], *const bottom = m_shear[row];
		for (int c = 0; c < 3; ++c)
		{
			double *const left = block + 6 * c, *const turning = block + 6 * (3 + c), moment[3];
			cross(m_unit.m_arm[row], right + 3 * c, moment);
			for (int r = 0; r < 3; ++r)
			{
				const int i = 3 * c + r, mirrored = 3 * r + c;
				add(left[r], m_linear[i]);
				add(left[3 + r], m_mixed ? bottom[mirrored] + m_mixed[mirrored] : bottom[mirrored]);
				add(turning[r], m_mixed ? right[i] + m_mixed[i] : right[i]);
				const double own = moment[r] + m_angular[i];
				add(turning[3 + r], m_mixed ? own + (m_turned[row][i] + m_turned[column][mirrored]) : own);
			}
		}
	}

private:
	const SystemInput::Unit& m_unit;
	const double *const m_linear, *const m_angular, *const m_mixed;
	double m_shear[2][9];   // S X^T
	double m_turned[2][9];  // X L
};
}  // namespace

void SystemMatrix::addUnit(const SystemInput::Unit& unit, int edge, const double linear[9], const double angular[9],
						   const double* mixed)
{
	const UnitBlocks blocks(unit, linear, angular, mixed);
	BlockMatrix& matrix = m_solver.getMatrix();
	for (int side = 0; side < 2; ++side)
		if (isInPart(unit.m_body[side]))
			blocks.addTo(matrix.diagonal(unit.m_body[side]), side, side, [](double& to, double x) { to += x; });
	if (!isEdgeInPart(unit.m_body, edge))
		return;
	bool transposed;
	double* const block = matrix.offDiagonal(edge, transposed);
	blocks.addTo(block, transposed, !transposed, [](double& to, double x) { to -= x; });
}

/// Adds tangent a^T b of two rows of the same bodies.
void SystemMatrix::addProduct(const SystemInput::SingleRow& a, const SystemInput::SingleRow& b, int edge,
							  double tangent)
{
	BlockMatrix& matrix = m_solver.getMatrix();
	const auto add = [tangent](double* block, const double* x, const double* y)
	{
		for (int c = 0; c < 6; ++c)
			for (int r = 0; r < 6; ++r)
				block[6 * c + r] += tangent * x[r] * y[c];
	};
	for (int side = 0; side < 2; ++side)
		if (isInPart(a.m_body[side]))
			add(matrix.diagonal(a.m_body[side]), a.m_J + 6 * side, b.m_J + 6 * side);
	if (!isEdgeInPart(a.m_body, edge))
		return;
	bool transposed;
	double* block = matrix.offDiagonal(edge, transposed);
	add(block, a.m_J + (transposed ? 6 : 0), b.m_J + (transposed ? 0 : 6));
}
}  // namespace btElasticPlastic
