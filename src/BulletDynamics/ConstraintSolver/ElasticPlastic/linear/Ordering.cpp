// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Ordering.h"

#include <algorithm>
#include <cmath>

namespace btElasticPlastic
{
// Eliminating a node joins all its neighbours to each other. Minimum degree always takes the node with the fewest neighbours
// next. The graph is never formed: an eliminated node p becomes an *element*, the list L_p of the nodes it has joined, and a
// node's neighbours are the nodes it still has from the start (A_i) and those of its elements (E_i). P. R. Amestoy,
// T. A. Davis, I. S. Duff, An approximate minimum degree ordering algorithm, SIAM J. Matrix Anal. Appl. 17 (1996), add:
//  - the degree's upper bound |A_i| + |L_p \ i| + sum over other elements e of |L_e \ L_p| in place of the degree;
//  - nodes with the same neighbours are one: a node of size > 1;
//  - a node of L_p without other neighbours is eliminated with p;
//  - an element within L_p is dropped.
// Nodes with very many neighbours would make the time quadratic. They come last in any case, and are put there from the start.

namespace
{
const int None = -1;

class MinimumDegree
{
public:
	MinimumDegree(int n, const int* start, const int* neighbours);
	void run(int numLast, std::vector<int>& order);

private:
	const int m_n;
	int m_numEliminated = 0;
	int m_least = 0;  // no node has a lower degree

	// The number of nodes that a node stands for. It is 0 once the node is eliminated or a part of another one, and negative while
	// the node is a member of the pivot's L_p.
	std::vector<int> m_size;
	std::vector<int> m_degree;  // of nodes; of elements: the sum of sizes in L_e, 0 if dropped
	std::vector<int> m_list;    // E_i, then A_i
	std::vector<int> m_start, m_numElements, m_length;
	// Doubly linked lists of the nodes of each degree, first in, first out. Last in, first out, as is customary, takes a tenth more
	// operations on walls and solids, and eliminates chains from one end instead of from both.
	std::vector<int> m_head, m_tail, m_next, m_previous;
	// Linked lists of the parts of each node, in order.
	std::vector<int> m_part, m_lastPart;

	std::vector<int> m_members;  // L_e of all elements
	std::vector<int> m_membersStart, m_membersEnd;
	std::vector<int> m_outside;  // |L_e \ L_p| if stamped
	std::vector<int> m_stamp, m_mark;
	int m_lastMark = 0;
	std::vector<int> m_bucket, m_nextInBucket, m_hash;

