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

#include "btElasticPlasticIslands.h"

#include <algorithm>

#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "btElasticPlasticJoint.h"

namespace
{
/// Bullet's number of the island of two objects, of which one may be static and is in none.
int islandOf(const btCollisionObject& a, const btCollisionObject& b)
{
	return a.isStaticOrKinematicObject() ? b.getIslandTag() : a.getIslandTag();
}
}  // namespace

/// The numbers of the islands with elastic-plastic joints, in ascending order.
void btElasticPlasticIslands::findIslands(const btElasticPlasticGroup& group)
{
	m_numbers.clear();
	for (int i = 0; i < group.m_numConstraints; ++i)
	{
		if (!group.m_joints[i])
			continue;
		const btTypedConstraint& constraint = *group.m_constraints[i];
		const int island = islandOf(constraint.getRigidBodyA(), constraint.getRigidBodyB());
		if (m_numbers.empty() || m_numbers.back() != island)
			m_numbers.push_back(island);
	}
	std::sort(m_numbers.begin(), m_numbers.end());
	m_numbers.erase(std::unique(m_numbers.begin(), m_numbers.end()), m_numbers.end());
}

int btElasticPlasticIslands::numberOf(int island) const
{
	const auto place = std::lower_bound(m_numbers.begin(), m_numbers.end(), island);
	return place != m_numbers.end() && *place == island ? int(place - m_numbers.begin()) : getNumIslands();
}

template <class T>
void btElasticPlasticIslands::Sorted<T>::sort(T** items, int numIslands)
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

void btElasticPlasticIslands::split(const btElasticPlasticGroup& group)
{
	findIslands(group);
	const auto key = [this](const btCollisionObject& a, const btCollisionObject& b, int order, int source)
	{
		const uint64_t bodies = uint64_t(uint32_t(a.getWorldArrayIndex())) << 32 | uint32_t(b.getWorldArrayIndex());
		return Key{bodies, order, source, numberOf(islandOf(a, b))};
	};
	m_bodies.m_keys.clear();
	for (int i = 0; i < group.m_numBodies; ++i)
		m_bodies.m_keys.push_back(key(*group.m_bodies[i], *group.m_bodies[i], 0, i));
	m_bodies.sort(group.m_bodies, getNumIslands());

	m_manifolds.m_keys.clear();
	for (int i = 0; i < group.m_numManifolds; ++i)
		m_manifolds.m_keys.push_back(key(*group.m_manifolds[i]->getBody0(), *group.m_manifolds[i]->getBody1(), 0, i));
	m_manifolds.sort(group.m_manifolds, getNumIslands());

	m_constraints.m_keys.clear();
	for (int i = 0; i < group.m_numConstraints; ++i)
	{
		const btTypedConstraint& constraint = *group.m_constraints[i];
		m_constraints.m_keys.push_back(key(constraint.getRigidBodyA(), constraint.getRigidBodyB(),
										   group.m_joints[i] ? group.m_joints[i]->getEntry() : -1, i));
	}
	m_constraints.sort(group.m_constraints, getNumIslands());
	m_joints.clear();
	for (const Key& constraint : m_constraints.m_sorted)
		m_joints.push_back(group.m_joints[constraint.m_source]);
}

btElasticPlasticGroup btElasticPlasticIslands::get(int island)
{
	return {m_bodies.begin(island),
			m_bodies.getSize(island),
			m_manifolds.begin(island),
			m_manifolds.getSize(island),
			m_constraints.begin(island),
			m_constraints.getSize(island),
			m_joints.data() + m_constraints.m_start[island]};
}
