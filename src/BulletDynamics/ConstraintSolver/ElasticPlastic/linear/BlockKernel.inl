// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The kernels for one instruction set; included by BlockKernel.cpp once for each, inside a namespace that has
//   Vector           a vector of Width doubles, with the operators of arithmetic
//   load, store      at any address
//   storePart        the first n of its elements, n even
//   broadcast        a number into all elements
//   Sum              four sums of products, in a known order whatever the width, with clear, addProducts (of four doubles) and total
//   TileRows         vectors, and TileColumns: what the registers hold best; measured
// and with BT_KERNEL, the attributes of its functions. BT_UNROLL is put before loops that run over registers. Vectors are read
// beyond the last row of a panel, where values are finite and not used, but never written there.

/// C -= A B^T for a tile: A has Rows vectors of rows, B has Columns rows, depth is the number of columns of both. The tile's
/// last vector holds numLast rows.
template <int Rows, int Columns, int Depth>
BT_KERNEL inline void subtractTile(const double* a, const double* b, size_t stride, int depth, double* c,
								   size_t strideC, int numLast)
{
	Vector sum[Columns][Rows];
	if (Depth)
		depth = Depth;
	BT_UNROLL(8)
	for (int k = 0; k < Columns; ++k)
	{
		BT_UNROLL(8)
		for (int r = 0; r < Rows; ++r)
			sum[k][r] = load(c + k * strideC + r * Width);
	}
	for (int p = 0; p < depth; ++p, a += stride, b += stride)
	{
		Vector rows[Rows];
		BT_UNROLL(8)
		for (int r = 0; r < Rows; ++r)
			rows[r] = load(a + r * Width);
		BT_UNROLL(8)
		for (int k = 0; k < Columns; ++k)
		{
			const Vector factor = broadcast(b[k]);
			BT_UNROLL(8)
			for (int r = 0; r < Rows; ++r)
				sum[k][r] -= rows[r] * factor;
		}
	}
	BT_UNROLL(8)
	for (int k = 0; k < Columns; ++k)
	{
		BT_UNROLL(8)
		for (int r = 0; r < Rows - 1; ++r)
			store(c + k * strideC + r * Width, sum[k][r]);
		storePart(c + k * strideC + (Rows - 1) * Width, sum[k][Rows - 1], numLast);
	}
}

template <int Rows, int Depth>
BT_KERNEL inline void subtractTiles(const double* a, const double* b, size_t stride, int depth, double* c,
									size_t strideC, int numLast)
{
	BT_UNROLL(2)
	for (int k = 0; k < 6; k += TileColumns)
		subtractTile<Rows, TileColumns, Depth>(a, b + k, stride, depth, c + k * strideC, strideC, numLast);
}

/// C -= A B^T for a block column; rows is a multiple of 6.
template <int Depth>
BT_KERNEL inline void subtractColumn(int rows, const double* a, const double* b, size_t stride, int depth, double* c,
									 size_t strideC)
{
	for (; rows > TileRows * Width; rows -= TileRows * Width, a += TileRows * Width, c += TileRows * Width)
		subtractTiles<TileRows, Depth>(a, b, stride, depth, c, strideC, Width);
	const int numVectors = (rows + Width - 1) / Width;
	const int numLast = rows - (numVectors - 1) * Width;
	if (numVectors == TileRows)
		subtractTiles<TileRows, Depth>(a, b, stride, depth, c, strideC, numLast);
	else if (numVectors == 1)
		subtractTiles<1, Depth>(a, b, stride, depth, c, strideC, numLast);
	else if (numVectors == 2)
		subtractTiles<2, Depth>(a, b, stride, depth, c, strideC, numLast);
	else
		subtractTiles<(TileRows < 3 ? 1 : 3), Depth>(a, b, stride, depth, c, strideC, numLast);
}

template <int Depth>
BT_KERNEL inline void applyUpdate(const BlockRun* runs, int numColumnRuns, int numRuns,
								  const double* source, size_t stride, int depth, double* target, size_t strideTarget)
{
	for (int i = 0; i < numColumnRuns; ++i)
		for (int column = 0; column < runs[i].m_length; ++column)
		{
			const double* b = source + 6 * (runs[i].m_from + column);
			double* c = target + 6 * (runs[i].m_to + column) * strideTarget;
			subtractColumn<Depth>(6 * (runs[i].m_length - column), b, b, stride, depth, c + 6 * (runs[i].m_to + column),
								  strideTarget);
			for (int k = i + 1; k < numRuns; ++k)
				subtractColumn<Depth>(6 * runs[k].m_length, source + 6 * runs[k].m_from, b, stride, depth,
									  c + 6 * runs[k].m_to, strideTarget);
		}
}

