// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// How a group of bodies, contacts and constraints is taken apart into islands.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/JointWorks.h"
#include "BulletDynamics/ConstraintSolver/ElasticPlastic/solver/Islands.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlastic6DofSpring2Constraint.h"
#include "btBulletDynamicsCommon.h"

namespace testIslands
{
using btElasticPlastic::Islands;
using btElasticPlastic::JointWorks;
using btElasticPlastic::SolverGroup;

/// Bodies in a row, 0 is static; and what is to be taken apart.
class Row
{
public:
	explicit Row(int numBodies)
		: m_world(&m_dispatcher, &m_broadphase, &m_solver, &m_configuration), m_box(btVector3(1, 1, 1))
	{
		for (int i = 0; i < numBodies; ++i)
		{
			m_bodies.emplace_back(new btRigidBody(btScalar(i == 0 ? 0 : 1), nullptr, &m_box, btVector3(1, 1, 1)));
			m_bodies.back()->setWorldTransform(
				btTransform(btQuaternion::getIdentity(), btVector3(btScalar(3 * i), 0, 0)));
			m_world.addRigidBody(m_bodies.back().get());
			m_objects.push_back(m_bodies.back().get());
		}
	}
	~Row()
	{
		for (auto& body : m_bodies)
			m_world.removeRigidBody(body.get());
	}

	void join(int a, int b)
	{
		const btTransform frame = btTransform::getIdentity();
		m_constraints.emplace_back(
			new btElasticPlastic6DofSpring2Constraint(*m_bodies[size_t(a)], *m_bodies[size_t(b)], frame, frame));
	}
	void connect(int a, int b)
	{
		m_constraints.emplace_back(new btPoint2PointConstraint(*m_bodies[size_t(a)], *m_bodies[size_t(b)],
															   btVector3(0, 0, 0), btVector3(0, 0, 0)));
	}
	void touch(int a, int b, int numPoints)
	{
		m_manifolds.emplace_back(
			new btPersistentManifold(m_bodies[size_t(a)].get(), m_bodies[size_t(b)].get(), 0, 1, 1));
		for (int i = 0; i < numPoints; ++i)
			m_manifolds.back()->addManifoldPoint(btManifoldPoint());
	}
	btTypedConstraint& constraint(int i) { return *m_constraints[size_t(i)]; }

	/// The bodies' numbers, island by island, the others last. \param reversed  hands all over in the opposite order
	std::vector<std::vector<int>> islands(bool reversed = false)
	{
		std::vector<btCollisionObject*> objects = m_objects;
		std::vector<btTypedConstraint*> constraints;
		for (auto& constraint : m_constraints)
			constraints.push_back(constraint.get());
		std::vector<btPersistentManifold*> manifolds;
		for (auto& manifold : m_manifolds)
			manifolds.push_back(manifold.get());
		if (reversed)
		{
			std::reverse(objects.begin(), objects.end());
			std::reverse(constraints.begin(), constraints.end());
			std::reverse(manifolds.begin(), manifolds.end());
		}
		std::vector<JointWorks*> joints;
		for (btTypedConstraint* constraint : constraints)
			joints.push_back(JointWorks::from(constraint));
		SolverGroup group;
		group.m_bodies = objects.data();
		group.m_numBodies = int(objects.size());
		group.m_manifolds = manifolds.data();
		group.m_numManifolds = int(manifolds.size());
		group.m_constraints = constraints.data();
		group.m_numConstraints = int(constraints.size());
		group.m_joints = joints.data();
		m_islands.find(group);
		m_islands.split(group);
		std::vector<std::vector<int>> numbers;
		for (int i = 0; i <= m_islands.getNumIslands(); ++i)
			numbers.push_back(
				numbersOf(i < m_islands.getNumIslands() ? m_islands.getIsland(i) : m_islands.getOthers()));
		return numbers;
	}

	Islands m_islands;

private:
	std::vector<int> numbersOf(const SolverGroup& group) const
	{
		std::vector<int> numbers;
		for (int i = 0; i < group.m_numBodies; ++i)
			numbers.push_back(
				int(std::find(m_objects.begin(), m_objects.end(), group.m_bodies[i]) - m_objects.begin()));
		return numbers;
	}

	btDefaultCollisionConfiguration m_configuration;
	btCollisionDispatcher m_dispatcher{&m_configuration};
	btDbvtBroadphase m_broadphase;
	btSequentialImpulseConstraintSolver m_solver;
	btDiscreteDynamicsWorld m_world;
	btBoxShape m_box;
	std::vector<std::unique_ptr<btRigidBody>> m_bodies;
	std::vector<btCollisionObject*> m_objects;
	std::vector<std::unique_ptr<btTypedConstraint>> m_constraints;
	std::vector<std::unique_ptr<btPersistentManifold>> m_manifolds;
};

typedef std::vector<std::vector<int>> Numbers;

TEST(Islands, AreWhatJointsConstraintsAndContactsJoin)
{
	Row row(9);
	row.join(1, 2);
	row.connect(2, 3);
	row.join(4, 5);
	row.touch(5, 6, 1);
	row.connect(7, 8);
	EXPECT_EQ((Numbers{{1, 2, 3}, {4, 5, 6}, {0, 7, 8}}), row.islands());
	EXPECT_EQ(2, row.m_islands.getIsland(0).m_numConstraints);
	EXPECT_EQ(1, row.m_islands.getIsland(1).m_numManifolds);
	EXPECT_EQ(1, row.m_islands.getOthers().m_numConstraints);
}

TEST(Islands, StaticBodiesDoNotJoin)
{
	Row row(4);
	row.join(0, 1);
	row.join(0, 2);
	row.touch(0, 3, 1);
	EXPECT_EQ((Numbers{{1}, {2}, {0, 3}}), row.islands());
}

TEST(Islands, ManifoldsWithoutPointsAndDisabledConstraintsDoNotJoin)
{
	Row row(4);
	row.join(0, 1);
	row.join(0, 2);
	row.touch(1, 2, 0);
	row.connect(1, 2);
	row.constraint(2).setEnabled(false);
	EXPECT_EQ((Numbers{{1}, {2}, {0, 3}}), row.islands());
}

TEST(Islands, HaveTheirOwnOrder)
{
	Row row(6);
	row.join(3, 1);
	row.join(5, 3);
	row.touch(1, 5, 1);
	const Numbers forwards = row.islands();
	EXPECT_EQ((std::vector<int>{1, 3, 5}), forwards[0]);
	const SolverGroup island = row.m_islands.getIsland(0);
	const btTypedConstraint* const first = island.m_constraints[0];
	EXPECT_EQ(forwards[0], row.islands(true)[0]);
	EXPECT_EQ(first, row.m_islands.getIsland(0).m_constraints[0]);
}
}  // namespace testIslands
