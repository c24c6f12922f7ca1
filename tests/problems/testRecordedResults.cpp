// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Small scenes whose results are recorded to the bit, so that no change of results goes unseen. Which of two results is the better
// one is for other tests to say.

#include <gtest/gtest.h>

#include <stdint.h>
#include <string.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "BulletCollision/CollisionDispatch/btSimulationIslandManager.h"
#include "support/DirectSolver.h"
#include "support/Run.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testRecordedResults
{
using namespace ep;

/// FNV-1a, 64 bit.
class Hash
{
public:
	void add(btScalar number)
	{
		unsigned char bytes[sizeof number];
		memcpy(bytes, &number, sizeof number);
		for (const unsigned char byte : bytes)
			m_value = (m_value ^ byte) * 0x100000001b3u;
	}

	/// The bodies' places and turns, the joints' forces.
	uint64_t of(const World& world)
	{
		for (const auto& body : world.bodies())
		{
			const btTransform& pose = body->getCenterOfMassTransform();
			for (int i = 0; i < 3; ++i)
			{
				add(pose.getOrigin()[i]);
				for (int j = 0; j < 3; ++j)
					add(pose.getBasis()[i][j]);
			}
		}
		for (const btElasticPlasticJoint* joint : world.joints())
			for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
				add(joint->getForce(dof));
		return m_value;
	}

private:
	uint64_t m_value = 0xcbf29ce484222325u;
};

// Numbers of the scenes are written down, not computed: mathematical functions differ between systems.

btElasticPlasticCapacity capacityOf(double stiffness, double yield, double ductility)
{
	btElasticPlasticCapacity capacity;
	for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		capacity.set(dof, btScalar(stiffness), btScalar(yield), btScalar(ductility));
	return capacity;
}

const double LASTING = 1e6;  ///< a ductility that is never spent

btRigidBody* ground(World& world) { return world.body(0, world.box(btVector3(50, 1, 50)), at(0, -0.5)); }

int yielded(const World& world)
{
	const auto joints = world.joints();
	return int(std::count_if(joints.begin(), joints.end(),
							 [](const btElasticPlasticJoint* joint) { return joint->hasYielded(); }));
}

/// Six chains side by side, the weaker of which yield and break under their weight and a kick.
void chains(World& world)
{
	btCollisionShape* shape = world.box(btVector3(btScalar(0.2), btScalar(0.5), btScalar(0.2)));
	for (int chain = 0; chain < 6; ++chain)
	{
		btRigidBody* last = world.body(0, shape, at(0, 5, 2 * chain), false);
		for (int i = 1; i <= 5; ++i)
		{
			btRigidBody* next = world.body(50, shape, at(0, 5 - 0.5 * i, 2 * chain), false);
			world.joint(*last, *next, at(0, 5.25 - 0.5 * i, 2 * chain), capacityOf(1e6, 1500 + 500 * chain, 0.05));
			last = next;
		}
		last->setLinearVelocity(btVector3(3, -1, btScalar(0.5) * chain));
	}
	run(world, 120, btScalar(1) / 120);
	EXPECT_GT(yielded(world), 3);
	EXPECT_GT(world.action().getNumBroken(), 0);
	EXPECT_LT(world.action().getNumBroken(), 30);
}

/// A portal that stands by its weight alone, pushed down and aside.
void frame(World& world)
{
	ground(world);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	const double places[][2] = {{0, 0.5}, {0, 1.5}, {0, 2.5}, {1, 2.5}, {2, 2.5},
								{3, 2.5}, {4, 2.5}, {4, 1.5}, {4, 0.5}};
	std::vector<btRigidBody*> parts;
	for (const double* place : places)
	{
		parts.push_back(world.body(1000, cube, at(place[0], place[1])));
		if (parts.size() > 1)
		{
			const btVector3 middle =
				(parts.end()[-2]->getCenterOfMassPosition() + parts.back()->getCenterOfMassPosition()) / 2;
			world.joint(*parts.end()[-2], *parts.back(), btTransform(btQuaternion(0, 0, 0, 1), middle),
						capacityOf(1e8, 30e3, LASTING));
		}
	}
	for (int i = 0; i < 120; ++i)
	{
		parts[4]->applyCentralForce(btVector3(2000, btScalar(-250) * i, 0));
		world.step(btScalar(1) / 120);
	}
	EXPECT_GT(yielded(world), 0);
}

/// Bricks in bond, hit by a ball.
void wall(World& world)
{
	ground(world);
	btCollisionShape* brick = world.box(btVector3(btScalar(0.98), btScalar(0.5), btScalar(0.5)));
	std::vector<btRigidBody*> below, row;
	for (int y = 0; y < 4; ++y, below.swap(row))
	{
		row.clear();
		for (int x = 0; x < 4; ++x)
		{
			row.push_back(world.body(200, brick, at(x + 0.5 * (y % 2), 0.25 + 0.5 * y)));
			if (x > 0)
				world.joint(*row[x - 1], *row[x], at(x - 0.5 + 0.5 * (y % 2), 0.25 + 0.5 * y),
							capacityOf(1e7, 2e3, 0.02));
			if (y > 0)
				world.joint(*below[x], *row[x], at(x + 0.25, 0.5 * y), capacityOf(1e7, 4e3, 0.02));
		}
	}
	btRigidBody* ball = world.body(300, world.keep(new btSphereShape(btScalar(0.4))), at(1.5, 1.2, 2));
	ball->setLinearVelocity(btVector3(0, 0, -8));
	run(world, 120, btScalar(1) / 120);
	EXPECT_GT(world.action().getNumBroken(), 0);
	EXPECT_LT(ball->getCenterOfMassPosition().z(), 1.7);
}

/// A beam that lies on two supports, and a box dropped on it.
void beam(World& world)
{
	btCollisionShape* part = world.box(btVector3(1, btScalar(0.4), btScalar(0.5)));
	world.body(0, part, at(0, -0.4));
	world.body(0, part, at(7, -0.4));
	btRigidBody* last = nullptr;
	for (int i = 0; i < 8; ++i)
	{
		btRigidBody* next = world.body(400, part, at(i));
		if (last)
			world.joint(*last, *next, at(i - 0.5), capacityOf(1e8, 60e3, LASTING));
		last = next;
	}
	world.body(1500, world.box(btVector3(1, 1, 1)), at(3.5, 1));
	run(world, 120, btScalar(1) / 120);
	EXPECT_GT(yielded(world), 0);
}

/// On aarch64 compilers multiply and add in one where they like: these are of GCC 12, as tests/with-aarch64 builds.
struct Hashes
{
	uint64_t m_float, m_double;
};

struct Recorded
{
	const char* m_scene;
	void (*m_run)(World&);
	Solver m_solver;
	Hashes m_x86_64, m_aarch64;
};

const Recorded RECORDS[] = {
	{"chains",
	 chains,
	 Solver::Direct,
	 {0xa37e9512c2622281, 0x36686bc4b2d47f4f},
	 {0x1b8387e8f164988c, 0xf66e5a1b7479d80a}},
	{"chains",
	 chains,
	 Solver::Iterative,
	 {0x32e56767975658fa, 0x7b4c39ff65a614e6},
	 {0xd834cb3284df304a, 0x9c32fb8dc85dfab4}},
	{"frame",
	 frame,
	 Solver::Direct,
	 {0x61868a9b5e534f81, 0x145b84e5c81f344f},
	 {0x1a7ab53f86da9012, 0x639817d2681388c0}},
	{"frame",
	 frame,
	 Solver::Iterative,
	 {0xaea9cff96d32c007, 0x333e58b665295400},
	 {0x38f20568beb46d5f, 0xcb55268740fab725}},
	{"wall", wall, Solver::Direct, {0x8839f1d210831c95, 0x2ea62c2d57916ead}, {0xaed376d18d698e10, 0xe856a27a2a4cfb1b}},
	{"wall",
	 wall,
	 Solver::Iterative,
	 {0x893f40f4b9a14e76, 0x72c9b45c23548032},
	 {0x0751f4d8e65a01de, 0x94b20a4132ed8f3f}},
	{"beam", beam, Solver::Direct, {0xa0654c47fc169ec1, 0xb3c0ae2aaaefba6e}, {0xabef650d432e77a9, 0x7111ef1eeb88c8d4}},
	{"beam",
	 beam,
	 Solver::Iterative,
	 {0x64649654ab8765f9, 0x4da6ee40fb219b0e},
	 {0x3640884c1a3961a7, 0x5b58b9a202c167f5}},
};

void PrintTo(const Recorded& record, std::ostream* out) { *out << record.m_scene; }

/// Of a solver that does not fuse multiplication and addition, as some x86-64 processors cannot, unless others are told.
uint64_t hashOf(const Recorded& record, int threads = 1, int maxVectorWidth = 1)
{
	World world(record.m_solver);
	btElasticPlasticSolverSettings settings = solverOf(world).getSettings();
	settings.m_numThreads = threads;
	settings.m_maxVectorWidth = maxVectorWidth;
	solverOf(world).setSettings(settings);
	// All islands at once, as threads want them.
	world.bullet().getSimulationIslandManager()->setSplitIslands(false);
	record.m_run(world);
	for (const auto& body : world.bodies())
		EXPECT_TRUE(isFinite(*body));
	return Hash().of(world);
}

class RecordedResults : public testing::TestWithParam<Recorded>
{
};

TEST_P(RecordedResults, AreTheSame)
{
#if defined(__FAST_MATH__) || !(defined(__x86_64__) || defined(__aarch64__))
	GTEST_SKIP()
		<< "Recorded on x86-64 and aarch64 without -ffast-math: others multiply and add in one, or in another order.";
#endif
#ifdef __aarch64__
	const Hashes& recorded = GetParam().m_aarch64;
#else
	const Hashes& recorded = GetParam().m_x86_64;
#endif
	const uint64_t expected = sizeof(btScalar) == sizeof(float) ? recorded.m_float : recorded.m_double,
				   hash = hashOf(GetParam());
	EXPECT_EQ(expected, hash)
		<< std::hex << "The results of this scene have changed: 0x" << hash << " in place of 0x" << expected
		<< ".\nIf that is intended, put the new values of both precisions into RECORDS in\n"
		<< __FILE__
		<< "\n(those of aarch64 by tests/with-aarch64)\nand say in docs/changes.md what has changed "
		   "and why.";
}

TEST_P(RecordedResults, AreTheSameAgain) { EXPECT_EQ(hashOf(GetParam()), hashOf(GetParam())); }

TEST_P(RecordedResults, AreTheSameWithTwoThreads) { EXPECT_EQ(hashOf(GetParam(), 1), hashOf(GetParam(), 2)); }

TEST_P(RecordedResults, AreTheSameInVectorsOfAnyWidth)
{
#ifdef __x86_64__
	if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
		GTEST_SKIP() << "This processor has no fused products.";
#endif
	for (const int width : {4, 8})
		EXPECT_EQ(hashOf(GetParam(), 1, 2), hashOf(GetParam(), 1, width)) << width;
}

INSTANTIATE_TEST_SUITE_P(All, RecordedResults, testing::ValuesIn(RECORDS),
						 [](const testing::TestParamInfo<Recorded>& info) {
							 return info.param.m_scene +
									std::string(info.param.m_solver == Solver::Direct ? "_direct" : "_iterative");
						 });
}  // namespace testRecordedResults
