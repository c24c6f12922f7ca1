// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BLOCK_MATRIX_H
#define BT_ELASTIC_PLASTIC_BLOCK_MATRIX_H

#include <stddef.h>
#include <vector>

namespace btElasticPlastic
{
/// A symmetric matrix of 6x6 blocks on a graph of bodies: one block on the diagonal per body, one beside it per pair of
/// bodies that an edge joins. Always double: a stiff chain's matrix is too ill-conditioned for float.
///
/// The matrix knows nothing of an order of elimination: BlockFactor copies its blocks. It therefore stays as it was assembled,
/// for iterations with the factor of an earlier matrix, and for factorising again after a few blocks have changed.
///
/// A block holds element (row, column) at [6 * column + row]. 288 bytes per body and per pair.
class BlockMatrix
{
public:
	/// Sets the graph. Every block is zero after the next setZero(). The order of edges, their directions and repetitions make no difference
	/// to the matrix: edges between the same two bodies share a block. An edge's bodies must differ.
	void setPattern(int numBodies, const int (*edges)[2], int numEdges);

	void setZero();

	/// Exchanges the memory of its blocks for another one, which must have getNumValues() numbers at least before blocks are used; they mean
	/// nothing until setZero().
	void swapValues(std::vector<double>& values) { m_values.swap(values); }
	size_t getNumValues() const { return 36 * size_t(getNumBlocks()); }
	bool hasValues() const { return m_values.size() >= getNumValues(); }

	/// The body's block, 36 doubles: full and symmetric.
	double* diagonal(int body) { return &m_values[36 * size_t(body)]; }
	const double* diagonal(int body) const { return &m_values[36 * size_t(body)]; }

	/// The block of an edge {a, b} of setPattern's list, 36 doubles. Its rows are the degrees of freedom of a and its columns
	/// those of b; if transposed, the other way round. The block's mirror image is not stored.
	double* offDiagonal(int edge, bool& transposed)
	{
		transposed = m_edgeTransposed[edge] != 0;
		return &m_values[36 * (size_t(m_numBodies) + m_edgePair[edge])];
	}

	/// y = H x, 6 doubles per body each; x and y must not overlap.
	void multiply(const double* x, double* y) const;

	int getNumBodies() const { return m_numBodies; }
	int getNumBlocks() const { return m_numBodies + getNumPairs(); }

	/// The pairs of bodies with a block, each once, sorted by lower body, then by higher. A block's rows are those of the
	/// higher body.
	int getNumPairs() const { return int(m_higher.size()); }
	int getLowerBody(int pair) const { return m_lower[pair]; }
	int getHigherBody(int pair) const { return m_higher[pair]; }

	/// All blocks one after another: those of the bodies, then those of the pairs.
	const double* getValues() const { return m_values.data(); }

private:
	int m_numBodies = 0;
	std::vector<int> m_lower;  // per pair
	std::vector<int> m_higher;
	std::vector<int> m_edgePair;  // per edge
	std::vector<char> m_edgeTransposed;
	std::vector<double> m_values;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_BLOCK_MATRIX_H
