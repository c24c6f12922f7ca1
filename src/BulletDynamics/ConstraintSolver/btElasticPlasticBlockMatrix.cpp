/*
Bullet Elastic-Plastic: joints for Bullet Physics that bend before they break
Copyright (c) 2026 Bullet Elastic-Plastic contributors

This software is provided 'as-is', without any express or implied warranty.
In no event will the authors be held liable for any damages arising from the use of this software.
Permission is granted to anyone to use this software for any purpose,
including commercial applications, and to alter it and redistribute it freely,
subject to the following restrictions:

1. The origin of this software must not be misrepresented; you must not claim that you wrote the original software. If you use this software in a product, an acknowledgment in the product documentation would be appreciated but is not required.
2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the original software.
3. This notice may not be removed or altered from any source distribution.
*/

#include "btElasticPlasticBlockMatrix.h"

#include <algorithm>

#include "LinearMath/btScalar.h"

void btElasticPlasticBlockMatrix::setPattern(int numBodies, const int (*edges)[2], int numEdges)
{
	m_numBodies = numBodies;
	m_edgePair.resize(numEdges);
	m_edgeTransposed.resize(numEdges);
	m_lower.clear();
	m_higher.clear();

	// Edges by lower body, then by higher, by two passes of a stable counting sort.
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
	m_values.assign(36 * (size_t(numBodies) + m_lower.size()), 0);
}

void btElasticPlasticBlockMatrix::setZero() { std::fill(m_values.begin(), m_values.end(), 0.0); }

void btElasticPlasticBlockMatrix::multiply(const double* x, double* y) const
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
