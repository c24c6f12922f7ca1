// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_ISLANDS_H
#define BT_ELASTIC_PLASTIC_ISLANDS_H

#include <stdint.h>
#include <vector>

#include "../Prefetch.h"
#include "BulletDynamics/ConstraintSolver/btTypedConstraint.h"

class btCollisionObject;
class btPersistentManifold;
class btTypedConstraint;

namespace btElasticPlastic
{
class JointWorks;

/// What Bullet gives a solver at a time: one or several islands, as it joins small ones to batches.
struct SolverGroup
{
	btCollisionObject** m_bodies = nullptr;
	int m_numBodies = 0;
	btPersistentManifold** m_manifolds = nullptr;
	int m_numManifolds = 0;
	btTypedConstraint** m_constraints = nullptr;
	int m_numConstraints = 0;
	JointWorks** m_joints = nullptr;  ///< per constraint, null if it is not elastic-plastic

	/// Has the processor load what Bullet's base class holds of a constraint some places further on.
	void prefetchAfter(int constraint) const
	{
		if (constraint + PREFETCH_AHEAD < m_numConstraints)
			prefetch(m_constraints[constraint + PREFETCH_AHEAD], m_constraints[constraint + PREFETCH_AHEAD] + 1);
	}

	/// What a joint has of its own.
	void prefetchJointAfter(int constraint) const;
};

/// Takes a group apart: each island with elastic-plastic joints by itself, all others together.
///
/// An island here is what constraints and contacts join. Bullet's own may be larger, because it also joins bodies whose
/// bounding boxes have overlapped, until it checks the pair again, which depends on the rest of the world. Moreover, Bullet's
/// sort by islands is not stable. Here every island is sorted by the order in which its bodies were added to the world (the
/// broadphase's uids), so that it gives the same bits whatever else is in the world. What has no elastic-plastic joints stays
/// in Bullet's order.
class Islands
{
public:
	/// Finds the islands of a group, by its constraints and by the contacts that there are.
	void find(const SolverGroup& group);

	/// After find(): whether a body has an elastic-plastic joint, and moves.
	bool isJoined(const btCollisionObject& body) const
	{
		return isMember(body) && m_isJoined[size_t(body.getCompanionId())] != 0;
	}
	/// After find(): how many constraints the island of two bodies has, or will have once they touch.
	int countConstraints(const btCollisionObject& a, const btCollisionObject& b);

	/// Takes a group apart, after find(). Bodies, manifolds and constraints must outlive the result, the group's arrays need not.
	void split(const SolverGroup& group);

	int getNumIslands() const { return m_numIslands; }  ///< with elastic-plastic joints
	SolverGroup getIsland(int i) { return get(i); }
	SolverGroup getOthers() { return get(getNumIslands()); }

private:
	/// Where an item goes.
	struct Key
	{
		uint64_t m_bodies;  ///< the first body's place in the order, then the second's
		int m_order;        ///< order among items of the same bodies
		int m_source;
		int m_island;  ///< index of the island; items of no island of ours come last
	};

	/// Items of one kind, by island.
	template <class T>
	struct Sorted
	{
		std::vector<Key> m_keys, m_sorted;
		std::vector<T*> m_items;
		std::vector<int> m_start, m_next;  // per island

		T** begin(int island) { return m_items.data() + m_start[island]; }
		int getSize(int island) const { return m_start[island + 1] - m_start[island]; }
		void sort(T** items, int numIslands);
	};

	void join(const btCollisionObject& a, const btCollisionObject& b);
	bool isMember(const btCollisionObject& body) const;
	int rootOf(int body);
	int numberOf(const btCollisionObject& body) const;
	SolverGroup get(int island);

	int m_numIslands = 0;
	std::vector<btCollisionObject*> m_members;  // bodies of the group
	std::vector<int> m_parent;                  // of a forest of the group's bodies, -1 for those that do not move
	std::vector<int> m_islands;                 // per body
	std::vector<int> m_numConstraints;          // of the island of which a body is the root
	std::vector<char> m_isJoined;               // per body
	Sorted<btCollisionObject> m_bodies;
	Sorted<btPersistentManifold> m_manifolds;
	Sorted<btTypedConstraint> m_constraints;
	std::vector<JointWorks*> m_joints;  // per constraint as sorted
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_ISLANDS_H
