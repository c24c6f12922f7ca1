// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BLOCK_GRAPHS_H
#define EP_BLOCK_GRAPHS_H

// Graphs of bodies and joints, and matrices on them, for tests and benchmarks of btElasticPlastic::BlockFactor.

#include <array>
#include <random>
#include <vector>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/linear/BlockMatrix.h"

namespace ep
{
struct BlockGraph
{
	int m_numBodies = 0;
	std::vector<std::array<int, 2>> m_edges;

	void join(int a, int b) { m_edges.push_back({a, b}); }
	const int (*edges() const)[2] { return reinterpret_cast<const int(*)[2]>(m_edges.data()); }
};

inline BlockGraph chains(int number, int length)
{
	BlockGraph graph;
	graph.m_numBodies = number * length;
	for (int i = 0; i < graph.m_numBodies; ++i)
		if (i % length)
			graph.join(i - 1, i);
	return graph;
}

inline BlockGraph grid(int nx, int ny, int nz)
{
	BlockGraph graph;
	graph.m_numBodies = nx * ny * nz;
	for (int z = 0, i = 0; z < nz; ++z)
		for (int y = 0; y < ny; ++y)
			for (int x = 0; x < nx; ++x, ++i)
			{
				if (x)
					graph.join(i - 1, i);
				if (y)
					graph.join(i - nx, i);
				if (z)
					graph.join(i - nx * ny, i);
			}
	return graph;
}

inline BlockGraph star(int rays)
{
	BlockGraph graph;
	graph.m_numBodies = rays + 1;
	for (int i = 1; i <= rays; ++i)
		graph.join(0, i);
	return graph;
}

inline BlockGraph randomTree(int numBodies, unsigned seed)
{
	BlockGraph graph;
	graph.m_numBodies = numBodies;
	std::mt19937 random(seed);
	for (int i = 1; i < numBodies; ++i)
		graph.join(i, int(random() % i));
	return graph;
}

/// With edges that occur more than once, in both directions.
inline BlockGraph randomGraph(int numBodies, int numEdges, unsigned seed)
{
	BlockGraph graph;
	graph.m_numBodies = numBodies;
	std::mt19937 random(seed);
	while (int(graph.m_edges.size()) < numEdges)
	{
		const int a = int(random() % numBodies), b = int(random() % numBodies);
		if (a != b)
			graph.join(a, b);
	}
	return graph;
}

/// A wall of 70 x 70 plates with door openings in its lower part: 9070 joints with those to the ground.
inline BlockGraph wall()
{
	const int n = 70;
	BlockGraph graph;
	graph.m_numBodies = n * n;
	for (int y = 0; y < n; ++y)
		for (int x = 0; x < n; ++x)
		{
			if (x + 1 < n && (y > 20 || x / 10 % 2 == 0))
				graph.join(y * n + x, y * n + x + 1);
			if (y + 1 < n)
				graph.join(y * n + x, (y + 1) * n + x);
		}
	return graph;
}

/// A building's frame: 8 x 8 columns, 12 storeys, three elements from node to node: 8448 joints with those to the ground.
inline BlockGraph frame()
{
	const int nx = 8, nz = 8, ny = 12, numElements = 3;
	BlockGraph graph;
	graph.m_numBodies = nx * nz * ny;
	const auto node = [](int x, int y, int z) { return y == 0 ? -1 : ((y - 1) * nz + z) * nx + x; };
	const auto member = [&graph](int a, int b)
	{
		for (int e = 0; e < numElements; ++e)
		{
			const int element = graph.m_numBodies++;
			if (a >= 0)
				graph.join(a, element);
			a = element;
		}
		graph.join(a, b);
	};
	for (int y = 0; y <= ny; ++y)
		for (int z = 0; z < nz; ++z)
			for (int x = 0; x < nx; ++x)
			{
				if (y < ny)
					member(node(x, y, z), node(x, y + 1, z));
				if (y > 0 && x + 1 < nx)
					member(node(x, y, z), node(x + 1, y, z));
				if (y > 0 && z + 1 < nz)
					member(node(x, y, z), node(x, y, z + 1));
			}
	return graph;
}

/// As joints make it: masses on the diagonal, and stiffness [A B]^T [A B] over each edge with random A, B.
inline void assemble(const BlockGraph& graph, double stiffness, unsigned seed, btElasticPlastic::BlockMatrix& matrix)
{
	std::mt19937 random(seed);
	// The standard's distributions are not the same everywhere.
	const auto uniform = [&random] { return double(random()) / 2147483648.0 - 1; };
	matrix.setZero();
	for (int i = 0; i < graph.m_numBodies; ++i)
		for (int c = 0; c < 6; ++c)
			matrix.diagonal(i)[7 * c] = 1 + c;
	for (int e = 0; e < int(graph.m_edges.size()); ++e)
	{
		double a[6][6], b[6][6];
		for (int q = 0; q < 6; ++q)
			for (int c = 0; c < 6; ++c)
			{
				a[q][c] = uniform();
				b[q][c] = uniform();
			}
		bool transposed;
		double* const between = matrix.offDiagonal(e, transposed);
		double* const ofA = matrix.diagonal(graph.m_edges[e][0]);
		double* const ofB = matrix.diagonal(graph.m_edges[e][1]);
		for (int r = 0; r < 6; ++r)
			for (int c = 0; c < 6; ++c)
				for (int q = 0; q < 6; ++q)
				{
					ofA[6 * c + r] += stiffness * (a[q][r] * a[q][c]);
					ofB[6 * c + r] += stiffness * (b[q][r] * b[q][c]);
					between[transposed ? 6 * r + c : 6 * c + r] += stiffness * (a[q][r] * b[q][c]);
				}
	}
}
}  // namespace ep

#endif  // EP_BLOCK_GRAPHS_H
