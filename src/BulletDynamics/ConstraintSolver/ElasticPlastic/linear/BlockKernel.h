// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BLOCK_KERNEL_H
#define BT_ELASTIC_PLASTIC_BLOCK_KERNEL_H

#include <stddef.h>

namespace btElasticPlastic
{
// The arithmetic of BlockFactor is apart from it because it is compiled for several instruction sets. Code for the wider ones
// must not include Bullet's classes, whose alignment it would change, and works on plain data only.
//
// The factor L, H = L L^T, is stored in panels. A panel is a set of consecutive block columns and the block rows in which any
// of them is not zero: first its own columns' rows, then those below; a dense column-major array, as many doubles from one
// column to the next as it has rows. Its upper triangle is not used.

/// A number of consecutive block rows of a source panel, and where they are in the panel to be updated.
struct BlockRun
{
	int m_from;
	int m_to;
	int m_length;
};

/// The part of a panel that is subtracted from a later one: P -= S S_c^T, where S are the source's rows that the target has as
/// rows, and S_c those that it has as columns. The rows are given as runs, those of S_c first. A column is updated in its own row
/// and in the later ones.
struct BlockUpdate
{
	int m_source;
	int m_runs;
	int m_numColumnRuns;
	int m_numRuns;
};

/// A block of the matrix, and where in its panel it starts.
struct BlockLoad
{
	int m_block;
	int m_row;
	int m_column;
	int m_transposed;
};

struct BlockPanel
{
	size_t m_values;   ///< first element
	int m_first;       ///< block column
	int m_numColumns;  ///< in blocks
	int m_numRows;     ///< in blocks, its own columns' included
	int m_below;       ///< first of the block rows below
	int m_updates;     ///< first of its updates and loads; their ends are the next panel's
	int m_loads;
};

/// A factor's structure as the kernels see it. There is one panel more than m_numPanels, which has the ends of the last one's
/// lists.
struct BlockStructure
{
	const BlockPanel* m_panels;
	const BlockUpdate* m_updates;
	const BlockRun* m_runs;
	const BlockLoad* m_loads;
	const int* m_below;  ///< block rows below the panels' own
	int m_numPanels;
	/// The number of doubles behind a panel's last element, and behind solve's work space, that kernels may read but do not use.
	static const int Padding = 8;
};

struct BlockKernel
{
	/// Computes panels of L from the matrix' blocks.
	/// \param panels   which, in ascending order; null: all
	/// \param inverse  gets 1 / diagonal of L
	/// \return false at the first pivot that is not positive by more than rounding errors
	bool (*m_factorise)(const BlockStructure& s, const double* matrix, const int* panels, int numPanels, double* values,
						double* inverse);

	/// Computes x = (L L^T)^-1 x, in the order of elimination.
	/// \param work  as many doubles as the longest panel has rows, and Padding
	void (*m_solve)(const BlockStructure& s, const double* values, const double* inverse, double* x, double* work);

	/// The first half of it, x = L^-1 x.
	/// \param panels  those outside of which x stays zero, in ascending order; null: all
	void (*m_solveForward)(const BlockStructure& s, const double* values, const double* inverse, const int* panels,
						   int numPanels, double* x, double* work);

	int m_width;  ///< doubles in a vector with fused products; 1: plain ones

	/// The widest kernel, up to a width, that this processor can run.
	static const BlockKernel& select(int maxWidth);
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_BLOCK_KERNEL_H