/// Computes the Cholesky factor of a 6x6 block, lower triangle, in place. The block is eliminated as L D L^T first, so that
/// pivots need not wait for square roots.
/// \param inverse  in: the limits below which a pivot counts as zero, out: 1 / diagonal
BT_KERNEL inline bool factoriseDiagonal(double* block, size_t stride, double* inverse)
{
	double l[6][6];
	BT_UNROLL(6)
	for (int c = 0; c < 6; ++c)
	{
		BT_UNROLL(6)
		for (int r = c; r < 6; ++r)
			l[c][r] = block[c * stride + r];
	}
	bool positive = true;
	BT_UNROLL(6)
	for (int c = 0; c < 6; ++c)
	{
		// The comparisons are false for a pivot that is not a number, too.
		positive &= l[c][c] > inverse[c] && l[c][c] < Huge;
		const double inversePivot = 1 / l[c][c];
		BT_UNROLL(6)
		for (int k = c + 1; k < 6; ++k)
		{
			const double factor = l[c][k] * inversePivot;
			BT_UNROLL(6)
			for (int r = k; r < 6; ++r)
				l[k][r] -= l[c][r] * factor;
		}
	}
	if (!positive)
		return false;
	BT_UNROLL(6)
	for (int c = 0; c < 6; ++c)
	{
		const double root = sqrt(l[c][c]);
		inverse[c] = 1 / root;
		block[c * stride + c] = root;
		BT_UNROLL(6)
		for (int r = c + 1; r < 6; ++r)
			block[c * stride + r] = l[c][r] * inverse[c];
	}
	return true;
}

/// A = A L^-T below a diagonal block, for a number of vectors of rows, the last of which holds numLast.
template <int Rows>
BT_KERNEL inline void solveTile(const double* diagonal, const double* inverse, double* a, size_t stride, int numLast)
{
	Vector x[6][Rows];
	BT_UNROLL(6)
	for (int c = 0; c < 6; ++c)
	{
		BT_UNROLL(8)
		for (int r = 0; r < Rows; ++r)
			x[c][r] = load(a + c * stride + r * Width);
	}
	BT_UNROLL(6)
	for (int c = 0; c < 6; ++c)
	{
		const Vector inversePivot = broadcast(inverse[c]);
		BT_UNROLL(8)
		for (int r = 0; r < Rows; ++r)
			x[c][r] *= inversePivot;
		BT_UNROLL(6)
		for (int k = c + 1; k < 6; ++k)
		{
			const Vector factor = broadcast(diagonal[c * stride + k]);
			BT_UNROLL(8)
			for (int r = 0; r < Rows; ++r)
				x[k][r] -= x[c][r] * factor;
		}
		BT_UNROLL(8)
		for (int r = 0; r < Rows - 1; ++r)
			store(a + c * stride + r * Width, x[c][r]);
		storePart(a + c * stride + (Rows - 1) * Width, x[c][Rows - 1], numLast);
	}
}

BT_KERNEL inline void solveBelow(int rows, const double* diagonal, const double* inverse, double* a, size_t stride)
{
	for (; rows > 2 * Width; rows -= 2 * Width, a += 2 * Width)
		solveTile<2>(diagonal, inverse, a, stride, Width);
	if (rows > Width)
		solveTile<2>(diagonal, inverse, a, stride, rows - Width);
	else if (rows > 0)
		solveTile<1>(diagonal, inverse, a, stride, rows);
}

