// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The direct form in worlds of several islands: what is none of its business, what it reuses, what it leaves undisturbed.

#include <string.h>

#include <map>

#include <gtest/gtest.h>

#include <algorithm>

#include "BulletCollision/CollisionDispatch/btSimulationIslandManager.h"

#include "scenes/BeamOnSupports.h"
#include "scenes/Cantilever.h"
#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"
#include "support/Run.h"

namespace testManyIslands
{
using namespace ep;

/// All bits of a body's motion.
struct Bits
{
	btScalar m_values[18];

	explicit Bits(const btRigidBody& body)
	{
		const btTransform& pose = body.getCenterOfMassTransform();
		for (int i = 0; i < 3; ++i)
		{
			m_values[i] = pose.getOrigin()[i];
			m_values[3 + i] = body.getLinearVelocity()[i];
			m_values[6 + i] = body.getAngularVelocity()[i];
			for (int j = 0; j < 3; ++j)
				m_values[9 + 3 * i + j] = pose.getBasis()[i][j];
		}
	}

	bool operator==(const Bits& other) const { return memcmp(m_values, other.m_values, sizeof m_values) == 0; }
};

std::vector<Bits> bitsOf(const std::vector<btRigidBody*>& bodies)
{
	std::vector<Bits> bits;
	for (const btRigidBody* body : bodies)
		bits.push_back(Bits(*body));
	return bits;
}

/// A jointed tower that falls on the ground, and tilted boxes beside it that tumble and pile up.
struct Yard
{
	World m_world;
	std::vector<btRigidBody*> m_structure, m_loose;

	/// \param batch  constraints and contacts up to which Bullet hands over islands together, 0: each alone
	Yard(Solver solver, int batch, bool structureFirst = true, bool withLoose = true) : m_world(solver)
	{
		m_world.bullet().getSolverInfo().m_minimumSolverBatchSize = batch;
		m_world.body(0, m_world.box(btVector3(50, 1, 50)), at(0, -0.5));
		if (structureFirst)
			addStructure();
		if (withLoose)
			addLoose();
		if (!structureFirst)
			addStructure();
	}

	void addStructure()
	{
		btCollisionShape* cube = m_world.box(btVector3(1, 1, 1));
		for (int i = 0; i < 5; ++i)
		{
			m_structure.push_back(m_world.body(1000, cube, at(0, 0.6 + i)));
			if (i > 0)
				m_world.joint(*m_structure[i - 1], *m_structure[i], at(0, 0.1 + i), evenCapacity(1e8));
		}
		m_structure[4]->setLinearVelocity(btVector3(btScalar(0.3), 0, 0));
	}

	void addLoose()
	{
		btCollisionShape* cube = m_world.box(btVector3(btScalar(0.6), btScalar(0.6), btScalar(0.6)));
		for (int i = 0; i < 12; ++i)
			m_loose.push_back(m_world.body(
				10, cube,
				btTransform(
					btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(0.2 * i)),
					btVector3(btScalar(6 + 0.1 * (i % 4)), btScalar(0.6 + 0.8 * (i / 2)), btScalar(2 * (i % 2))))));
	}
};

/// The contacts between loose bodies in the order in which Bullet hands them over: pairs of places in m_loose.
std::vector<std::pair<long, long>> looseContacts(Yard& yard)
{
	const auto placeOf = [&](const btCollisionObject* object)
	{ return long(std::find(yard.m_loose.begin(), yard.m_loose.end(), object) - yard.m_loose.begin()); };
	std::vector<std::pair<long, long>> contacts;
	btDispatcher& dispatcher = *yard.m_world.bullet().getDispatcher();
	for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
	{
		const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
		const long a = placeOf(manifold.getBody0()), b = placeOf(manifold.getBody1()), none = long(yard.m_loose.size());
		if (a < none || b < none)
			contacts.emplace_back(a, b);
	}
	return contacts;
}

TEST(ManyIslands, LooseBodiesMoveAsWithTheStockSolverBitForBit)
{
	for (int batch : {0, 128})
	{
		Yard direct(Solver::Direct, batch), stock(Solver::Stock, batch);
		int compared = 0;
		for (int i = 0; i < 240; ++i)
		{
			direct.m_world.step(FRAME);
			stock.m_world.step(FRAME);
			// The order of contacts is Bullet's broadphase's to say, and depends on where the tower is, too. With another order
			// another result is right.
			if (looseContacts(direct) != looseContacts(stock))
				break;
			++compared;
			ASSERT_TRUE(bitsOf(direct.m_loose) == bitsOf(stock.m_loose)) << "batch " << batch << " step " << i;
		}
		// By then the boxes lie on each other.
		EXPECT_GT(compared, 35);
		EXPECT_EQ(0, statisticsOf(direct.m_world).m_fallbacks);
	}
}