	void enter(int node, int degree);
	void leave(int node);
	int takeLeast();
	void absorb(int node, int part);
	void joinNeighbours(int pivot);
	void measureElements(int pivot);
	void updateNode(int pivot, int node);
	void mergeEqualNodes(int pivot);
	bool haveEqualNeighbours(int a, int b);
	void finishElement(int pivot);
	bool inPivot(int node) const { return m_size[node] < 0; }
};

MinimumDegree::MinimumDegree(int n, const int* start, const int* neighbours)
	: m_n(n),
	  m_size(n, 1),
	  m_degree(n),
	  m_list(neighbours, neighbours + start[n]),
	  m_start(start, start + n),
	  m_numElements(n, 0),
	  m_length(n),
	  m_head(n + 1, None),
	  m_tail(n + 1, None),
	  m_next(n, None),
	  m_previous(n, None),
	  m_part(n, None),
	  m_lastPart(n),
	  m_membersStart(n),
	  m_membersEnd(n),
	  m_outside(n),
	  m_stamp(n, None),
	  m_mark(n, 0),
	  m_bucket(n, None),
	  m_nextInBucket(n, None),
	  m_hash(n)
{
	for (int i = 0; i < n; ++i)
	{
		m_degree[i] = m_length[i] = start[i + 1] - start[i];
		m_lastPart[i] = i;
	}
}

void MinimumDegree::run(int numLast, std::vector<int>& order)
{
	order.clear();
	order.reserve(m_n);
	const int many = std::max(16, int(10 * std::sqrt(double(m_n))));
	std::vector<int> last;
	for (int i = 0; i < m_n; ++i)
		if (m_degree[i] > many || i >= m_n - numLast)
		{
			last.push_back(i);
			m_size[i] = 0;
			++m_numEliminated;
		}
		else
			enter(i, m_degree[i]);

	while (m_numEliminated < m_n)
	{
		const int pivot = takeLeast();
		m_numEliminated += m_size[pivot];
		joinNeighbours(pivot);
		measureElements(pivot);
		for (int k = m_membersStart[pivot]; k < m_membersEnd[pivot]; ++k)
			updateNode(pivot, m_members[k]);
		mergeEqualNodes(pivot);
		finishElement(pivot);
		for (int i = pivot; i != None; i = m_part[i])
			order.push_back(i);
	}
	order.insert(order.end(), last.begin(), last.end());
}

void MinimumDegree::enter(int node, int degree)
{
	m_degree[node] = degree;
	m_next[node] = None;
	m_previous[node] = m_tail[degree];
	if (m_previous[node] != None)
		m_next[m_previous[node]] = node;
	else
		m_head[degree] = node;
	m_tail[degree] = node;
	m_least = std::min(m_least, degree);
}

void MinimumDegree::leave(int node)
{
	if (m_next[node] != None)
		m_previous[m_next[node]] = m_previous[node];
	else
		m_tail[m_degree[node]] = m_previous[node];
	if (m_previous[node] != None)
		m_next[m_previous[node]] = m_next[node];
	else
		m_head[m_degree[node]] = m_next[node];
}

int MinimumDegree::takeLeast()
{
	while (m_head[m_least] == None)
		++m_least;
	const int node = m_head[m_least];
	leave(node);
	return node;
}

void MinimumDegree::absorb(int node, int part)
{
	m_size[part] = 0;
	m_part[m_lastPart[node]] = part;
	m_lastPart[node] = m_lastPart[part];
}

// Forms L_p, all neighbours of the pivot. The pivot's own elements lie within L_p and are dropped. Members of L_p have negative
// sizes until finishElement().
void MinimumDegree::joinNeighbours(int pivot)
{
	m_size[pivot] = -m_size[pivot];
	m_membersStart[pivot] = int(m_members.size());
	int degree = 0;
	const auto join = [&](int node)
	{
		if (m_size[node] <= 0)
			return;
		leave(node);
		degree += m_size[node];
		m_size[node] = -m_size[node];
		m_members.push_back(node);
	};
	const int* list = m_list.data() + m_start[pivot];
	for (int k = 0; k < m_numElements[pivot]; ++k)
	{
		const int element = list[k];
		for (int q = m_membersStart[element]; q < m_membersEnd[element]; ++q)
			join(m_members[q]);
		m_degree[element] = 0;
	}
	for (int k = m_numElements[pivot]; k < m_length[pivot]; ++k)
		join(list[k]);
	m_membersEnd[pivot] = int(m_members.size());
	m_degree[pivot] = degree;
}

void MinimumDegree::measureElements(int pivot)
{
	for (int k = m_membersStart[pivot]; k < m_membersEnd[pivot]; ++k)
	{
		const int node = m_members[k];
		const int* list = m_list.data() + m_start[node];
		for (int q = 0; q < m_numElements[node]; ++q)
		{
			const int element = list[q];
			if (m_stamp[element] != pivot)
			{
				m_stamp[element] = pivot;
				m_outside[element] = m_degree[element];
			}
			m_outside[element] += m_size[node];
		}
	}
}

void MinimumDegree::updateNode(int pivot, int node)
{
	int* list = m_list.data() + m_start[node];
	int degree = 0, numKept = 0;
	unsigned hash = unsigned(pivot);
	for (int q = 0; q < m_numElements[node]; ++q)
	{
		const int element = list[q];
		if (m_degree[element] == 0)
			continue;
		if (m_outside[element] == 0)
		{
			m_degree[element] = 0;
			continue;
		}
		degree += m_outside[element];
		hash += unsigned(element);
		list[numKept++] = element;
	}
	const int numElements = numKept;
	for (int q = m_numElements[node]; q < m_length[node]; ++q)
	{
		const int neighbour = list[q];
		if (m_size[neighbour] <= 0)
			continue;
		degree += m_size[neighbour];
		hash += unsigned(neighbour);
		list[numKept++] = neighbour;
	}
	const int size = -m_size[node];
	if (degree == 0)
	{
		m_degree[pivot] -= size;
		m_numEliminated += size;
		m_size[pivot] -= size;
		absorb(pivot, node);
		return;
	}
	// The pivot enters the list as a new element. There is room for it, as either the pivot itself or one of its elements has left.
	list[numKept] = list[numElements];
	list[numElements] = pivot;
	m_numElements[node] = numElements + 1;
	m_length[node] = numKept + 1;
	m_degree[node] = std::min(m_degree[node], degree);
	m_hash[node] = int(hash % unsigned(m_n));
	m_nextInBucket[node] = m_bucket[m_hash[node]];
	m_bucket[m_hash[node]] = node;
}

void MinimumDegree::mergeEqualNodes(int pivot)
{
	for (int k = m_membersStart[pivot]; k < m_membersEnd[pivot]; ++k)
	{
		const int member = m_members[k];
		if (!inPivot(member))
			continue;
		int first = m_bucket[m_hash[member]];
		m_bucket[m_hash[member]] = None;
		for (; first != None && m_nextInBucket[first] != None; first = m_nextInBucket[first])
		{
			++m_lastMark;
			for (int q = 0; q < m_length[first]; ++q)
				m_mark[m_list[m_start[first] + q]] = m_lastMark;
			for (int before = first, other; (other = m_nextInBucket[before]) != None;)
				if (haveEqualNeighbours(first, other))
				{
					m_size[first] += m_size[other];
					absorb(first, other);
					m_nextInBucket[before] = m_nextInBucket[other];
				}
				else
					before = other;
		}
	}
}

bool MinimumDegree::haveEqualNeighbours(int a, int b)
{
	if (m_length[a] != m_length[b] || m_numElements[a] != m_numElements[b])
		return false;
	for (int q = 0; q < m_length[b]; ++q)
		if (m_mark[m_list[m_start[b] + q]] != m_lastMark)
			return false;
	return true;
}

void MinimumDegree::finishElement(int pivot)
{
	int end = m_membersStart[pivot];
	for (int k = m_membersStart[pivot]; k < m_membersEnd[pivot]; ++k)
	{
		const int node = m_members[k];
		if (!inPivot(node))
			continue;
		const int size = m_size[node] = -m_size[node];
		enter(node, std::min(m_degree[node] + m_degree[pivot] - size, m_n - m_numEliminated - size));
		m_members[end++] = node;
	}
	m_members.resize(end);
	m_membersEnd[pivot] = end;
	m_size[pivot] = 0;
}
}  // namespace

void minimumDegree(int n, const int* start, const int* neighbours, int numLast, std::vector<int>& order)
{
	MinimumDegree(n, start, neighbours).run(numLast, order);
}
}  // namespace btElasticPlastic