/// Copies the matrix' blocks into an empty panel, and pivots' limits into inverse.
BT_KERNEL inline void loadPanel(const BlockLoad* loads, int numLoads, const double* matrix,
								double* panel, size_t stride, double* inverse)
{
	for (int i = 0; i < numLoads; ++i)
	{
		const double* from = matrix + 36 * size_t(loads[i].m_block);
		double* to = panel + 6 * (loads[i].m_column * stride + loads[i].m_row);
		if (loads[i].m_row == loads[i].m_column)
			for (int c = 0; c < 6; ++c)
				inverse[6 * loads[i].m_column + c] = LeastPivot * from[7 * c];
		// Unrolled, these loops would run out of registers for their addresses.
		if (loads[i].m_transposed)
		{
			BT_UNROLL_NOT
			for (int c = 0; c < 6; ++c, ++from, to += stride)
				for (int r = 0; r < 6; ++r)
					to[r] = from[6 * r];
		}
		else
		{
			BT_UNROLL_NOT
			for (int c = 0; c < 6; ++c, from += 6, to += stride)
				memcpy(to, from, 6 * sizeof(double));
		}
	}
}

BT_KERNEL bool factorise(const BlockStructure& s, const double* matrix, const int* panels,
						 int numPanels, double* values, double* inverse)
{
	if (!panels)
		numPanels = s.m_numPanels;
	for (int i = 0; i < numPanels; ++i)
	{
		const BlockPanel& panel = s.m_panels[panels ? panels[i] : i];
		const BlockPanel& next = (&panel)[1];
		double* p = values + panel.m_values;
		double* inversePanel = inverse + 6 * size_t(panel.m_first);
		const size_t stride = 6 * size_t(panel.m_numRows);
		memset(p, 0, sizeof(double) * stride * 6 * panel.m_numColumns);
		loadPanel(s.m_loads + panel.m_loads, next.m_loads - panel.m_loads, matrix, p, stride, inversePanel);

		for (const BlockUpdate* u = s.m_updates + panel.m_updates; u < s.m_updates + next.m_updates;
			 ++u)
		{
			const BlockPanel& source = s.m_panels[u->m_source];
			const size_t strideSource = 6 * size_t(source.m_numRows);
			const BlockRun* runs = s.m_runs + u->m_runs;
			if (source.m_numColumns == 1)
				applyUpdate<6>(runs, u->m_numColumnRuns, u->m_numRuns, values + source.m_values, strideSource, 6, p,
							   stride);
			else
				applyUpdate<0>(runs, u->m_numColumnRuns, u->m_numRuns, values + source.m_values, strideSource,
							   6 * source.m_numColumns, p, stride);
		}

		for (int c = 0; c < panel.m_numColumns; ++c)
		{
			double* diagonal = p + 6 * c * stride + 6 * c;
			const int rows = 6 * (panel.m_numRows - c);
			if (c > 0)
				subtractColumn<0>(rows, p + 6 * c, p + 6 * c, stride, 6 * c, diagonal, stride);
			if (!factoriseDiagonal(diagonal, stride, inversePanel + 6 * c))
				return false;
			solveBelow(rows - 6, diagonal, inversePanel + 6 * c, diagonal + 6, stride);
		}
	}
	return true;
}

/// y = L^-1 y for a diagonal block.
BT_KERNEL inline void solveDiagonal(const double* l, size_t stride, const double* inverse, double* y)
{
	BT_UNROLL(6)
	for (int k = 0; k < 6; ++k)
	{
		y[k] *= inverse[k];
		BT_UNROLL(6)
		for (int r = k + 1; r < 6; ++r)
			y[r] -= l[k * stride + r] * y[k];
	}
}

/// y = L^-T y for a diagonal block.
BT_KERNEL inline void solveDiagonalTransposed(const double* l, size_t stride, const double* inverse, double* y)
{
	BT_UNROLL(6)
	for (int k = 5; k >= 0; --k)
	{
		BT_UNROLL(6)
		for (int r = 5; r > k; --r)
			y[k] -= l[k * stride + r] * y[r];
		y[k] *= inverse[k];
	}
}

