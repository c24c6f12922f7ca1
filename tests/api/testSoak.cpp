// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Joints that are made, broken, repaired and deleted, over and over, whose events nobody reads: what that takes stays the same.

#include <stdlib.h>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "support/Run.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"
#include "world/World.h"

namespace testSoak
{
using namespace ep;

/// Memory in use [bytes]; 0 where nobody tells.
size_t bytesInUse()
{
#if defined(__GLIBC__)
#if __GLIBC_PREREQ(2, 33)
	return mallinfo2().uordblks;
#endif
#endif
	return 0;
}

/// A joint that the weight of 100 kg breaks in the first step.
btElasticPlasticCapacity brittle()
{
	btElasticPlasticCapacity capacity;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		capacity.set(i, btScalar(1e8), 1, btScalar(1e-9));
	return capacity;
}

class Cycles
{
public:
	explicit Cycles(Solver solver) : m_world(solver)
	{
		btCollisionShape* const shape = m_world.box(btVector3(1, 1, 1));
		m_ceiling = m_world.body(0, shape, at(0), false);
		m_block = m_world.body(100, shape, at(0, -1), false);
	}

	void run(int cycles)
	{
		for (int i = 0; i < cycles; ++i)
		{
			btElasticPlastic6DofSpring2Constraint joint(*m_ceiling, *m_block, at(0, btScalar(-0.5)),
														at(0, btScalar(0.5)));
			joint.setCapacity(brittle());
			m_world.bullet().addConstraint(&joint, true);
			ASSERT_TRUE(m_world.action().addJoint(&joint));
			breakIt(joint);
			ASSERT_TRUE(m_world.action().repair(&joint));
			breakIt(joint);
			// One in seven is repaired and holds until it is deleted.
			if (i % 7 == 0)
			{
				ASSERT_TRUE(m_world.action().repair(&joint));
				m_world.bullet().removeConstraint(&joint);
			}
		}
		EXPECT_EQ(0, m_world.action().getNumJoints());
		EXPECT_EQ(0, m_world.bullet().getNumConstraints());
	}

private:
	void breakIt(btElasticPlastic6DofSpring2Constraint& joint)
	{
		for (int i = 0; i < 5 && !joint.isBroken(); ++i)
			m_world.step(FRAME);
		ASSERT_TRUE(joint.isBroken());
		m_block->setCenterOfMassTransform(at(0, -1));
		m_block->setLinearVelocity(btVector3(0, 0, 0));
		m_block->setAngularVelocity(btVector3(0, 0, 0));
	}

	World m_world;
	btRigidBody *m_ceiling, *m_block;
};

/// EP_SOAK_CYCLES makes it longer.
int numCycles()
{
	const char* const given = getenv("EP_SOAK_CYCLES");
	return given ? atoi(given) : 3000;
}

TEST(Soak, MemoryStaysTheSame)
{
	for (Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
	{
		Cycles cycles(solver);
		cycles.run(300);
		const size_t before = bytesInUse();
		cycles.run(numCycles());
		const size_t after = bytesInUse();
		// What the allocator keeps for itself; the least allocation, 32 bytes, lost in each cycle would be 96 kB.
		EXPECT_NEAR(double(before), double(after), 16e3);
	}
}

/// The same with joints that stay: a thousand, broken, with events that nobody has read.
TEST(Soak, UnreadEventsStayTheSame)
{
	World world(Solver::Iterative);
	btCollisionShape* const shape = world.box(btVector3(1, 1, 1));
	btRigidBody* const ceiling = world.body(0, shape, at(0), false);
	std::vector<btElasticPlasticJoint*> joints;
	for (int i = 0; i < 1000; ++i)
	{
		btRigidBody* const block = world.body(100, shape, at(btScalar(2 * i), -1), false);
		joints.push_back(&*world.joint(*ceiling, *block, at(btScalar(2 * i), btScalar(-0.5)), brittle()));
	}
	size_t before = 0;
	for (int cycle = 0; cycle < 20; ++cycle)
	{
		for (int i = 0; i < 3; ++i)
			world.step(FRAME);
		for (btElasticPlasticJoint* joint : joints)
			EXPECT_TRUE(world.action().repair(joint));
		if (cycle == 9)
			before = bytesInUse();
	}
	// Before, 20 kB came with each cycle.
	EXPECT_NEAR(double(before), double(bytesInUse()), 16e3);
	btElasticPlasticEvent event;
	int events = 0;
	double time = 0;
	while (world.action().popEvent(event))
	{
		++events;
		EXPECT_GE(event.m_time, time);
		time = event.m_time;
	}
	EXPECT_EQ(2000, events);
}
}  // namespace testSoak
