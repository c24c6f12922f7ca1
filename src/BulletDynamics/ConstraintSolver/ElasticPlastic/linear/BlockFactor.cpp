// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "BlockFactor.h"

#include <limits.h>
#include <algorithm>

#include "BlockMatrix.h"
#include "Ordering.h"

#include "LinearMath/btScalar.h"

namespace btElasticPlastic
{
namespace
{
/// Lists of numbers, stored one after another.
struct Lists
{
	std::vector<int> m_start{0};
	std::vector<int> m_items;

	int getSize(int list) const { return m_start[list + 1] - m_start[list]; }
	const int* begin(int list) const { return m_items.data() + m_start[list]; }
	const int* end(int list) const { return m_items.data() + m_start[list + 1]; }
};

Lists neighboursOf(const BlockMatrix& matrix)
{
	const int n = matrix.getNumBodies();
	Lists neighbours;
	neighbours.m_start.assign(n + 1, 0);
	neighbours.m_items.resize(2 * size_t(matrix.getNumPairs()));
	for (int p = 0; p < matrix.getNumPairs(); ++p)
	{
		++neighbours.m_start[matrix.getLowerBody(p) + 1];
		++neighbours.m_start[matrix.getHigherBody(p) + 1];
	}
	for (int i = 0; i < n; ++i)
		neighbours.m_start[i + 1] += neighbours.m_start[i];
	std::vector<int> end(neighbours.m_start.begin(), neighbours.m_start.end() - 1);
	for (int p = 0; p < matrix.getNumPairs(); ++p)
	{
		const int lower = matrix.getLowerBody(p), higher = matrix.getHigherBody(p);
		neighbours.m_items[end[lower]++] = higher;
		neighbours.m_items[end[higher]++] = lower;
	}
	return neighbours;
}

/// The elimination tree of L's columns. Column j of L has the rows of H's column j and those of its children's columns. The
/// parent of column j is its first row below the diagonal: column j updates that column first, and passes all its other rows
/// on to it.
struct EliminationTree
{
	std::vector<int> m_order;   // bodies
	std::vector<int> m_parent;  // per column, -1 for a root
	Lists m_below;              // per column: rows below the diagonal, not sorted
	Lists m_children;

	EliminationTree(const BlockMatrix& matrix, int numLast);
};

EliminationTree::EliminationTree(const BlockMatrix& matrix, int numLast)
{
	const int n = matrix.getNumBodies();
	const Lists neighbours = neighboursOf(matrix);
	minimumDegree(n, neighbours.m_start.data(), neighbours.m_items.data(), numLast, m_order);
	std::vector<int> column(n);
	for (int j = 0; j < n; ++j)
		column[m_order[j]] = j;

	m_parent.assign(n, -1);
	std::vector<int> lastSeen(n, -1), firstChild(n, -1), nextChild(n, -1);
	std::vector<int>& rows = m_below.m_items;
	for (int j = 0; j < n; ++j)
	{
		int parent = INT_MAX;
		const auto add = [&](int row)
		{
			if (row <= j || lastSeen[row] == j)
				return;
			lastSeen[row] = j;
			rows.push_back(row);
			parent = std::min(parent, row);
		};
		for (const int* i = neighbours.begin(m_order[j]); i < neighbours.end(m_order[j]); ++i)
			add(column[*i]);
		m_children.m_start.push_back(m_children.m_start.back());
		for (int child = firstChild[j]; child >= 0; child = nextChild[child])
		{
			m_children.m_items.push_back(child);
			++m_children.m_start.back();
			for (int k = m_below.m_start[child]; k < m_below.m_start[child + 1]; ++k)
				add(rows[k]);
		}
		m_below.m_start.push_back(int(rows.size()));
		if (parent < INT_MAX)
		{
			m_parent[j] = parent;
			nextChild[j] = firstChild[parent];
			firstChild[parent] = j;
		}
	}
}

/// The cost of computing a panel of so many block columns with so many block rows below, in products of two blocks.
double panelCost(double columns, double below)
{
	// These values are measured. Twice or half of them makes no difference to a frame or a wall; larger ones also join the columns
	// of chains, which gains nothing.
	const double PerPanel = 1.5;
	const double PerBlockUpdated = 0.5;
	return PerPanel + PerBlockUpdated * below * (below + 1) / 2 + columns * columns * columns / 6 +
		   columns * columns * (below + 1) / 2 + columns * (below + 1) * (below + 1) / 2;
}

/// Columns joined to panels. A panel joins its parent where the zeros that are then stored cost less than the join saves.
struct Panels
{
	std::vector<int> m_columns;  // of the tree, panel by panel
	std::vector<int> m_last;     // per panel: its last column; its rows are the panel's
	std::vector<int> m_numColumns;