/// A panel's part in x = L^-1 x.
BT_KERNEL inline void solvePanel(const BlockPanel& panel, const int* below, const double* l,
								 const double* inverse, double* x, double* work)
{
	const int columns = 6 * panel.m_numColumns;
	const int rows = 6 * panel.m_numRows;
	double* own = x + 6 * size_t(panel.m_first);
	memcpy(work, own, sizeof(double) * columns);
	memset(work + columns, 0, sizeof(double) * (rows - columns));
	for (int c = 0; c < columns; c += 6, l += 6 * size_t(rows) + 6)
	{
		double y[6];
		memcpy(y, work + c, sizeof y);
		solveDiagonal(l, rows, inverse + c, y);
		memcpy(own + c, y, sizeof y);
		Vector factor[6];
		BT_UNROLL(6)
		for (int k = 0; k < 6; ++k)
			factor[k] = broadcast(y[k]);
		for (int r = 6; r < rows - c; r += Width)
		{
			Vector sum = load(work + c + r);
			BT_UNROLL(6)
			for (int k = 0; k < 6; ++k)
				sum -= load(l + k * size_t(rows) + r) * factor[k];
			store(work + c + r, sum);
		}
	}
	for (int b = columns; b < rows; b += 6, ++below)
		for (int r = 0; r < 6; ++r)
			x[6 * size_t(*below) + r] += work[b + r];
}

/// The same for one block column with few rows, where gathering would cost more than computing.
BT_KERNEL inline void solveColumn(const BlockPanel& panel, const int* below, const double* l,
								  const double* inverse, double* x)
{
	const size_t rows = 6 * size_t(panel.m_numRows);
	double* own = x + 6 * size_t(panel.m_first);
	double y[6];
	memcpy(y, own, sizeof y);
	solveDiagonal(l, rows, inverse, y);
	memcpy(own, y, sizeof y);
	for (size_t b = 6; b < rows; b += 6, ++below)
	{
		double* other = x + 6 * size_t(*below);
		for (int r = 0; r < 6; ++r)
		{
			double sum = other[r];
			BT_UNROLL(6)
			for (int k = 0; k < 6; ++k)
				sum -= l[k * rows + b + r] * y[k];
			other[r] = sum;
		}
	}
}

/// A panel's part in x = L^-T x.
BT_KERNEL inline void solvePanelTransposed(const BlockPanel& panel, const int* below, const double* l,
										   const double* inverse, double* x, double* work)
{
	const int columns = 6 * panel.m_numColumns;
	const int rows = 6 * panel.m_numRows;
	double* own = x + 6 * size_t(panel.m_first);
	for (int b = columns; b < rows; b += 6, ++below)
		memcpy(work + b, x + 6 * size_t(*below), 6 * sizeof(double));
	// Zeros behind the last row: what is read there must not count.
	for (int r = rows; r < rows + SumWidth; r += Width)
		store(work + r, broadcast(0));
	l += (columns - 6) * (size_t(rows) + 1);
	for (int c = columns - 6; c >= 0; c -= 6, l -= 6 * size_t(rows) + 6)
	{
		Sum sum[6];
		BT_UNROLL(6)
		for (int k = 0; k < 6; ++k)
			clear(sum[k]);
		for (int r = 6; r < rows - c; r += SumWidth)
		{
			BT_UNROLL(6)
			for (int k = 0; k < 6; ++k)
				addProducts(sum[k], l + k * size_t(rows) + r, work + c + r);
		}
		double y[6];
		BT_UNROLL(6)
		for (int k = 0; k < 6; ++k)
			y[k] = own[c + k] - total(sum[k]);
		solveDiagonalTransposed(l, rows, inverse + c, y);
		memcpy(own + c, y, sizeof y);
		memcpy(work + c, y, sizeof y);
	}
}

BT_KERNEL void solveForward(const BlockStructure& s, const double* values, const double* inverse, const int* panels,
							int numPanels, double* x, double* work)
{
	for (int i = 0; i < numPanels; ++i)
	{
		const BlockPanel& panel = s.m_panels[panels ? panels[i] : i];
		const double* inversePanel = inverse + 6 * size_t(panel.m_first);
		if (panel.m_numColumns == 1 && panel.m_numRows <= 4)
			solveColumn(panel, s.m_below + panel.m_below, values + panel.m_values, inversePanel, x);
		else
			solvePanel(panel, s.m_below + panel.m_below, values + panel.m_values, inversePanel, x, work);
	}
}

BT_KERNEL void solve(const BlockStructure& s, const double* values, const double* inverse, double* x,
					 double* work)
{
	solveForward(s, values, inverse, nullptr, s.m_numPanels, x, work);
	for (int i = s.m_numPanels - 1; i >= 0; --i)
	{
		const BlockPanel& panel = s.m_panels[i];
		solvePanelTransposed(panel, s.m_below + panel.m_below, values + panel.m_values,
							 inverse + 6 * size_t(panel.m_first), x, work);
	}
}
