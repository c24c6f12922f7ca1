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

#ifndef BT_ELASTIC_PLASTIC_ORDERING_H
#define BT_ELASTIC_PLASTIC_ORDERING_H

#include <vector>

/// An order of elimination that keeps the Cholesky factor of a symmetric sparse matrix sparse: approximate minimum degree.
/// Depends on the graph and its numbering only, so it is the same on every machine.
///
/// \param n          number of nodes
/// \param start      n + 1 entries: node i's neighbours are neighbours[start[i]] to neighbours[start[i + 1] - 1]
/// \param neighbours each edge from both its ends, no node its own neighbour, none twice
/// \param order      the node to be eliminated first, second, ...
void btElasticPlasticMinimumDegree(int n, const int* start, const int* neighbours, std::vector<int>& order);

#endif  // BT_ELASTIC_PLASTIC_ORDERING_H