TEST(ManyIslands, SameSceneGivesTheSameBits)
{
	Yard first(Solver::Direct, 128), second(Solver::Direct, 128);
	BeamOnSupports beam{BeamOnSupports::Settings()}, again{BeamOnSupports::Settings()};
	for (int i = 0; i < 120; ++i)
	{
		first.m_world.step(FRAME);
		second.m_world.step(FRAME);
		beam.m_world.step(FRAME);
		again.m_world.step(FRAME);
	}
	EXPECT_TRUE(bitsOf(first.m_structure) == bitsOf(second.m_structure));
	EXPECT_TRUE(bitsOf(first.m_loose) == bitsOf(second.m_loose));
	EXPECT_TRUE(bitsOf(beam.m_member.m_parts) == bitsOf(again.m_member.m_parts));
}

TEST(ManyIslands, StructureDoesNotFeelOtherIslands)
{
	// Loose boxes beside it, made after or before it, in its batch or not: its bits stay.
	Yard alone(Solver::Direct, 128, true, false);
	Yard others[] = {{Solver::Direct, 128, true},
					 {Solver::Direct, 0, true},
					 {Solver::Direct, 128, false},
					 {Solver::Direct, 0, false}};
	for (int i = 0; i < 120; ++i)
	{
		alone.m_world.step(FRAME);
		for (Yard& other : others)
			other.m_world.step(FRAME);
	}
	for (const Yard& other : others)
		EXPECT_TRUE(bitsOf(alone.m_structure) == bitsOf(other.m_structure)) << &other - others;
}

/// Structures side by side that Bullet hands over together or apart, and that yield differently.
class Quarter
{
public:
	enum Batches
	{
		ALONE,
		TOGETHER,
		UNSPLIT  ///< the world does not look for islands
	};

	/// \param order  of insertion: a is a chain, b and c are nets of the same graph, stirred differently
	Quarter(const char* order, Batches batches) : m_world(Solver::Direct)
	{
		m_world.bullet().getSolverInfo().m_minimumSolverBatchSize = batches == ALONE ? 0 : 1000000;
		m_world.bullet().getSimulationIslandManager()->setSplitIslands(batches != UNSPLIT);
		for (; *order; ++order)
			add(*order);
	}

	void add(char structure) { structure == 'a' ? addNet(1, 10, 0) : addNet(11, 11, structure - 'a'); }

	void run()
	{
		for (int i = 0; i < 40; ++i)
			m_world.step(FRAME);
	}

	bool operator==(const Quarter& other) const
	{
		for (const auto& structure : other.m_structures)
		{
			const auto mine = m_structures.find(structure.first);
			if (mine != m_structures.end() && !(bitsOf(mine->second) == bitsOf(structure.second)))
				return false;
		}
		return true;
	}

	World m_world;
	std::map<int, std::vector<btRigidBody*>> m_structures;

private:
	void addNet(int width, int length, int number)
	{
		btCollisionShape* cube = m_world.box(btVector3(1, 1, 1));
		std::vector<btRigidBody*>& bodies = m_structures[number];
		btRigidBody* wall = m_world.body(0, cube, at(-1, 0, 20 * number), false);
		btElasticPlasticCapacity capacity = evenCapacity(1e8);
		capacity.m_yield[BT_EP_BENDING_Z] = btScalar(5000 * width);
		for (int i = 0; i < length; ++i)
			for (int j = 0; j < width; ++j)
			{
				const btTransform place = at(i, 0, 20 * number + j);
				bodies.push_back(m_world.body(100, cube, place, false));
				bodies.back()->setLinearVelocity(btVector3(0, btScalar(0.1 * number * i), btScalar(0.1 * number * j)));
				m_world.joint(i > 0 ? *bodies[(i - 1) * width + j] : *wall, *bodies.back(),
							  at(i - 0.5, 0, 20 * number + j), capacity);
				if (j > 0)
					m_world.joint(*bodies[i * width + j - 1], *bodies.back(), at(i, 0, 20 * number + j - 0.5),
								  capacity);
			}
	}
};

TEST(ManyIslands, StructuresGiveTheSameBitsWhateverIsBesideThem)
{
	Quarter reference("abc", Quarter::ALONE);
	reference.run();
	EXPECT_TRUE(reference.m_world.joints()[0]->hasYielded());
	// The nets' factors are kept from step to step: each must get its own.
	EXPECT_GT(statisticsOf(reference.m_world).m_iterations, 0);
	EXPECT_EQ(0, statisticsOf(reference.m_world).m_fallbacks);
	for (const char* order : {"a", "b", "c", "abc", "cba", "bac", "cab"})
		for (Quarter::Batches batches : {Quarter::ALONE, Quarter::TOGETHER, Quarter::UNSPLIT})
		{
			Quarter other(order, batches);
			other.run();
			EXPECT_TRUE(other == reference) << order << " " << batches;
		}
}

