// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BLOCK_FACTOR_H
#define BT_ELASTIC_PLASTIC_BLOCK_FACTOR_H

#include <stdint.h>
#include <vector>

#include "BlockKernel.h"

namespace btElasticPlastic
{
class BlockMatrix;

/// y = L^-1 b for a right side b that has few bodies: zero but in the panels of a few bodies and of their ancestors in the elimination
/// tree. As b^T H^-1 c = (L^-1 b)^T (L^-1 c), such halves give what rows answer to each other's impulses.
struct HalfSolution
{
	std::vector<int> m_panels;     ///< in which y is not zero, in ascending order
	std::vector<int> m_start;      ///< of each in m_values, and the end
	std::vector<double> m_values;  ///< the panels' own block columns

	/// b^T H^-1 c
	static double multiply(const HalfSolution& b, const HalfSolution& c);
};

/// Sparse Cholesky factor H = L L^T of a symmetric positive definite BlockMatrix.
///
/// analyse() looks at the graph only: it finds an order of elimination that keeps L sparse, and where in L each block goes.
/// factorise() and solve() then follow this plan without a search or an allocation. Block columns with nearly the same rows
/// are joined to dense panels, on which the arithmetic runs fastest; the columns of a chain or a tree stay single.
/// Panels are computed from left to right, and each collects the updates of those to its left. A panel is therefore written
/// while it is in the cache, and some panels are computed anew in the same way as all of them.
///
/// Memory: 288 bytes per 6x6 block of L, about 400 with the plan. L has two blocks per body for a chain, 5 for a building's
/// frame of 7000 bodies, 12 for a wall of 5000.
///
/// The factor is repeatable: the same matrix on the same processor gives the same bits, whether factorised at once or in parts.
/// Vectors of all widths give the same bits where products are added without being rounded, on processors with AVX2 and FMA;
/// setMaxVectorWidth(1) makes all x86-64 processors agree.
/// Different objects may be used by different threads at the same time, one object by one thread only.
class BlockFactor
{
public:
	BlockFactor();

	/// Plans the factorisation of all matrices with this pattern. There is no factor before the next factorise().
	/// \param numLast  so many of the highest bodies are eliminated last
	void analyse(const BlockMatrix& matrix, int numLast = 0);

	/// Computes the factor. \return false if the matrix is not positive definite: then there is no factor, solve() does
	/// nothing, and the next factorise() computes everything
	bool factorise(const BlockMatrix& matrix);

	/// Computes the factor of a matrix that has changed since the last factorise() in these bodies' blocks and the blocks between
	/// them only. Only what depends on them is computed, with the same bits as a factor of the whole matrix; everything is
	/// computed if there is no factor. A body may be named twice.
	bool factorise(const BlockMatrix& matrix, const int* changedBodies, int numChangedBodies);

	bool hasFactor() const { return m_hasFactor; }

	/// Exchanges the memory of the factor, which is lost, for another one of any content.
	void swapValues(std::vector<double>& values)
	{
		m_values.swap(values);
		m_hasFactor = false;
	}
	size_t getNumValues() const { return m_numValues; }
	bool hasValues() const { return m_values.size() >= m_numValues; }

	/// x = H^-1 x, 6 doubles per body. Leaves x as it is if there is no factor.
	void solve(double* x) const;

	/// Half of a solution for a right side of two bodies. There must be a factor.
	/// \param b  of the first body, 6 doubles, then of the second one; a body of -1 has no part
	/// \return the number of L's blocks that took part
	int64_t solveHalf(const int bodies[2], const double b[12], HalfSolution& half) const;

	/// What is left of H for the bodies that are eliminated last once all others are: for each vector x of these bodies' motions the least
	/// x^T H x that the others' motions allow is x^T S x. There must be a factor.
	/// \param complement  gets S, full, 6 numLast rows and columns in the order of the bodies' numbers
	void getComplement(int numLast, std::vector<double>& complement) const;

	/// Limits the number of doubles in a vector to 2, 4 or 8; without a limit vectors are as wide as pays. The factor is lost.
	void setMaxVectorWidth(int width);
	int getVectorWidth() const { return m_kernel->m_width; }  ///< of the analysed matrix' factor

	int getNumBodies() const { return int(m_bodies.size()); }
	int64_t getNumBlocks() const { return m_numBlocks; }          ///< of L as stored, the diagonal's included
	int64_t getNumOperations() const { return m_numOperations; }  ///< of factorise(): multiplications and additions
	int64_t getNumFactorisedOperations() const { return m_numFactorisedOperations; }  ///< of the last factorise()
	int64_t getMemory() const;                                                        ///< bytes

private:
	int m_maxVectorWidth;
	const BlockKernel* m_kernel;
	bool m_hasFactor = false;
	int64_t m_numBlocks = 0;
	int64_t m_numOperations = 0;
	int64_t m_numFactorisedOperations = 0;
	size_t m_numValues = 0;

	std::vector<int> m_bodies;          // by order of elimination
	std::vector<int> m_panelOf;         // per body
	std::vector<int64_t> m_operations;  // per panel
	std::vector<int> m_parent;          // per panel: the first that it updates, -1 if none
	std::vector<BlockPanel> m_panels;
	std::vector<BlockUpdate> m_updates;
	std::vector<BlockRun> m_runs;
	std::vector<BlockLoad> m_loads;
	std::vector<int> m_below;

	std::vector<double> m_values;
	std::vector<double> m_inverse;
	// Work space.
	std::vector<char> m_isChanged;  // per panel
	std::vector<int> m_changed;
	mutable std::vector<double> m_work;
	std::vector<int> m_column;              // per body: its place in the order of elimination
	mutable std::vector<double> m_forward;  // zero between calls of solveHalf()

	void selectKernel();
	BlockStructure structure() const;
	void planUpdates();
	void planLoads(const BlockMatrix& matrix);
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_BLOCK_FACTOR_H
