// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Islands.h"

#include <algorithm>

#include "BulletCollision/BroadphaseCollision/btBroadphaseProxy.h"
#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "../joint/JointWorks.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
/// A body's place in the order in which bodies were added to the world. Its index in the world would change when another body
/// leaves.
uint32_t orderOf(const btCollisionObject& body)
{
	const btBroadphaseProxy* const proxy = body.getBroadphaseHandle();
	return uint32_t(proxy ? proxy->getUid() : body.getWorldArrayIndex());
}
}  // namespace

void SolverGroup::prefetchJointAfter(int constraint) const
{
	if (constraint + PREFETCH_AHEAD < m_numConstraints && m_joints[constraint + PREFETCH_AHEAD])
		m_joints[constraint + PREFETCH_AHEAD]->prefetch();
}

int Islands::rootOf(int body)
{
	while (m_parent[body] != body)
		body = m_parent[body] = m_parent[m_parent[body]];
	return body;
}

/// Whether a body moves and belongs to the group. A body that was taken out of the world while its constraint stays does not.
bool Islands::isMember(const btCollisionObject& body) const
{
	const int place = body.getCompanionId();
	return !body.isStaticOrKinematicObject() && place >= 0 && place < int(m_members.size()) &&
		   m_members[size_t(place)] == &body;
}

void Islands::join(const btCollisionObject& a, const btCollisionObject& b)
{
	if (!isMember(a) || !isMember(b))
		return;
	const int rootA = rootOf(a.getCompanionId()), rootB = rootOf(b.getCompanionId());
	// The lower root becomes the parent, so that a chain of bodies in order is a tree of depth one.
	m_parent[rootA > rootB ? rootA : rootB] = rootA > rootB ? rootB : rootA;
}

/// A body's place in the group is kept in its companion id, which Bullet does not use between two solutions.
void Islands::find(const SolverGroup& group)
{
	m_parent.resize(group.m_numBodies);
	m_members.assign(group.m_bodies, group.m_bodies + group.m_numBodies);
	for (int i = 0; i < group.m_numBodies; ++i)
	{
		const bool moves = !group.m_bodies[i]->isStaticOrKinematicObject();
		m_parent[i] = moves ? i : -1;
		if (moves)
			group.m_bodies[i]->setCompanionId(i);
	}
	for (int i = 0; i < group.m_numConstraints; ++i)
	{
		group.prefetchAfter(i);
		if (group.m_constraints[i]->isEnabled())
			join(group.m_constraints[i]->getRigidBodyA(), group.m_constraints[i]->getRigidBodyB());
	}
	for (int i = 0; i < group.m_numManifolds; ++i)
		if (group.m_manifolds[i]->getNumContacts() > 0)
			join(*group.m_manifolds[i]->getBody0(), *group.m_manifolds[i]->getBody1());

	m_islands.assign(group.m_numBodies, -1);
	m_numConstraints.assign(group.m_numBodies, 0);
	m_isJoined.assign(group.m_numBodies, 0);
	m_numIslands = 0;
	for (int i = 0; i < group.m_numConstraints; ++i)
	{
		group.prefetchAfter(i);
		const btRigidBody *const a = &group.m_constraints[i]->getRigidBodyA(),
								 *const b = &group.m_constraints[i]->getRigidBodyB(),
								 *const moving = isMember(*a) ? a : b;
		if (!isMember(*moving))
			continue;
		const int root = rootOf(moving->getCompanionId());
		++m_numConstraints[root];
		if (!group.m_joints[i])
			continue;
		for (const btRigidBody* body : {a, b})
			if (isMember(*body))
				m_isJoined[body->getCompanionId()] = 1;
		if (m_islands[root] < 0)
			m_islands[root] = m_numIslands++;
	}
	for (int i = 0; i < group.m_numBodies; ++i)
		m_islands[i] = m_parent[i] < 0 || m_islands[rootOf(i)] < 0 ? m_numIslands : m_islands[rootOf(i)];
}

