// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Structures of twenty thousand joints: time and memory.

#include <chrono>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "support/Run.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testHardSizes
{
using namespace ep;

/// Peak memory of the process [MB], 0 where the system does not tell.
double peakMemory()
{
	std::ifstream status("/proc/self/status");
	for (std::string word; status >> word;)
		if (word == "VmHWM:")
		{
			double kilobytes = 0;
			status >> kilobytes;
			return kilobytes / 1024;
		}
	return 0;
}

TEST(HardSizes, GridOfTwentyThousandJoints)
{
	// 100 x 100 plates held at one edge: 19800 joints between them and 100 to the wall, in one island.
	World world(Solver::Direct);
	btCollisionShape* plate = world.box(btVector3(1, btScalar(0.2), 1));
	btRigidBody* wall = world.body(0, plate, at(-1, 0), false);
	const int n = 100;
	std::vector<btRigidBody*> plates;
	for (int i = 0; i < n * n; ++i)
	{
		const int x = i % n, z = i / n;
		plates.push_back(world.body(100, plate, at(x, 0, z), false));
		world.joint(x > 0 ? *plates[i - 1] : *wall, *plates[i], at(x - 0.5, 0, z), evenCapacity(1e9));
		if (z > 0)
			world.joint(*plates[i - n], *plates[i], at(x, 0, z - 0.5), evenCapacity(1e9));
	}
	EXPECT_EQ(19900u, world.joints().size());
	const double before = peakMemory();
	const auto start = std::chrono::steady_clock::now();
	run(world, 3);
	RecordProperty("milliseconds",
				   int(1e3 / 3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()));
	RecordProperty("megabytes", int(peakMemory() - before));
	EXPECT_EQ(0, statisticsOf(world).m_fallbacks);
	EXPECT_EQ(1, statisticsOf(world).m_analyses);
	for (btRigidBody* body : plates)
		ASSERT_TRUE(isFinite(*body));
	// A factor of n log n blocks of 36 doubles is some 50 MB; rows, their copies and Bullet's own take as much again.
	EXPECT_LT(peakMemory() - before, 400);
}

TEST(HardSizes, ChainOfTwentyThousandJoints)
{
	// In windings, since Bullet's broadphase takes a minute to sort a line.
	World world(Solver::Direct);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* last = world.body(0, cube, at(-1, 0), false);
	for (int i = 0; i < 20000; ++i)
	{
		const int z = i / 100, x = z % 2 ? 99 - i % 100 : i % 100;
		btRigidBody* next = world.body(100, cube, at(x, 0, z), false);
		const btVector3 middle = (last->getCenterOfMassPosition() + next->getCenterOfMassPosition()) / 2;
		world.joint(*last, *next, btTransform(btQuaternion(0, 0, 0, 1), middle), evenCapacity(1e9));
		last = next;
	}
	const double before = peakMemory();
	run(world, 3);
	RecordProperty("megabytes", int(peakMemory() - before));
	EXPECT_EQ(0, statisticsOf(world).m_fallbacks);
	EXPECT_EQ(1, statisticsOf(world).m_analyses);
	// Its end feels nothing of the support yet: free fall of three steps.
	EXPECT_NEAR(-10. / 3600 * 6, last->getCenterOfMassPosition().y(), byPrecision(1e-6, 1e-4));
	EXPECT_LT(peakMemory() - before, 400);
}
}  // namespace testHardSizes
