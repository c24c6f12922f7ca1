// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "BlockMatrix.h"

#include <algorithm>

#include "LinearMath/btScalar.h"

namespace btElasticPlastic
{
void BlockMatrix::setPattern(int numBodies, const int (*edges)[2], int numEdges)
{
	m_numBodies = numBodies;
	m_edgePair.resize(numEdges);
	m_edgeTransposed.resize(numEdges);
	m_lower.clear();
	m_higher.clear();

	// Two passes of a stable counting sort put the edges in the order of their lower bodies, then of their higher ones.
	std::vector<int> byHigher(numEdges), sorted(numEdges), start;
	const auto sort = [&](const std::vector<int>* from, std::vector<int>& to, auto key)
	{
		start.assign(numBodies + 1, 0);
		for (int e = 0; e < numEdges; ++e)
			++start[key(e) + 1];
		for (int i = 0; i < numBodies; ++i)
			start[i + 1] += start[i];
		for (int i = 0; i < numEdges; ++i)
		{
			const int e = from ? (*from)[i] : i;
			to[start[key(e)]++] = e;
		}
	};
	sort(nullptr, byHigher, [edges](int e) { return std::max(edges[e][0], edges[e][1]); });
	sort(&byHigher, sorted, [edges](int e) { return std::min(edges[e][0], edges[e][1]); });

	for (const int e : sorted)
	{
		btAssert(edges[e][0] != edges[e][1]);
		const int lower = std::min(edges[e][0], edges[e][1]);
		const int higher = std::max(edges[e][0], edges[e][1]);
		if (m_lower.empty() || m_lower.back() != lower || m_higher.back() != higher)
		{
			m_lower.push_back(lower);
			m_higher.push_back(higher);
		}
		m_edgePair[e] = getNumPairs() - 1;
		m_edgeTransposed[e] = edges[e][0] == lower;
	}
}

void BlockMatrix::setZero()
{
	if (!hasValues())
		m_values.resize(getNumValues());
	std::fill_n(m_values.begin(), getNumValues(), 0.0);
}

void BlockMatrix::multiply(const double* x, double* y) const
{
	for (int i = 0; i < m_numBodies; ++i)
	{
		const double* block = diagonal(i);
		double sum[6] = {};
		for (int c = 0; c < 6; ++c)
			for (int r = 0; r < 6; ++r)
				sum[r] += block[6 * c + r] * x[6 * i + c];
		for (int r = 0; r < 6; ++r)
			y[6 * i + r] = sum[r];
	}
	for (int pair = 0; pair < getNumPairs(); ++pair)
	{
		const double* block = &m_values[36 * (size_t(m_numBodies) + pair)];
		const int lower = 6 * m_lower[pair];
		const int higher = 6 * m_higher[pair];
		double sum[6] = {};
		for (int c = 0; c < 6; ++c)
		{
			double mirrored = 0;
			for (int r = 0; r < 6; ++r)
			{
				sum[r] += block[6 * c + r] * x[lower + c];
				mirrored += block[6 * c + r] * x[higher + r];
			}
			y[lower + c] += mirrored;
		}
		for (int r = 0; r < 6; ++r)
			y[higher + r] += sum[r];
	}
}
}  // namespace btElasticPlastic
