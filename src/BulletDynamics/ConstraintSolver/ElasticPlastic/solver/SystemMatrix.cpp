// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "SystemMatrix.h"

#include <string.h>

#include "../linear/Vector3.h"

namespace btElasticPlastic
{
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
	add(input, box);
	m_changedBodies.clear();
	for (const SystemInput::Unit& unit : input.m_units)
		noteChange(unit.m_body, box.noteTangent(unit.m_firstRow, unit.m_numRows));
	for (const SystemInput::SingleRow& row : input.m_singleRows)
		noteChange(row.m_body, box.noteTangent(row.m_row, 1));
	m_solver.setAssembled(m_changedBodies);
}

void SystemMatrix::addMasses(const SystemInput& input)
{
	BlockMatrix& matrix = m_solver.getMatrix();
	matrix.setZero();
	for (int b = 0; b < input.getNumBodies(); ++b)
	{
		double* block = matrix.diagonal(b);
		for (int i = 0; i < 3; ++i)
		{
			block[7 * i] = input.m_bodies[b].m_mass[i];
			memcpy(block + 6 * (3 + i) + 3, &input.m_bodies[b].m_inertia[3 * i], 3 * sizeof(double));
		}
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
/// A 6x6 block in four 3x3 parts, each by columns.
struct Parts
{
	double m_topLeft[9], m_bottomLeft[9], m_topRight[9], m_bottomRight[9];

	void addTo(double* block) const
	{
		for (int c = 0; c < 3; ++c)
			for (int r = 0; r < 3; ++r)
			{
				block[6 * c + r] += m_topLeft[3 * c + r];
				block[6 * c + 3 + r] += m_bottomLeft[3 * c + r];
				block[6 * (3 + c) + r] += m_topRight[3 * c + r];
				block[6 * (3 + c) + 3 + r] += m_bottomRight[3 * c + r];
			}
	}
};

/// Adds what a unit's coupling of shear and bending gives.
void addMixed(const SystemInput::Unit& unit, const double mixed[9], int row, int column, double sign, Parts& p)
{
	double ofRow[9], ofColumn[9];
	for (int c = 0; c < 3; ++c)
	{
		cross(unit.m_arm[row], mixed + 3 * c, ofRow + 3 * c);
		cross(unit.m_arm[column], mixed + 3 * c, ofColumn + 3 * c);
	}
	for (int c = 0; c < 3; ++c)
		for (int r = 0; r < 3; ++r)
		{
			p.m_topRight[3 * c + r] += sign * mixed[3 * c + r];
			p.m_bottomLeft[3 * c + r] += sign * mixed[3 * r + c];
			p.m_bottomRight[3 * c + r] += sign * (ofRow[3 * c + r] + ofColumn[3 * r + c]);
		}
}
}  // namespace

/// With the unit's tangent S along the axes and U about them, and X the matrix of r x: J^T (d lambda / du) J is
///     [ S     S X^T         ]
///     [ X S   X S X^T + U   ]   on a body, and minus [ S, S XB^T; XA S, XA S XB^T + U ] between the two.
/// Where shear and bending are coupled by the tangent L, that adds [ 0, L; L^T, X L + L^T X^T ], likewise minus
/// [ 0, L; L^T, XA L + L^T XB^T ].
void SystemMatrix::addUnit(const SystemInput::Unit& unit, int edge, const double linear[9], const double angular[9],
						   const double* mixed)
{
	// X S of both bodies; as S is symmetric, S X^T is its mirror image, and X S X^T the product of X with that.
	double moment[2][9], mirrored[2][9];
	for (int side = 0; side < 2; ++side)
	{
		for (int c = 0; c < 3; ++c)
			cross(unit.m_arm[side], linear + 3 * c, moment[side] + 3 * c);
		for (int c = 0; c < 3; ++c)
			for (int r = 0; r < 3; ++r)
				mirrored[side][3 * c + r] = moment[side][3 * r + c];
	}
	BlockMatrix& matrix = m_solver.getMatrix();
	const auto parts = [&](int row, int column, double sign)
	{
		Parts p;
		for (int c = 0; c < 3; ++c)
			cross(unit.m_arm[row], mirrored[column] + 3 * c, p.m_bottomRight + 3 * c);
		for (int i = 0; i < 9; ++i)
		{
			p.m_topLeft[i] = sign * linear[i];
			p.m_bottomLeft[i] = sign * moment[row][i];
			p.m_topRight[i] = sign * mirrored[column][i];
			p.m_bottomRight[i] = sign * (p.m_bottomRight[i] + angular[i]);
		}
		if (mixed)
			addMixed(unit, mixed, row, column, sign, p);
		return p;
	};
	for (int side = 0; side < 2; ++side)
		if (unit.m_body[side] >= 0)
			parts(side, side, 1).addTo(matrix.diagonal(unit.m_body[side]));
	if (edge < 0)
		return;
	bool transposed;
	double* block = matrix.offDiagonal(edge, transposed);
	parts(transposed, !transposed, -1).addTo(block);
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
		if (a.m_body[side] >= 0)
			add(matrix.diagonal(a.m_body[side]), a.m_J + 6 * side, b.m_J + 6 * side);
	if (edge < 0)
		return;
	bool transposed;
	double* block = matrix.offDiagonal(edge, transposed);
	add(block, a.m_J + (transposed ? 6 : 0), b.m_J + (transposed ? 0 : 6));
}
}  // namespace btElasticPlastic
