// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The direct form where it is hard: mechanisms, redundancy, extremes, bodies that may not move, failure, size.

#include <math.h>

#include <chrono>
#include <fstream>

#include <gtest/gtest.h>

#include "scenes/Cantilever.h"
#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace
{
using namespace ep;

const btScalar FRAME = btScalar(1) / 60;

bool isFinite(const btRigidBody& body)
{
	return btElasticPlasticIsFinite(body.getCenterOfMassPosition().length()) &&
		   btElasticPlasticIsFinite(body.getLinearVelocity().length()) &&
		   btElasticPlasticIsFinite(body.getAngularVelocity().length());
}

void run(World& world, int steps)
{
	for (int i = 0; i < steps; ++i)
		world.step(FRAME);
}

TEST(DirectHardCases, ChainOfHingesIsAMechanismThatSwings)
{
	// A pendulum of ten links: turning about two axes free, about the third a weak spring; places elastic or locked by Bullet.
	for (bool elasticPlaces : {false, true})
	{
		World world(Solver::Direct);
		btCollisionShape* shape = world.box(btVector3(1, btScalar(0.1), btScalar(0.1)));
		btRigidBody* last = world.body(0, shape, at(-0.5, 0), false);
		btElasticPlasticCapacity capacity;
		if (elasticPlaces)
			capacity = evenCapacity(1e7);
		capacity.clear(BT_EP_TORSION);
		capacity.clear(BT_EP_BENDING_Y);
		capacity.set(BT_EP_BENDING_Z, 1, btElasticPlasticCapacity::unlimited());
		std::vector<btRigidBody*> links;
		for (int i = 0; i < 10; ++i)
		{
			links.push_back(world.body(10, shape, at(i + 0.5, 0), false));
			world.joint(*last, *links.back(), at(i, 0), capacity);
			last = links.back();
		}
		double lowest = 0, farthest = 0;
		for (int i = 0; i < 300; ++i)
		{
			world.step(btScalar(1) / 240);
			for (btRigidBody* link : links)
				ASSERT_TRUE(isFinite(*link));
			lowest = std::min(lowest, double(last->getCenterOfMassPosition().y()));
			farthest = std::max(farthest, double(last->getCenterOfMassPosition().length()));
		}
		// In 1.25 s a rod of its length would be about upright.
		EXPECT_LT(lowest, -7);
		// It hangs together. Links turn by up to 0.1 rad a step, which opens a lock by 5 mm; Bullet closes it by a fifth.
		EXPECT_LT(farthest, 9.5 + 10 * 0.01) << elasticPlaces;
		EXPECT_EQ(0, statisticsOf(world).m_fallbacks);
	}
}

TEST(DirectHardCases, FreeFallingMechanismFalls)
{
	// Nothing holds it: the matrix is the mass plus the joints' null space.
	World world(Solver::Direct);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btElasticPlasticCapacity capacity;
	capacity.set(BT_EP_SHEAR_Y, btScalar(1e9), btElasticPlasticCapacity::unlimited());
	btRigidBody* last = nullptr;
	for (int i = 0; i < 10; ++i)
	{
		btRigidBody* next = world.body(10, cube, at(i, 0), false);
		if (last)
			world.joint(*last, *next, at(i - 0.5, 0), capacity);
		last = next;
	}
	run(world, 60);
	// Semi-implicit Euler.
	EXPECT_NEAR(-10. / 3600 * 60 * 61 / 2, last->getCenterOfMassPosition().y(), byPrecision(1e-9, 1e-4));
	EXPECT_EQ(0, statisticsOf(world).m_fallbacks);
}

TEST(DirectHardCases, DuplicateJointsShareTheLoad)
{
	World world(Solver::Direct);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* support = world.body(0, cube, at(0, 1), false);
	btRigidBody* block = world.body(1000, cube, at(0, 0), false);
	btElasticPlasticJoint* joints[3];
	for (btElasticPlasticJoint*& joint : joints)
		joint = world.joint(*support, *block, at(0, 0.5), evenCapacity(1e9));
	run(world, 60);
	for (const btElasticPlasticJoint* joint : joints)
		EXPECT_NEAR(10000. / 3, fabs(double(joint->getForce(BT_EP_SHEAR_Y))), byPrecision(0.01, 10));
	EXPECT_EQ(0, statisticsOf(world).m_fallbacks);
}

// Newton's line search crawls where stiff rows begin to yield: no step of 60 converges, for any of these yield values.
TEST(DirectHardCases, WeakChainFalls)
{
	for (double yield : {1e-6, 1e-3, 1., 100.})
	{
		World world(Solver::Direct);
		btCollisionShape* cube = world.box(btVector3(1, 1, 1));
		btRigidBody* last = world.body(0, cube, at(0, 0), false);
		btElasticPlasticCapacity capacity;
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			capacity.set(i, btScalar(1e9), btScalar(yield));
		for (int i = 1; i < 10; ++i)
		{
			btRigidBody* next = world.body(100, cube, at(i, 0), false);
			world.joint(*last, *next, at(i - 0.5, 0), capacity);
			last = next;
		}
		run(world, 60);
		// Nearly free fall: a joint holds a tenth of a body's weight at most.
		EXPECT_NEAR(-10. / 3600 * 60 * 61 / 2, last->getCenterOfMassPosition().y(), 1e-3 + yield / 1000) << yield;
		EXPECT_EQ(0, statisticsOf(world).m_fallbacks) << yield;
	}
}

/// A hanging chain of ten bodies, light and heavy by turns, settles at its static length.
void hang(double light, double heavy, bool heavyFirst)
{
	World world(Solver::Direct);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* last = world.body(0, cube, at(0, 0), false);
	double weight = 0, stretch = 0;
	const int n = 10;
	const auto massOf = [light, heavy, heavyFirst](int i) { return i % 2 == heavyFirst ? heavy : light; };
	for (int i = 1; i <= n; ++i)
	{
		btRigidBody* next = world.body(btScalar(massOf(i)), cube, at(0, -i), false);
		world.joint(*last, *next, at(0, -i + 0.5), evenCapacity(1e12));
		last = next;
	}
	for (int i = n; i >= 1; --i)
	{
		weight += 10 * massOf(i);
		stretch += weight / 1e12;
	}
	run(world, 120);
	EXPECT_EQ(0, statisticsOf(world).m_fallbacks);
	// Float rounds places 10 m down at 1e-6 m, and the stretch of 3 mm is a sum over ten joints.
	EXPECT_NEAR(stretch, -n - double(last->getCenterOfMassPosition().y()), byPrecision(1e-6, 1e-2) * stretch);
}

TEST(DirectHardCases, MassesFromKilogramsToThousandsOfTons)
{
	hang(1, 1e7, false);
	hang(1, 1e7, true);
}

// addRow's floor of 1e-10 on a row's compliance, relative to the light body's 1/m, makes the joint 28 times too soft here.
TEST(DirectHardCases, MassesFromGramsToThousandsOfTons)
{
	hang(1e-3, 1e7, false);
	hang(1e-3, 1e7, true);
}

TEST(DirectHardCases, HugeBodiesHangFromASupport)
{
	// In float Bullet leaves m_jacDiagABInv 0 where J M^-1 J^T <= 1.19e-7: the joint must not divide by it.
	// 10 kt, and a slab of 100 t whose moments of inertia are 1.3e7 kg m^2.
	for (bool slab : {false, true})
	{
		World world(Solver::Direct);
		const double size = slab ? 40 : 1, mass = slab ? 1e5 : 1e7;
		btRigidBody* support = world.body(0, world.box(btVector3(1, 1, 1)), at(0, 1), false);
		btRigidBody* body =
			world.body(btScalar(mass), world.box(btVector3(btScalar(size), 1, btScalar(size))), at(0, 0), false);
		btElasticPlasticJoint* joint = world.joint(*support, *body, at(0, 0.5), evenCapacity(1e11));
		run(world, 60);
		EXPECT_NEAR(10 * mass / 1e11, -double(body->getCenterOfMassPosition().y()), 1e-2 * 10 * mass / 1e11);
		EXPECT_NEAR(-10 * mass, joint->getForce(BT_EP_SHEAR_Y), 1e-2 * 10 * mass);
		EXPECT_EQ(0, statisticsOf(world).m_fallbacks);
	}
}

TEST(DirectHardCases, FactorsKeepBodiesInPlaneOrUpright)
{
	World world(Solver::Direct);
	btCollisionShape* shape = world.box(btVector3(1, 2, btScalar(0.5)));
	btRigidBody* support = world.body(0, shape, at(0, 0), false);
	btRigidBody* a = world.body(100, shape, at(1, 0), false);
	btRigidBody* b = world.body(100, shape, at(2, 0), false);
	btRigidBody* c = world.body(100, shape, at(3, 0), false);
	world.joint(*support, *a, at(0.5, 0), evenCapacity(1e6));
	world.joint(*a, *b, at(1.5, 0), evenCapacity(1e6));
	world.joint(*b, *c, at(2.5, 0), evenCapacity(1e6));
	a->setLinearFactor(btVector3(1, 1, 0));
	a->setAngularFactor(btVector3(0, 0, 1));
	b->setAngularFactor(btVector3(0, 0, 0));
	c->setLinearFactor(btVector3(0, 0, 0));
	c->setLinearVelocity(btVector3(0, 0, 0));
	b->setLinearVelocity(btVector3(0, 1, 1));
	for (int i = 0; i < 120; ++i)
	{
		world.step(FRAME);
		EXPECT_EQ(0, a->getCenterOfMassPosition().z());
		EXPECT_EQ(0, a->getAngularVelocity().x());
		EXPECT_EQ(0, a->getAngularVelocity().y());
		EXPECT_EQ(0, b->getAngularVelocity().length());
		EXPECT_EQ(0, c->getLinearVelocity().length());
		EXPECT_EQ(3, c->getCenterOfMassPosition().x());
	}
	EXPECT_TRUE(isFinite(*a) && isFinite(*b) && isFinite(*c));
	EXPECT_EQ(0, statisticsOf(world).m_fallbacks);
	// Two springs of 1e6 N/m in each direction at least: what the kick of 14 m/s / 10 leaves is centimetres.
	EXPECT_LT((b->getCenterOfMassPosition() - btVector3(2, 0, 0)).length(), 0.05);
}

TEST(DirectHardCases, FactorsGiveTheAccelerationsOfAConstrainedBody)
{
	// A plank that may only turn about z and rise, on a spring at its end: against the rod's own equation of motion.
	World world(Solver::Direct, btVector3(0, 0, 0));
	btRigidBody* support = world.body(0, world.box(btVector3(1, 1, 1)), at(-2, 0), false);
	btRigidBody* plank = world.body(12, world.box(btVector3(2, btScalar(0.2), btScalar(0.2))), at(0, 0), false);
	btElasticPlasticCapacity capacity = evenCapacity(1000);
	world.joint(*support, *plank, at(-1, 0), capacity);
	plank->setLinearFactor(btVector3(0, 1, 0));
	plank->setAngularFactor(btVector3(0, 0, 1));
	plank->applyCentralImpulse(btVector3(0, 12, 0));
	world.step(btScalar(1e-4));
	world.step(btScalar(1e-4));
	// Joint at -1 m: force k y at arm 1, moment of it over the plank's 12 (4 + 0.04) / 12 kg m^2; all small, and no x or z.
	const double y = 1e-4;
	EXPECT_NEAR(1, plank->getLinearVelocity().y(), 1e-3);
	EXPECT_NEAR(1000 * y * 1.5 * 1e-4 / (4.04), plank->getAngularVelocity().z(), 0.3 * 1000 * y * 1.5e-4 / 4.04);
	EXPECT_EQ(0, plank->getLinearVelocity().x());
	EXPECT_EQ(0, plank->getLinearVelocity().z());
}

TEST(DirectHardCases, FactorsBetweenNoneAndAllWorkAsInBullet)
{
	// A body on a torsion spring or an axial one: the time until it swings through its place.
	for (double factor : {0.5, 0.1})
		for (bool turns : {true, false})
		{
			double times[2];
			for (Solver solver : {Solver::Stock, Solver::Direct})
			{
				World world(solver, btVector3(0, 0, 0));
				btCollisionShape* cube = world.box(btVector3(1, 1, 1));
				btRigidBody* wall = world.body(0, cube, at(0, 0), false);
				btRigidBody* body = world.body(6, cube, at(0, 0), false);
				world.joint(*wall, *body, at(0, 0), evenCapacity(50));
				const btScalar f = btScalar(factor);
				turns ? body->setAngularFactor(btVector3(f, f, f)) : body->setLinearFactor(btVector3(f, f, f));
				body->setCenterOfMassTransform(turns ? btTransform(btQuaternion(btVector3(1, 0, 0), btScalar(0.1)))
													 : at(0.1, 0));
				const auto place = [&]
				{
					return turns ? double(body->getCenterOfMassTransform().getBasis()[2][1])
								 : double(body->getCenterOfMassPosition().x());
				};
				double& time = times[solver == Solver::Direct];
				for (time = 0; place() > 0 && time < 20; time += 1e-3)
					world.step(btScalar(1e-3));
			}
			// The stock row is of first order at this step: a thousandth of the period.
			EXPECT_NEAR(1, times[1] / times[0], 0.01) << factor << turns;
			EXPECT_LT(times[1], 19);
		}
}

TEST(DirectHardCases, OldFactorsAreAsExactAsNewOnes)
{
	// A stirred net that yields here and there: conjugate gradients with the last step's factor against factorising always.
	btVector3 ends[2];
	long long iterations = 0;
	for (int fresh = 0; fresh < 2; ++fresh)
	{
		World world(Solver::Direct);
		btElasticPlasticSolverSettings settings = solverOf(world).getSettings();
		settings.m_maxIterations = fresh ? 0 : 8;
		solverOf(world).setSettings(settings);
		btCollisionShape* cube = world.box(btVector3(1, 1, 1));
		btRigidBody* wall = world.body(0, cube, at(-1, 0), false);
		const int n = 14;
		std::vector<btRigidBody*> net;
		btElasticPlasticCapacity capacity = evenCapacity(1e8);
		capacity.m_yield[BT_EP_BENDING_Z] = 3e5;
		for (int i = 0; i < n * n; ++i)
		{
			const int x = i / n, z = i % n;
			net.push_back(world.body(100, cube, at(x, 0, z), false));
			net.back()->setLinearVelocity(btVector3(0, btScalar(0.02 * x * z), 0));
			world.joint(x > 0 ? *net[i - n] : *wall, *net[i], at(x - 0.5, 0, z), capacity);
			if (z > 0)
				world.joint(*net[i - 1], *net[i], at(x, 0, z - 0.5), capacity);
		}
		for (int i = 0; i < 60; ++i)
			world.step(btScalar(1) / (i % 7 == 0 ? 240 : 60));
		ends[fresh] = net.back()->getCenterOfMassPosition();
		if (!fresh)
			iterations = statisticsOf(world).m_iterations;
	}
	EXPECT_GT(iterations, 0);
	// Each step is exact to 1e-11 of its momentum; 2e-12 m measured in double, rounded poses in float.
	EXPECT_LT((ends[0] - ends[1]).length(), byPrecision(1e-9, 1e-4));
	EXPECT_GT((ends[1] - btVector3(13, 0, 13)).length(), 0.01);
}

TEST(DirectHardCases, KinematicPartnerCarriesTheStructure)
{
	World world(Solver::Direct);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* crane = world.body(0, cube, at(0, 0), false);
	crane->setCollisionFlags(crane->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
	btRigidBody* last = crane;
	for (int i = 1; i <= 5; ++i)
	{
		btRigidBody* next = world.body(1000, cube, at(0, -i), false);
		world.joint(*last, *next, at(0, -i + 0.5), evenCapacity(1e9));
		last = next;
	}
	for (int i = 0; i < 120; ++i)
	{
		// Rises with up to 1 m/s.
		btTransform pose = crane->getWorldTransform();
		pose.getOrigin() += btVector3(0, btScalar(std::min(1., 0.02 * i) / 60), 0);
		crane->setWorldTransform(pose);
		world.step(FRAME);
	}
	EXPECT_NEAR(1, last->getLinearVelocity().y(), 1e-3);
	EXPECT_NEAR(50000, fabs(double(world.joints()[0]->getForce(BT_EP_SHEAR_Y))), byPrecision(1, 200));
	EXPECT_EQ(0, statisticsOf(world).m_fallbacks);
}

TEST(DirectHardCases, WithoutConvergenceIterationsTakeOver)
{
	// No Newton step allowed: as soon as a joint begins to yield, the search cannot end.
	Cantilever cantilever{Cantilever::Settings()};
	btElasticPlasticSolverSettings solverSettings;
	solverSettings.m_maxNewtonSteps = 0;
	solverOf(cantilever.m_world).setSettings(solverSettings);
	btElasticPlasticCapacity capacity = cantilever.m_root->getCapacity();
	capacity.m_yield[BT_EP_BENDING_Z] = 500;
	cantilever.m_root->setCapacity(capacity);
	run(cantilever.m_world, 60);
	EXPECT_GT(statisticsOf(cantilever.m_world).m_fallbacks, 0);
	EXPECT_EQ(0, statisticsOf(cantilever.m_world).m_newtonSteps);
	// Back to normal, it is solved directly again.
	solverOf(cantilever.m_world).setSettings(btElasticPlasticSolverSettings());
	solverOf(cantilever.m_world).resetStatistics();
	run(cantilever.m_world, 60);
	EXPECT_EQ(0, statisticsOf(cantilever.m_world).m_fallbacks);
	for (btRigidBody* part : cantilever.m_member.m_parts)
		EXPECT_TRUE(isFinite(*part));
}

TEST(DirectHardCases, BodyWithoutNumbersDoesNotSpoilOtherIslands)
{
	World world(Solver::Direct);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* healthy = nullptr;
	btRigidBody* sick = nullptr;
	for (int c = 0; c < 2; ++c)
	{
		btRigidBody* last = world.body(0, cube, at(0, 0, 10 * c), false);
		for (int i = 1; i < 5; ++i)
		{
			btRigidBody* next = world.body(100, cube, at(i, 0, 10 * c), false);
			world.joint(*last, *next, at(i - 0.5, 0, 10 * c), evenCapacity(1e8));
			last = next;
		}
		(c ? healthy : sick) = last;
	}
	world.bullet().getSolverInfo().m_minimumSolverBatchSize = 0;
	run(world, 10);
	sick->setLinearVelocity(btVector3(btScalar(NAN), 0, 0));
	run(world, 50);
	EXPECT_TRUE(isFinite(*healthy));
	EXPECT_NEAR(0, healthy->getCenterOfMassPosition().y(), 0.01);
}

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

TEST(DirectHardCases, GridOfTwentyThousandJoints)
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

TEST(DirectHardCases, ChainOfTwentyThousandJoints)
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
}  // namespace