/// A net that sleeps for a while, and what happens far away meanwhile.
std::vector<Bits> netThatSleeps(bool othersGrow)
{
	Quarter quarter("b", Quarter::ALONE);
	World& world = quarter.m_world;
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* first = world.body(100, cube, at(0, 0, 500), false);
	btRigidBody* second = world.body(100, cube, at(1, 0, 500), false);
	const std::vector<btRigidBody*>& net = quarter.m_structures[1];
	run(world, 20);
	for (btRigidBody* body : net)
		body->forceActivationState(ISLAND_SLEEPING);
	for (int i = 0; i < 20; ++i)
	{
		if (othersGrow && i == 10)
			world.joint(*first, *second, at(0.5, 0, 500), evenCapacity(1e7));
		world.step(FRAME);
	}
	for (btRigidBody* body : net)
		body->forceActivationState(DISABLE_DEACTIVATION);
	run(world, 20);
	return bitsOf(net);
}

TEST(ManyIslands, SleeperDoesNotFeelWhatHappensMeanwhile)
{
	const std::vector<Bits> reference = netThatSleeps(false);
	EXPECT_TRUE(netThatSleeps(true) == reference);
}

TEST(ManyIslands, BitsStayWhenAnotherBodyLeaves)
{
	// Bullet moves the last of its bodies to the place of the one that leaves: here one of the net's.
	std::vector<Bits> bits[2];
	for (int leaves = 0; leaves < 2; ++leaves)
	{
		Quarter quarter("", Quarter::ALONE);
		World& world = quarter.m_world;
		btRigidBody* stranger = world.body(100, world.box(btVector3(1, 1, 1)), at(0, 0, 500), false);
		quarter.add('b');
		for (int i = 0; i < 40; ++i)
		{
			if (leaves && i == 20)
				world.bullet().removeRigidBody(stranger);
			world.step(FRAME);
		}
		bits[leaves] = bitsOf(quarter.m_structures[1]);
	}
	EXPECT_TRUE(bits[0] == bits[1]);
}

/// Posts on a ground: those that are hit yield and break, and all touch the ground.
std::vector<Bits> fencesHitWith(int threads, btElasticPlasticStatistics& statistics)
{
	World world(Solver::Direct);
	solverOf(world).setNumThreads(threads);
	world.bullet().getSimulationIslandManager()->setSplitIslands(false);
	btCollisionShape* post = world.box(btVector3(btScalar(0.2), 1, btScalar(0.2)));
	world.body(0, world.box(btVector3(200, 1, 200)), at(0, -0.5));
	btRigidBody* crane = world.body(0, post, at(-5, 3));
	makeKinematic(*crane);
	std::vector<btRigidBody*> posts;
	for (int fence = 0; fence < 30; ++fence)
	{
		// One of them hangs on the crane.
		btRigidBody* last = fence == 7 ? crane : nullptr;
		for (int i = 0; i < 4; ++i)
		{
			btRigidBody* next = world.body(50, post, at(i, 0.51, 3 * fence));
			btElasticPlasticCapacity capacity = evenCapacity(1e7);
			for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			{
				capacity.m_yield[dof] = 2000;
				capacity.m_ductility[dof] = btScalar(0.2);
			}
			if (last)
				world.joint(*last, *next, at(i - 0.5, 1, 3 * fence), capacity);
			posts.push_back(last = next);
		}
		last->setLinearVelocity(btVector3(0, 1, btScalar(0.5 * fence)));
	}
	run(world, 60);
	statistics = statisticsOf(world);
	return bitsOf(posts);
}

TEST(ManyIslands, ThreadsChangeNoBit)
{
	btElasticPlasticStatistics one, many;
	const std::vector<Bits> reference = fencesHitWith(1, one);
	EXPECT_GT(one.m_newtonSteps, 0);
	EXPECT_GT(one.m_contactLoops, 0);
	for (int threads : {2, 5})
	{
		EXPECT_TRUE(fencesHitWith(threads, many) == reference) << threads;
		EXPECT_EQ(one.m_islands, many.m_islands);
		EXPECT_EQ(one.m_newtonSteps, many.m_newtonSteps);
		EXPECT_EQ(one.m_rows, many.m_rows);
	}
}

