// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_ORDERING_H
#define BT_ELASTIC_PLASTIC_ORDERING_H

#include <vector>

namespace btElasticPlastic
{
/// Finds an order of elimination that keeps the Cholesky factor of a symmetric sparse matrix sparse, by approximate minimum
/// degree. The order depends on the graph and its numbering only, so it is the same on every machine.
///
/// \param n          number of nodes
/// \param start      n + 1 entries: node i's neighbours are neighbours[start[i]] to neighbours[start[i + 1] - 1]
/// \param neighbours each edge from both its ends, no node its own neighbour, none twice
/// \param numLast    so many of the highest nodes are eliminated last
/// \param order      gets the nodes in the order in which they are to be eliminated
void minimumDegree(int n, const int* start, const int* neighbours, int numLast, std::vector<int>& order);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_ORDERING_H
