// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "BroadphaseState.h"

#include <algorithm>
#include <functional>
#include <new>

#include "BulletCollision/BroadphaseCollision/btDbvtBroadphase.h"
#include "BulletCollision/CollisionDispatch/btCollisionObject.h"

namespace btElasticPlastic
{
namespace
{
typedef std::vector<btDbvtNode*> Nodes;

btDbvtProxy* proxyOf(const btCollisionObject& object)
{
	return static_cast<btDbvtProxy*>(const_cast<btBroadphaseProxy*>(object.getBroadphaseHandle()));
}

/// The nodes of a tree in the order of TreeImage.
Nodes walk(const btDbvt& tree)
{
	Nodes nodes, ahead;
	if (tree.m_root)
		ahead.push_back(tree.m_root);
	while (!ahead.empty())
	{
		btDbvtNode* const node = ahead.back();
		ahead.pop_back();
		nodes.push_back(node);
		for (int child = 1; child >= 0 && node->isinternal(); --child)
			ahead.push_back(node->childs[child]);
	}
	return nodes;
}

/// The nodes of a tree, and the one that it keeps for later, by their addresses.
Nodes sortedNodes(const btDbvt& tree)
{
	Nodes nodes = walk(tree);
	if (tree.m_free)
		nodes.push_back(tree.m_free);
	std::sort(nodes.begin(), nodes.end(), std::less<btDbvtNode*>());
	return nodes;
}

/// Counts a number that must occur once. \return false if it is out of range or has occurred before
bool countOnce(std::vector<char>& seen, int number)
{
	if (number < 0 || size_t(number) >= seen.size() || seen[size_t(number)])
		return false;
	seen[size_t(number)] = 1;
	return true;
}
}  // namespace

BroadphaseState::BroadphaseState(btDbvtBroadphase& broadphase, const std::vector<btCollisionObject*>& objects)
	: m_broadphase(broadphase), m_objects(objects), m_rankOfPlace(objects.size(), -1)
{
	for (size_t i = 0; i < objects.size(); ++i)
		m_rankOfPlace[size_t(objects[i]->getWorldArrayIndex())] = int(i);
}

// ---- reading

int BroadphaseState::rankOf(const btBroadphaseProxy& proxy) const
{
	return m_rankOfPlace[size_t(static_cast<const btCollisionObject*>(proxy.m_clientObject)->getWorldArrayIndex())];
}

TreeImage BroadphaseState::readTree(int set) const
{
	const btDbvt& tree = m_broadphase.m_sets[set];
	Nodes nodes = walk(tree);
	TreeImage image;
	image.m_path = tree.m_opath;
	image.m_nodes.resize(nodes.size());
	for (size_t i = 0; i < nodes.size(); ++i)
	{
		NodeImage& to = image.m_nodes[i];
		to.m_object = nodes[i]->isleaf() ? rankOf(*static_cast<btDbvtProxy*>(nodes[i]->data)) : -1;
		to.m_low = nodes[i]->volume.Mins();
		to.m_high = nodes[i]->volume.Maxs();
	}
	if (tree.m_free)
		nodes.push_back(tree.m_free);
	std::vector<std::pair<btDbvtNode*, size_t>> sorted(nodes.size());
	for (size_t i = 0; i < nodes.size(); ++i)
		sorted[i] = {nodes[i], i};
	std::sort(sorted.begin(), sorted.end(),
			  [](const auto& a, const auto& b) { return std::less<btDbvtNode*>()(a.first, b.first); });
	for (size_t rank = 0; rank < sorted.size(); ++rank)
		(sorted[rank].second < image.m_nodes.size() ? image.m_nodes[sorted[rank].second].m_addressRank
													: image.m_freeRank) = int(rank);
	return image;
}

BroadphaseImage BroadphaseState::read() const
{
	const btDbvtBroadphase& b = m_broadphase;
	BroadphaseImage image;
	for (int set = 0; set < 2; ++set)
		image.m_trees[set] = readTree(set);
	image.m_boxes.reserve(2 * m_objects.size());
	for (const btCollisionObject* object : m_objects)
	{
		image.m_boxes.push_back(proxyOf(*object)->m_aabbMin);
		image.m_boxes.push_back(proxyOf(*object)->m_aabbMax);
	}
	for (int stage = 0; stage <= btDbvtBroadphase::STAGECOUNT; ++stage)
		for (const btDbvtProxy* proxy = b.m_stageRoots[stage]; proxy; proxy = proxy->links[1])
			image.m_stages[stage].push_back(rankOf(*proxy));
	image.m_stage = b.m_stageCurrent;
	image.m_newPairs = b.m_newpairs;
	image.m_fixedLeft = b.m_fixedleft;
	image.m_parse = b.m_pid;
	image.m_cleanup = b.m_cid;
	image.m_calls = b.m_updates_call;
	image.m_done = b.m_updates_done;
	image.m_ratio = b.m_updates_ratio;
	image.m_needsCleanup = b.m_needcleanup;
	return image;
}

// ---- writing

bool BroadphaseState::isSound(const BroadphaseImage& image, int numObjects)
{
	std::vector<char> hasLeaf(size_t(numObjects), 0), hasStage(size_t(numObjects), 0);
	for (const TreeImage& tree : image.m_trees)
	{
		std::vector<char> hasRank(tree.m_nodes.size() + (tree.m_freeRank >= 0), 0);
		if (tree.m_freeRank >= 0 && !countOnce(hasRank, tree.m_freeRank))
			return false;
		// So many nodes are still to come; after each inner node one more.
		size_t due = !tree.m_nodes.empty();
		for (const NodeImage& node : tree.m_nodes)
		{
			if (due == 0 || !countOnce(hasRank, node.m_addressRank))
				return false;
			if (node.m_object >= 0 && !countOnce(hasLeaf, node.m_object))
				return false;
			due += node.m_object >= 0 ? size_t(-1) : 1;
		}
		if (due != 0)
			return false;
	}
	for (int stage = 0; stage <= btDbvtBroadphase::STAGECOUNT; ++stage)
		for (const int object : image.m_stages[stage])
			if (!countOnce(hasStage, object))
				return false;
	// What stands still is in the second tree.
	size_t numStill = 0;
	for (const NodeImage& node : image.m_trees[1].m_nodes)
		numStill += node.m_object >= 0;
	const std::vector<int>& still = image.m_stages[btDbvtBroadphase::STAGECOUNT];
	std::vector<char> isStill(size_t(numObjects), 0);
	for (const int object : still)
		isStill[size_t(object)] = 1;
	for (const NodeImage& node : image.m_trees[1].m_nodes)
		if (node.m_object >= 0 && !isStill[size_t(node.m_object)])
			return false;
	return numStill == still.size() && std::count(hasLeaf.begin(), hasLeaf.end(), 0) == 0 &&
		   std::count(hasStage.begin(), hasStage.end(), 0) == 0 && image.m_boxes.size() == 2 * size_t(numObjects) &&
		   image.m_stage >= 0 && image.m_stage < btDbvtBroadphase::STAGECOUNT && image.m_cleanup >= 0 &&
		   image.m_newPairs >= 0 && image.m_fixedLeft >= 0;
}

/// Uses the tree's nodes again where it can: restored in the world from which it was taken, each part of the tree is in its place.
void BroadphaseState::writeTree(int set, const TreeImage& image)
{
	btDbvt& tree = m_broadphase.m_sets[set];
	Nodes nodes = sortedNodes(tree);
	const size_t count = image.m_nodes.size() + (image.m_freeRank >= 0);
	for (; nodes.size() > count; nodes.pop_back())
		btAlignedFree(nodes.back());
	while (nodes.size() < count)
		nodes.push_back(new (btAlignedAlloc(sizeof(btDbvtNode), 16)) btDbvtNode());
	std::sort(nodes.begin(), nodes.end(), std::less<btDbvtNode*>());
	tree.m_root = nullptr;
	tree.m_free = image.m_freeRank >= 0 ? nodes[size_t(image.m_freeRank)] : nullptr;
	tree.m_opath = image.m_path;
	tree.m_leaves = 0;
	// Where the next node goes.
	std::vector<std::pair<btDbvtNode*, int>> places;
	for (const NodeImage& from : image.m_nodes)
	{
		btDbvtNode* const node = nodes[size_t(from.m_addressRank)];
		node->volume = btDbvtVolume::FromMM(from.m_low, from.m_high);
		node->parent = places.empty() ? nullptr : places.back().first;
		(places.empty() ? tree.m_root : places.back().first->childs[places.back().second]) = node;
		if (!places.empty())
			places.pop_back();
		if (from.m_object < 0)
		{
			places.push_back({node, 1});
			places.push_back({node, 0});
			continue;
		}
		btDbvtProxy* const proxy = proxyOf(*m_objects[size_t(from.m_object)]);
		node->data = proxy;
		node->childs[1] = nullptr;
		proxy->leaf = node;
		++tree.m_leaves;
	}
}

void BroadphaseState::write(const BroadphaseImage& image)
{
	btDbvtBroadphase& b = m_broadphase;
	for (int set = 0; set < 2; ++set)
		writeTree(set, image.m_trees[set]);
	for (size_t i = 0; i < m_objects.size(); ++i)
	{
		proxyOf(*m_objects[i])->m_aabbMin = image.m_boxes[2 * i];
		proxyOf(*m_objects[i])->m_aabbMax = image.m_boxes[2 * i + 1];
	}
	for (int stage = 0; stage <= btDbvtBroadphase::STAGECOUNT; ++stage)
	{
		b.m_stageRoots[stage] = nullptr;
		btDbvtProxy* last = nullptr;
		for (const int object : image.m_stages[stage])
		{
			btDbvtProxy* const proxy = proxyOf(*m_objects[size_t(object)]);
			proxy->stage = stage;
			proxy->links[0] = last;
			proxy->links[1] = nullptr;
			(last ? last->links[1] : b.m_stageRoots[stage]) = proxy;
			last = proxy;
		}
	}
	b.m_stageCurrent = image.m_stage;
	b.m_newpairs = image.m_newPairs;
	b.m_fixedleft = image.m_fixedLeft;
	b.m_pid = image.m_parse;
	b.m_cid = image.m_cleanup;
	b.m_updates_call = image.m_calls;
	b.m_updates_done = image.m_done;
	b.m_updates_ratio = image.m_ratio;
	b.m_needcleanup = image.m_needsCleanup;
}
}  // namespace btElasticPlastic
