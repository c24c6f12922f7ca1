// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The matrix of System: its graph, and what bodies, joints and rows put into it.

#include "System.h"

#include <string.h>

#include "../linear/ScopedTimer.h"
#include "../linear/Vector3.h"

namespace btElasticPlastic
{
/// Rows between the same bodies that follow each other have one edge.
int System::addEdge(const int body[2])
{
	if (body[0] < 0 || body[1] < 0)
		return -1;
	const size_t n = m_edges.size();
	if (n < 2 || m_edges[n - 2] != body[0] || m_edges[n - 1] != body[1])
		m_edges.insert(m_edges.end(), body, body + 2);
	return int(m_edges.size() / 2) - 1;
}

void System::findEdges()
{
	m_edges.clear();
	for (Joint& joint : m_joints)
		joint.m_edge = addEdge(joint.m_body);
	for (Row& row : m_rows)
		row.m_edge = addEdge(row.m_body);
}

void System::assemble()
{
	const ScopedTimer lap("elastic-plastic assemble", m_statistics.m_assemblyTime);
	BlockMatrix& matrix = m_linearSolver.getMatrix();
	matrix.setZero();
	for (int b = 0; b < getNumBodies(); ++b)
	{
		double* block = matrix.diagonal(b);
		for (int i = 0; i < 3; ++i)
		{
			block[7 * i] = m_bodies[b].m_mass[i];
			memcpy(block + 6 * (3 + i) + 3, &m_bodies[b].m_inertia[3 * i], 3 * sizeof(double));
		}
	}
	m_changedBodies.clear();
	for (const Joint& joint : m_joints)
	{
		addToMatrix(joint);
		noteChange(joint.m_body, joint.m_firstLaw, joint.m_numLaws);
	}
	for (const Row& row : m_rows)
	{
		if (m_laws[row.m_law].m_bound == 0)
			addToMatrix(row);
		noteChange(row.m_body, row.m_law, 1);
	}
	m_matrixIsCurrent = true;
	m_linearSolver.setAssembled(m_changedBodies);
}

void System::noteChange(const int body[2], int firstLaw, int numLaws)
{
	bool changed = false;
	for (int l = firstLaw; l < firstLaw + numLaws; ++l)
	{
		const bool isIn = m_laws[l].m_bound == 0;
		changed |= isIn != m_laws[l].m_isInMatrix;
		m_laws[l].m_isInMatrix = isIn;
	}
	for (int side = 0; changed && side < 2; ++side)
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

/// to = sum w a a^T, lower is mirrored; a symmetric 3x3 matrix.
inline void addSquare(double w, const double* a, double* to)
{
	for (int c = 0; c < 3; ++c)
		for (int r = 0; r < 3; ++r)
			to[3 * c + r] += w * a[c] * a[r];
}
}  // namespace

/// With S = sum a a^T / C along the axes, U the same about them, and X the matrix of r x: the rows' squares sum up to
///     [ S     S X^T         ]
///     [ X S   X S X^T + U   ]   on a body, and to minus [ S, S XB^T; XA S, XA S XB^T + U ] between the two.
void System::addToMatrix(const Joint& joint)
{
	double square[2][9] = {};
	for (int l = 0; l < joint.m_numLaws; ++l)
	{
		const Law& law = m_laws[joint.m_firstLaw + l];
		if (law.m_bound == 0)
			addSquare(1 / law.m_compliance, joint.m_axis[joint.m_dof[l] % 3], square[joint.m_dof[l] / 3]);
	}
	// X S of both bodies; as S is symmetric, S X^T is its mirror image, and X S X^T the product of X with that.
	double moment[2][9], mirrored[2][9];
	for (int side = 0; side < 2; ++side)
	{
		for (int c = 0; c < 3; ++c)
			cross(joint.m_arm[side], square[0] + 3 * c, moment[side] + 3 * c);
		for (int c = 0; c < 3; ++c)
			for (int r = 0; r < 3; ++r)
				mirrored[side][3 * c + r] = moment[side][3 * r + c];
	}
	BlockMatrix& matrix = m_linearSolver.getMatrix();
	const auto parts = [&](int row, int column, double sign)
	{
		Parts p;
		for (int c = 0; c < 3; ++c)
			cross(joint.m_arm[row], mirrored[column] + 3 * c, p.m_bottomRight + 3 * c);
		for (int i = 0; i < 9; ++i)
		{
			p.m_topLeft[i] = sign * square[0][i];
			p.m_bottomLeft[i] = sign * moment[row][i];
			p.m_topRight[i] = sign * mirrored[column][i];
			p.m_bottomRight[i] = sign * (p.m_bottomRight[i] + square[1][i]);
		}
		return p;
	};
	for (int side = 0; side < 2; ++side)
		if (joint.m_body[side] >= 0)
			parts(side, side, 1).addTo(matrix.diagonal(joint.m_body[side]));
	if (joint.m_edge < 0)
		return;
	bool transposed;
	double* block = matrix.offDiagonal(joint.m_edge, transposed);
	parts(transposed, !transposed, -1).addTo(block);
}

void System::addToMatrix(const Row& row)
{
	BlockMatrix& matrix = m_linearSolver.getMatrix();
	const double weight = 1 / m_laws[row.m_law].m_compliance;
	const auto add = [weight](double* block, const double* x, const double* y)
	{
		for (int c = 0; c < 6; ++c)
			for (int r = 0; r < 6; ++r)
				block[6 * c + r] += weight * x[r] * y[c];
	};
	for (int side = 0; side < 2; ++side)
		if (row.m_body[side] >= 0)
			add(matrix.diagonal(row.m_body[side]), row.m_J + 6 * side, row.m_J + 6 * side);
	if (row.m_edge < 0)
		return;
	bool transposed;
	double* block = matrix.offDiagonal(row.m_edge, transposed);
	add(block, row.m_J + (transposed ? 6 : 0), row.m_J + (transposed ? 0 : 6));
}
}  // namespace btElasticPlastic