	explicit Panels(const EliminationTree& tree);

private:
	void sortPanels(const EliminationTree& tree, const std::vector<int>& panelOf);
};

Panels::Panels(const EliminationTree& tree)
{
	const int n = int(tree.m_order.size());
	std::vector<int> size(n, 1), first(n), next(n, -1), panelOf(n), children;
	std::vector<char> isPanel(n, 1);
	for (int j = 0; j < n; ++j)
	{
		// Children with the most rows have the most in common with their parent, and are tried first.
		children.assign(tree.m_children.begin(j), tree.m_children.end(j));
		std::sort(children.begin(), children.end(),
				  [&](int a, int b)
				  {
					  const int sizeA = tree.m_below.getSize(a), sizeB = tree.m_below.getSize(b);
					  return sizeA != sizeB ? sizeA > sizeB : a < b;
				  });
		const int below = tree.m_below.getSize(j);
		int last = -1;  // the column before j in the panel
		first[j] = j;
		for (const int child : children)
		{
			if (panelCost(size[child] + size[j], below) >
				panelCost(size[child], tree.m_below.getSize(child)) + panelCost(size[j], below))
				continue;
			isPanel[child] = 0;
			size[j] += size[child];
			if (last < 0)
				first[j] = first[child];
			else
				next[last] = first[child];
			last = child;
			next[last] = j;
		}
	}
	for (int j = n - 1; j >= 0; --j)
		panelOf[j] = isPanel[j] ? j : panelOf[tree.m_parent[j]];
	sortPanels(tree, panelOf);

	m_columns.reserve(n);
	for (const int last : m_last)
	{
		for (int k = first[last]; k != last; k = next[k])
			m_columns.push_back(k);
		m_columns.push_back(last);
		m_numColumns.push_back(size[last]);
	}
}

/// Puts panels in postorder: a panel's descendants come right before it, so that what is used together is stored together.
void Panels::sortPanels(const EliminationTree& tree, const std::vector<int>& panelOf)
{
	const int n = int(panelOf.size());
	const auto parentOf = [&](int j) { return tree.m_parent[j] < 0 ? n : panelOf[tree.m_parent[j]]; };
	std::vector<int> numDescendants(n + 1, 0);
	for (int j = 0; j < n; ++j)
		if (panelOf[j] == j)
			numDescendants[parentOf(j)] += numDescendants[j] + 1;
	// From the roots down, each panel takes the last free place of those that belong to its parent's descendants.
	std::vector<int> lastFree(n + 1);
	m_last.resize(numDescendants[n]);
	lastFree[n] = numDescendants[n] - 1;
	for (int j = n - 1; j >= 0; --j)
		if (panelOf[j] == j)
		{
			int& place = lastFree[parentOf(j)];
			m_last[place] = j;
			lastFree[j] = place - 1;
			place -= numDescendants[j] + 1;
		}
}
}  // namespace

BlockFactor::BlockFactor() : m_maxVectorWidth(INT_MAX) { selectKernel(); }

void BlockFactor::setMaxVectorWidth(int width)
{
	m_maxVectorWidth = width;
	m_hasFactor = false;
	selectKernel();
}

void BlockFactor::selectKernel()
{
	// Chains and trees are factorised faster with vectors shorter than a block. They take 500 operations per body, and a beam of
	// 2 x 2 bodies takes 5000: the limit is between.
	const bool isThin = m_numOperations < 2000 * int64_t(getNumBodies());
	m_kernel = &BlockKernel::select(isThin ? std::min(m_maxVectorWidth, 4) : m_maxVectorWidth);
}

void BlockFactor::analyse(const BlockMatrix& matrix, int numLast)
{
	const EliminationTree tree(matrix, numLast);
	const Panels panels(tree);
	const int n = matrix.getNumBodies();
	const int numPanels = int(panels.m_last.size());

	std::vector<int> newColumn(n);
	m_bodies.resize(n);
	for (int j = 0; j < n; ++j)
	{
		newColumn[panels.m_columns[j]] = j;
		m_bodies[j] = tree.m_order[panels.m_columns[j]];
	}

	m_panels.assign(numPanels + 1, BlockPanel());
	m_panelOf.resize(n);
	m_below.clear();
	m_numBlocks = m_numOperations = 0;
	m_operations.resize(size_t(numPanels));
	size_t values = 0, longest = 0;
	for (int p = 0, first = 0; p < numPanels; ++p)
	{
		BlockPanel& panel = m_panels[p];
		const int last = panels.m_last[p];
		panel.m_values = values;
		panel.m_first = first;
		panel.m_numColumns = panels.m_numColumns[p];
		panel.m_numRows = panel.m_numColumns + tree.m_below.getSize(last);
		panel.m_below = int(m_below.size());
		for (const int* row = tree.m_below.begin(last); row < tree.m_below.end(last); ++row)
			m_below.push_back(newColumn[*row]);
		std::sort(m_below.begin() + panel.m_below, m_below.end());
		for (int c = 0; c < panel.m_numColumns; ++c)
			m_panelOf[m_bodies[first + c]] = p;
		first += panel.m_numColumns;
		values += 36 * size_t(panel.m_numColumns) * panel.m_numRows;
		longest = std::max(longest, 6 * size_t(panel.m_numRows));
		const int64_t k = 6 * panel.m_numColumns, u = 6 * panel.m_numRows - k;
		m_numBlocks += panel.m_numColumns * (int64_t(panel.m_numRows) - panel.m_numColumns) +
					   panel.m_numColumns * (int64_t(panel.m_numColumns) + 1) / 2;
		m_operations[size_t(p)] = k * k * k / 3 + k * k * u + k * u * (u + 1);
		m_numOperations += m_operations[size_t(p)];
	}
	m_panels[numPanels].m_below = int(m_below.size());
	m_parent.assign(numPanels, -1);
	for (int p = 0; p < numPanels; ++p)
		if (m_panels[p].m_below < m_panels[p + 1].m_below)
			m_parent[p] = m_panelOf[m_bodies[m_below[m_panels[p].m_below]]];

	planUpdates();
	planLoads(matrix);
	selectKernel();

	const int padding = BlockStructure::Padding;
	m_numValues = values + padding;
	m_inverse.assign(6 * size_t(n), 0);
	m_work.assign(6 * size_t(n) + longest + padding, 0);
	m_isChanged.assign(numPanels, 0);
	m_column.resize(n);
	for (int j = 0; j < n; ++j)
		m_column[m_bodies[j]] = j;
	m_forward.assign(6 * size_t(n), 0);
	m_hasFactor = false;
}

// A source panel updates every panel that has one of the source's rows below as a column.
void BlockFactor::planUpdates()
{
	const int numPanels = int(m_panels.size()) - 1;
	const auto forTargets = [&](auto f)
	{
		for (int source = 0; source < numPanels; ++source)
			for (int k = m_panels[source].m_below, target = -1; k < m_panels[source + 1].m_below; ++k)
			{
				const int panel = m_panelOf[m_bodies[m_below[k]]];
				if (panel != target)
					f(source, target = panel, k);
			}
	};
	std::vector<int> end(numPanels + 1, 0);
	forTargets([&](int, int target, int) { ++end[target + 1]; });
	for (int p = 0; p < numPanels; ++p)
		m_panels[p + 1].m_updates = end[p + 1] += end[p];
	m_updates.assign(end[numPanels], BlockUpdate());
	std::vector<int> firstRow(m_updates.size());
	forTargets(
		[&](int source, int target, int k)
		{
			m_updates[end[target]].m_source = source;
			firstRow[end[target]++] = k;
		});

	m_runs.clear();
	std::vector<int> row(m_bodies.size());  // where a block row is in the target
	for (int target = 0; target < numPanels; ++target)
	{
		const BlockPanel& panel = m_panels[target];
		for (int c = 0; c < panel.m_numColumns; ++c)
			row[panel.m_first + c] = c;
		for (int k = panel.m_below; k < m_panels[target + 1].m_below; ++k)
			row[m_below[k]] = panel.m_numColumns + k - panel.m_below;

		for (int u = panel.m_updates; u < m_panels[target + 1].m_updates; ++u)
		{
			BlockUpdate& update = m_updates[u];
			const BlockPanel& source = m_panels[update.m_source];
			update.m_runs = int(m_runs.size());
			for (int k = firstRow[u]; k < m_panels[update.m_source + 1].m_below; ++k)
			{
				const int to = row[m_below[k]];
				if (update.m_numRuns > 0 && to != panel.m_numColumns &&
					to == m_runs.back().m_to + m_runs.back().m_length)
				{
					++m_runs.back().m_length;
					continue;
				}
				const int from = source.m_numColumns + k - source.m_below;
				m_runs.push_back({from, to, 1});
				++update.m_numRuns;
				update.m_numColumnRuns += to < panel.m_numColumns;
			}
		}
	}
}

void BlockFactor::planLoads(const BlockMatrix& matrix)
{
	const int n = int(m_bodies.size());
	const int numPanels = int(m_panels.size()) - 1;
	std::vector<int> column(n);
	for (int j = 0; j < n; ++j)
		column[m_bodies[j]] = j;
	// f gets a block of the matrix and its two bodies, first the one whose column of L holds the block.
	const auto forBlocks = [&](auto f)
	{
		for (int i = 0; i < n; ++i)
			f(i, i, i, false);
		for (int p = 0; p < matrix.getNumPairs(); ++p)
		{
			const int lower = matrix.getLowerBody(p), higher = matrix.getHigherBody(p);
			if (column[lower] < column[higher])
				f(n + p, lower, higher, false);
			else
				f(n + p, higher, lower, true);
		}
	};
	std::vector<int> end(numPanels + 1, 0);
	forBlocks([&](int, int a, int, bool) { ++end[m_panelOf[a] + 1]; });
	for (int p = 0; p < numPanels; ++p)
		m_panels[p + 1].m_loads = end[p + 1] += end[p];
	m_loads.resize(end[numPanels]);
	forBlocks(
		[&](int block, int a, int b, bool transposed)
		{
			const int p = m_panelOf[a];
			const BlockPanel& panel = m_panels[p];
			int row = column[b] - panel.m_first;
			if (row >= panel.m_numColumns)
			{
				const auto begin = m_below.begin() + panel.m_below;
				row = panel.m_numColumns +
					  int(std::lower_bound(begin, m_below.begin() + m_panels[p + 1].m_below, column[b]) - begin);
			}
			m_loads[end[p]++] = {block, row, column[a] - panel.m_first, transposed};
		});
}

BlockStructure BlockFactor::structure() const
{
	return {m_panels.data(), m_updates.data(), m_runs.data(), m_loads.data(), m_below.data(), int(m_panels.size()) - 1};
}

bool BlockFactor::factorise(const BlockMatrix& matrix)
{
	btAssert(matrix.getNumBodies() == getNumBodies());
	if (!hasValues())
		m_values.resize(m_numValues);
	m_hasFactor = getNumBodies() == 0 ||
				  m_kernel->m_factorise(structure(), matrix.getValues(), nullptr, 0, m_values.data(), m_inverse.data());
	m_numFactorisedOperations = m_numOperations;
	return m_hasFactor;
}

bool BlockFactor::factorise(const BlockMatrix& matrix, const int* changedBodies, int numChangedBodies)
{
	if (!m_hasFactor)
		return factorise(matrix);
	m_changed.clear();
	for (int i = 0; i < numChangedBodies; ++i)
		for (int p = m_panelOf[changedBodies[i]]; p >= 0 && !m_isChanged[p]; p = m_parent[p])
		{
			m_isChanged[p] = 1;
			m_changed.push_back(p);
		}
	m_numFactorisedOperations = 0;
	for (const int p : m_changed)
	{
		m_isChanged[p] = 0;
		m_numFactorisedOperations += m_operations[size_t(p)];
	}
	std::sort(m_changed.begin(), m_changed.end());
	if (!m_changed.empty())
		m_hasFactor = m_kernel->m_factorise(structure(), matrix.getValues(), m_changed.data(), int(m_changed.size()),
											m_values.data(), m_inverse.data());
	return m_hasFactor;
}

void BlockFactor::solve(double* x) const
{
	if (!m_hasFactor)
		return;
	const size_t n = m_bodies.size();
	for (size_t j = 0; j < n; ++j)
		for (int r = 0; r < 6; ++r)
			m_work[6 * j + r] = x[6 * size_t(m_bodies[j]) + r];
	m_kernel->m_solve(structure(), m_values.data(), m_inverse.data(), m_work.data(), m_work.data() + 6 * n);
	for (size_t j = 0; j < n; ++j)
		for (int r = 0; r < 6; ++r)
			x[6 * size_t(m_bodies[j]) + r] = m_work[6 * j + r];
}

int64_t BlockFactor::solveHalf(const int bodies[2], const double b[12], HalfSolution& half) const
{
	half.m_panels.clear();
	half.m_start.clear();
	half.m_values.clear();
	for (int side = 0; side < 2; ++side)
	{
		if (bodies[side] < 0)
			continue;
		double* const own = &m_forward[6 * size_t(m_column[size_t(bodies[side])])];
		for (int i = 0; i < 6; ++i)
			own[i] += b[6 * side + i];
		for (int p = m_panelOf[size_t(bodies[side])]; p >= 0; p = m_parent[size_t(p)])
			half.m_panels.push_back(p);
	}
	std::sort(half.m_panels.begin(), half.m_panels.end());
	half.m_panels.erase(std::unique(half.m_panels.begin(), half.m_panels.end()), half.m_panels.end());
	m_kernel->m_solveForward(structure(), m_values.data(), m_inverse.data(), half.m_panels.data(),
							 int(half.m_panels.size()), m_forward.data(), m_work.data());
	int64_t numBlocks = 0;
	for (const int p : half.m_panels)
	{
		const BlockPanel& panel = m_panels[size_t(p)];
		numBlocks += int64_t(panel.m_numColumns) * panel.m_numRows;
		double* const own = &m_forward[6 * size_t(panel.m_first)];
		double* const end = own + 6 * panel.m_numColumns;
		half.m_start.push_back(int(half.m_values.size()));
		half.m_values.insert(half.m_values.end(), own, end);
		std::fill(own, end, 0.);
	}
	half.m_start.push_back(int(half.m_values.size()));
	return numBlocks;
}

double HalfSolution::multiply(const HalfSolution& b, const HalfSolution& c)
{
	// Six sums, so that additions do not wait for each other.
	double sum[6] = {};
	for (size_t i = 0, j = 0; i < b.m_panels.size() && j < c.m_panels.size();)
	{
		if (b.m_panels[i] != c.m_panels[j])
		{
			b.m_panels[i] < c.m_panels[j] ? ++i : ++j;
			continue;
		}
		const double *x = &b.m_values[size_t(b.m_start[i])], *y = &c.m_values[size_t(c.m_start[j])];
		for (const double* const end = x + (b.m_start[i + 1] - b.m_start[i]); x < end; x += 6, y += 6)
			for (int k = 0; k < 6; ++k)
				sum[k] += x[k] * y[k];
		++i;
		++j;
	}
	return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + (sum[4] + sum[5]);
}

void BlockFactor::getComplement(int numLast, std::vector<double>& complement) const
{
	// S = L L^T of the last bodies' rows and columns, column by column.
	const int n = getNumBodies(), first = n - numLast;
	const size_t size = 6 * size_t(numLast);
	complement.assign(size * size, 0.);
	std::vector<double> column(size);
	std::vector<int> rows;
	for (int p = 0; p + 1 < int(m_panels.size()); ++p)
	{
		const BlockPanel& panel = m_panels[size_t(p)];
		rows.clear();
		for (int c = 0; c < panel.m_numColumns; ++c)
			rows.push_back(m_bodies[size_t(panel.m_first + c)] - first);
		for (int r = panel.m_below; r < m_panels[size_t(p) + 1].m_below; ++r)
			rows.push_back(m_bodies[size_t(m_below[size_t(r)])] - first);
		const size_t stride = 6 * rows.size();
		for (int c = 0; c < panel.m_numColumns; ++c)
			for (int k = 0; rows[size_t(c)] >= 0 && k < 6; ++k)
			{
				const double* const from = &m_values[panel.m_values + (6 * size_t(c) + size_t(k)) * stride];
				std::fill(column.begin(), column.end(), 0.);
				for (size_t r = size_t(c); r < rows.size(); ++r)
					for (size_t i = r == size_t(c) ? size_t(k) : 0; i < 6; ++i)
						column[6 * size_t(rows[r]) + i] = from[6 * r + i];
				for (size_t j = 0; j < size; ++j)
				{
					const double factor = column[j];
					double* const to = &complement[size * j];
					for (size_t i = 0; factor != 0 && i < size; ++i)
						to[i] += factor * column[i];
				}
			}
	}
}

int64_t BlockFactor::getMemory() const
{
	const auto bytes = [](const auto& v) { return int64_t(v.capacity() * sizeof(v[0])); };
	return bytes(m_bodies) + bytes(m_panelOf) + bytes(m_parent) + bytes(m_panels) + bytes(m_updates) + bytes(m_runs) +
		   bytes(m_loads) + bytes(m_below) + bytes(m_values) + bytes(m_inverse) + bytes(m_isChanged) +
		   bytes(m_changed) + bytes(m_work) + bytes(m_column) + bytes(m_forward);
}
}  // namespace btElasticPlastic