TEST(ManyIslands, SleepingStructureCostsNothingInAnUnsplitWorld)
{
	Quarter quarter("a", Quarter::UNSPLIT);
	for (btRigidBody* body : quarter.m_structures[0])
		body->forceActivationState(ISLAND_SLEEPING);
	quarter.run();
	EXPECT_EQ(0, statisticsOf(quarter.m_world).m_islands);
	EXPECT_EQ(0, quarter.m_structures[0].back()->getCenterOfMassPosition().y());
}

TEST(ManyIslands, ElasticGraphIsAnalysedOnce)
{
	Cantilever cantilever{Cantilever::Settings()};
	run(cantilever.m_world, 100);
	const auto& statistics = statisticsOf(cantilever.m_world);
	EXPECT_EQ(100, statistics.m_islands);
	EXPECT_EQ(100 * 6 * 10, statistics.m_rows);
	EXPECT_EQ(1, statistics.m_analyses);
	EXPECT_LE(statistics.m_factorisations, 100);
	EXPECT_GE(statistics.m_solutions, 100);
	EXPECT_EQ(0, statistics.m_newtonSteps);
	EXPECT_EQ(0, statistics.m_contactLoops);
	EXPECT_EQ(0, statistics.m_fallbacks);
	solverOf(cantilever.m_world).resetStatistics();
	EXPECT_EQ(0, statisticsOf(cantilever.m_world).m_islands);
}

TEST(ManyIslands, TellWhereTheTimeGoesIfAsked)
{
	for (const bool isAsked : {false, true})
	{
		Cantilever cantilever{Cantilever::Settings()};
		btElasticPlasticSolverSettings settings = solverOf(cantilever.m_world).getSettings();
		settings.m_measuresTime = isAsked;
		ASSERT_TRUE(solverOf(cantilever.m_world).setSettings(settings));
		run(cantilever.m_world, 10);
		const btElasticPlasticStatistics& s = statisticsOf(cantilever.m_world);
		for (double time : {s.m_setUpTime, s.m_analysisTime, s.m_assemblyTime, s.m_factorisationTime, s.m_solutionTime,
							s.m_searchTime})
			EXPECT_EQ(time > 0, isAsked);
	}
}

TEST(ManyIslands, YieldCostsNewtonStepsOnlyWhereItBeginsOrEnds)
{
	// A load that bends the root plastically: the bounds are found once, and found again where they were. In even steps: inner ones resolve waves,
	// with which flow ends and begins.
	Cantilever::Settings settings;
	settings.method = withoutInnerSteps();
	Cantilever cantilever(settings);
	btElasticPlasticCapacity capacity = cantilever.m_root->getCapacity();
	capacity.m_yield[BT_EP_BENDING_Z] = btScalar(1000);  // of the 1540 N m that hang there
	cantilever.m_root->setCapacity(capacity);
	run(cantilever.m_world, 30);
	const auto& statistics = statisticsOf(cantilever.m_world);
	EXPECT_TRUE(cantilever.m_root->hasYielded());
	EXPECT_GE(statistics.m_newtonSteps, 1);
	EXPECT_LE(statistics.m_newtonSteps, 5);
	EXPECT_EQ(0, statistics.m_fallbacks);
}

TEST(ManyIslands, SleepingStructureCostsNothingAndWakesAsItWas)
{
	Cantilever cantilever{Cantilever::Settings()};
	for (btRigidBody* part : cantilever.m_member.m_parts)
		part->forceActivationState(ACTIVE_TAG);
	run(cantilever.m_world, 300);
	EXPECT_EQ(ISLAND_SLEEPING, cantilever.m_member.last().getActivationState());
	const double sag = cantilever.sag();
	EXPECT_NEAR(1, sag / cantilever.staticSag(), 1e-3);
	solverOf(cantilever.m_world).resetStatistics();
	const btElasticPlasticState asleep = cantilever.m_root->getState();
	run(cantilever.m_world, 60);
	EXPECT_EQ(0, statisticsOf(cantilever.m_world).m_islands);
	EXPECT_EQ(sag, double(cantilever.sag()));
	EXPECT_EQ(asleep.m_force[BT_EP_BENDING_Z], cantilever.m_root->getState().m_force[BT_EP_BENDING_Z]);
	EXPECT_EQ(asleep.m_work, cantilever.m_root->getState().m_work);

	cantilever.m_member.last().activate(true);
	run(cantilever.m_world, 60);
	EXPECT_GT(statisticsOf(cantilever.m_world).m_islands, 0);
	EXPECT_EQ(0, statisticsOf(cantilever.m_world).m_analyses);
	EXPECT_NEAR(sag, cantilever.sag(), 1e-3 * sag);
	EXPECT_FALSE(cantilever.m_root->hasYielded());
}
}  // namespace testManyIslands
