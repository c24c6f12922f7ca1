// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The order of elimination: how much it fills in, against known figures.

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "linear/BlockGraphs.h"
#include "BulletDynamics/ConstraintSolver/ElasticPlastic/linear/Ordering.h"

namespace testOrdering
{
using ep::BlockGraph;

/// Blocks of L without the zeros that panels store.
int64_t fillOf(const BlockGraph& graph)
{
	const int n = graph.m_numBodies;
	std::vector<std::vector<int>> neighbours(n), rows(n);
	for (const auto& edge : graph.m_edges)
	{
		neighbours[edge[0]].push_back(edge[1]);
		neighbours[edge[1]].push_back(edge[0]);
	}
	std::vector<int> start(1, 0), all, order, position(n, -1);
	for (std::vector<int>& list : neighbours)
	{
		std::sort(list.begin(), list.end());
		list.erase(std::unique(list.begin(), list.end()), list.end());
		all.insert(all.end(), list.begin(), list.end());
		start.push_back(int(all.size()));
	}
	btElasticPlastic::minimumDegree(n, start.data(), all.data(), 0, order);
	EXPECT_EQ(int(order.size()), n);
	for (int j = 0; j < n; ++j)
		position[order[j]] = j;
	EXPECT_EQ(std::count(position.begin(), position.end(), -1), 0);

	int64_t blocks = 0;
	for (int j = 0; j < n; ++j)
	{
		for (const int i : neighbours[order[j]])
			if (position[i] > j)
				rows[j].push_back(position[i]);
		std::sort(rows[j].begin(), rows[j].end());
		rows[j].erase(std::unique(rows[j].begin(), rows[j].end()), rows[j].end());
		blocks += 1 + int64_t(rows[j].size());
		if (!rows[j].empty())
			rows[rows[j][0]].insert(rows[rows[j][0]].end(), rows[j].begin() + 1, rows[j].end());
	}
	return blocks;
}

TEST(Ordering, FillIsThatOfTheBestImplementations)
{
	// Trees have none.
	EXPECT_EQ(fillOf(ep::chains(1, 20000)), 39999);
	EXPECT_EQ(fillOf(ep::star(1999)), 3999);
	EXPECT_EQ(fillOf(ep::randomTree(5000, 12)), 9999);
	// Eigen 3.4's AMDOrdering has these numbers.
	EXPECT_LT(fillOf(ep::frame()), 1.05 * 39079);
	EXPECT_LT(fillOf(ep::wall()), 1.05 * 70137);
	EXPECT_LT(fillOf(ep::grid(100, 100, 1)), 1.05 * 219757);
	EXPECT_LT(fillOf(ep::grid(20, 20, 20)), 1.05 * 869488);
}
}  // namespace testOrdering
