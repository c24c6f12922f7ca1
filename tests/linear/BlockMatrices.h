// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BLOCK_MATRICES_H
#define EP_BLOCK_MATRICES_H

// Block matrices on graphs, and what is compared with them.

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "linear/BlockGraphs.h"

namespace ep
{
using Matrix = btElasticPlastic::BlockMatrix;
using Values = std::vector<double>;

inline Matrix matrixOf(const BlockGraph& graph, double stiffness = 10, unsigned seed = 1)
{
	Matrix matrix;
	matrix.setPattern(graph.m_numBodies, graph.edges(), int(graph.m_edges.size()));
	assemble(graph, stiffness, seed, matrix);
	return matrix;
}

inline Values randomValues(int numBodies, unsigned seed = 7)
{
	std::mt19937 random(seed);
	Values x(6 * size_t(numBodies));
	for (double& value : x)
		value = double(random()) / 2147483648.0 - 1;
	return x;
}

inline Values product(const Matrix& matrix, const Values& x)
{
	Values y(x.size());
	matrix.multiply(x.data(), y.data());
	return y;
}

inline double norm(const Values& x)
{
	double largest = 0;
	for (const double value : x)
		largest = std::max(largest, fabs(value));
	return largest;
}

inline double difference(const Values& a, const Values& b)
{
	Values d(a.size());
	for (size_t i = 0; i < a.size(); ++i)
		d[i] = a[i] - b[i];
	return norm(d) / std::max(norm(a), 1e-300);
}

/// The matrix by the definition of its blocks: full, row by row.
inline Values dense(Matrix& matrix, const BlockGraph& graph)
{
	const size_t n = 6 * size_t(graph.m_numBodies);
	Values full(n * n);
	const auto put = [&](int rows, int columns, const double* block, bool transposed)
	{
		for (int r = 0; r < 6; ++r)
			for (int c = 0; c < 6; ++c)
				full[(6 * rows + r) * n + 6 * columns + c] = block[transposed ? 6 * r + c : 6 * c + r];
	};
	for (int i = 0; i < graph.m_numBodies; ++i)
		put(i, i, matrix.diagonal(i), false);
	for (int e = 0; e < int(graph.m_edges.size()); ++e)
	{
		bool transposed;
		const double* block = matrix.offDiagonal(e, transposed);
		put(graph.m_edges[e][0], graph.m_edges[e][1], block, transposed);
		put(graph.m_edges[e][1], graph.m_edges[e][0], block, !transposed);
	}
	return full;
}

inline BlockGraph withoutEdges(int numBodies)
{
	BlockGraph graph;
	graph.m_numBodies = numBodies;
	return graph;
}

/// Parts that have nothing to do with each other, in one graph.
inline BlockGraph together(const std::vector<BlockGraph>& parts)
{
	BlockGraph graph;
	for (const BlockGraph& part : parts)
	{
		for (const auto& edge : part.m_edges)
			graph.join(graph.m_numBodies + edge[0], graph.m_numBodies + edge[1]);
		graph.m_numBodies += part.m_numBodies;
	}
	return graph;
}

inline const std::vector<std::pair<std::string, BlockGraph>>& smallGraphs()
{
	static const std::vector<std::pair<std::string, BlockGraph>> graphs = {
		{"body", withoutEdges(1)},
		{"bodies", withoutEdges(5)},
		{"pair", chains(1, 2)},
		{"chain", chains(1, 30)},
		{"chains", chains(7, 4)},
		{"plate", grid(7, 6, 1)},
		{"solid", grid(3, 4, 4)},
		{"star", star(40)},
		{"tree", randomTree(50, 3)},
		{"sparse", randomGraph(45, 60, 4)},
		{"dense", randomGraph(30, 400, 5)},
		{"complete", randomGraph(9, 400, 6)},
		{"parts", together({grid(4, 4, 1), withoutEdges(2), star(5), chains(1, 6)})},
	};
	return graphs;
}
}  // namespace ep

#endif  // EP_BLOCK_MATRICES_H