int Islands::countConstraints(const btCollisionObject& a, const btCollisionObject& b)
{
	const int rootA = isMember(a) ? rootOf(a.getCompanionId()) : -1,
			  rootB = isMember(b) ? rootOf(b.getCompanionId()) : -1;
	return (rootA >= 0 ? m_numConstraints[rootA] : 0) + (rootB >= 0 && rootB != rootA ? m_numConstraints[rootB] : 0);
}

int Islands::numberOf(const btCollisionObject& body) const
{
	return isMember(body) ? m_islands[body.getCompanionId()] : m_numIslands;
}

template <class T>
void Islands::Sorted<T>::sort(T** items, int numIslands)
{
	m_start.assign(numIslands + 2, 0);
	for (const Key& key : m_keys)
		++m_start[key.m_island + 1];
	for (int i = 0; i <= numIslands; ++i)
		m_start[i + 1] += m_start[i];
	m_next.assign(m_start.begin(), m_start.end());
	m_sorted.resize(m_keys.size());
	for (const Key& key : m_keys)
		m_sorted[m_next[key.m_island]++] = key;
	for (int i = 0; i < numIslands; ++i)
		std::sort(m_sorted.begin() + m_start[i], m_sorted.begin() + m_start[i + 1],
				  [](const Key& a, const Key& b)
				  {
					  if (a.m_bodies != b.m_bodies)
						  return a.m_bodies < b.m_bodies;
					  return a.m_order != b.m_order ? a.m_order < b.m_order : a.m_source < b.m_source;
				  });
	m_items.resize(m_sorted.size());
	for (size_t i = 0; i < m_sorted.size(); ++i)
		m_items[i] = items[m_sorted[i].m_source];
}

void Islands::split(const SolverGroup& group)
{
	const auto key = [this](const btCollisionObject& a, const btCollisionObject& b, int order, int source) {
		return Key{uint64_t(orderOf(a)) << 32 | orderOf(b), order, source, numberOf(isMember(a) ? a : b)};
	};
	m_bodies.m_keys.clear();
	for (int i = 0; i < group.m_numBodies; ++i)
		m_bodies.m_keys.push_back(key(*group.m_bodies[i], *group.m_bodies[i], 0, i));
	m_bodies.sort(group.m_bodies, getNumIslands());

	m_manifolds.m_keys.clear();
	for (int i = 0; i < group.m_numManifolds; ++i)
	{
		const btPersistentManifold& manifold = *group.m_manifolds[i];
		const btCollisionObject &a = *manifold.getBody0(), &b = *manifold.getBody1();
		// A manifold without points joins nothing, but Bullet would set up both its bodies, and move one of another island
		// twice.
		if (manifold.getNumContacts() == 0 && (numberOf(a) < m_numIslands || numberOf(b) < m_numIslands))
			continue;
		m_manifolds.m_keys.push_back(key(a, b, 0, i));
	}
	m_manifolds.sort(group.m_manifolds, getNumIslands());

	m_constraints.m_keys.clear();
	for (int i = 0; i < group.m_numConstraints; ++i)
	{
		group.prefetchAfter(i);
		const btTypedConstraint& constraint = *group.m_constraints[i];
		m_constraints.m_keys.push_back(key(constraint.getRigidBodyA(), constraint.getRigidBodyB(),
										   group.m_joints[i] ? group.m_joints[i]->m_entry.m_index : -1, i));
	}
	m_constraints.sort(group.m_constraints, getNumIslands());
	for (int i = 0; i < group.m_numBodies; ++i)
		if (m_parent[i] >= 0)
			group.m_bodies[i]->setCompanionId(-1);
	m_joints.clear();
	for (const Key& constraint : m_constraints.m_sorted)
		m_joints.push_back(group.m_joints[constraint.m_source]);
}

SolverGroup Islands::get(int island)
{
	return {m_bodies.begin(island),
			m_bodies.getSize(island),
			m_manifolds.begin(island),
			m_manifolds.getSize(island),
			m_constraints.begin(island),
			m_constraints.getSize(island),
			m_joints.data() + m_constraints.m_start[island]};
}
}  // namespace btElasticPlastic
