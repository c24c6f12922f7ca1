// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Joints of solvers that end before the solution give no more than they have been given.

#include <math.h>

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/destruction/Catalogue.h"
#include "support/Close.h"
#include "support/DirectSolver.h"
#include "support/Pair.h"
#include "support/Run.h"
#include "world/EnergyAudit.h"
#include "support/Repeats.h"

namespace testEnergyLedger
{
using namespace ep;

const Solver UNFINISHED[] = {Solver::Iterative, Solver::Stock};

/// Boxes at random turns that fly apart, on a tree of random joints.
struct FreeStructure
{
	World m_world;

	FreeStructure(const Method& method, unsigned seed) : m_world(method, btVector3(0, 0, 0)), m_random(seed)
	{
		m_world.bullet().getSolverInfo().m_numIterations = int(spread(1, 50));
		const int n = 2 + int(uniform(0, 8));
		for (int i = 0; i < n; ++i)
		{
			// One after another, for each compiler evaluates arguments in an order of its own.
			const double z = uniform(-.3, .3), y = uniform(-.3, .3);
			const btQuaternion turned = turn();
			const double height = uniform(.1, 1), width = uniform(.1, 1), length = uniform(.1, 1),
						 mass = spread(1, 100);
			btRigidBody* body = m_world.body(
				btScalar(mass), m_world.box(btVector3(btScalar(length), btScalar(width), btScalar(height))),
				btTransform(turned, btVector3(btScalar(i), btScalar(y), btScalar(z))), false);
			body->setLinearVelocity(vector(5));
			body->setAngularVelocity(vector(5));
		}
		for (int i = 1; i < n; ++i)
		{
			btRigidBody &a = *m_world.bodies()[size_t(uniform(0, i))], &b = *m_world.bodies()[size_t(i)];
			btElasticPlasticCapacity capacity;
			for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
			{
				const double yield = spread(10, 1e6), ductility = spread(1e-3, 1), stiffness = yield * spread(1, 1e5);
				capacity.set(dof, btScalar(stiffness), btScalar(yield), btScalar(ductility));
			}
			m_world.joint(a, b, btTransform(turn(), (a.getCenterOfMassPosition() + b.getCenterOfMassPosition()) / 2),
						  capacity);
		}
	}

	double uniform(double least, double most) { return std::uniform_real_distribution<double>(least, most)(m_random); }
	double spread(double least, double most) { return exp(uniform(log(least), log(most))); }

private:
	btVector3 vector(double most)
	{
		const double x = uniform(-most, most), y = uniform(-most, most), z = uniform(-most, most);
		return btVector3(btScalar(x), btScalar(y), btScalar(z));
	}
	btQuaternion turn()
	{
		const btVector3 axis = vector(1);
		return btQuaternion(axis.normalized(), btScalar(uniform(0, 3)));
	}

	std::mt19937 m_random;
};

TEST(EnergyLedger, FreeStructuresGainNothing)
{
	// Without the ledger a quarter of these scenes gain energy, up to 30 times what they have.
	for (const Solver solver : UNFINISHED)
		for (const bool changes : {false, true})
			for (unsigned seed = 0; seed < 150; ++seed)
			{
				SCOPED_TRACE(testing::Message()
							 << "solver " << int(solver) << ", changes " << changes << ", seed " << seed);
				FreeStructure structure(solver, seed);
				World& world = structure.m_world;
				const double dt = structure.spread(1. / 1000, 1. / 30), first = world.kineticEnergy();
				for (int i = 0; i < 100; ++i)
				{
					const double step = changes ? dt * structure.spread(0.3, 1 / 0.3) : dt;
					world.step(btScalar(step));
					double work = 0, flowed = 0, stored = 0;
					for (const btElasticPlasticJoint* joint : world.joints())
					{
						work += joint->getWork();
						flowed += joint->getPlasticEnergy();
						stored += joint->isBroken() ? 0 : joint->getElasticEnergy();
					}
					// Rounding of velocities and of impulses at yield.
					const double rounding = byPrecision(1e-9, 1e-3) * first;
					ASSERT_LE(world.kineticEnergy(), first + rounding) << i;
					ASSERT_LE(world.kineticEnergy() + flowed + stored, first + rounding) << i;
					ASSERT_LE(flowed, work + rounding) << i;
					ASSERT_LE(flowed + stored, work + rounding) << i;
				}
			}
}

/// Places are half a step ahead of velocities, so a joint's springs and its flow would be ahead of what bodies have given.
void expectToldNoMoreThanHad(const Method& method, unsigned seed, double share)
{
	for (const bool changes : {false, true})
	{
		SCOPED_TRACE(testing::Message() << "changes " << changes << ", seed " << seed);
		FreeStructure structure(method, seed);
		World& world = structure.m_world;
		const double dt = structure.spread(1. / 1000, 1. / 30), first = world.kineticEnergy();
		const double ahead = share * first;
		for (int i = 0; i < 100; ++i)
		{
			world.step(btScalar(changes ? dt * structure.spread(0.3, 1 / 0.3) : dt));
			double work = 0, flowed = 0, stored = 0;
			for (const btElasticPlasticJoint* joint : world.joints())
			{
				work += joint->getWork();
				flowed += joint->getPlasticEnergy();
				stored += joint->isBroken() ? 0 : joint->getElasticEnergy();
			}
			ASSERT_LE(world.kineticEnergy(), first + ahead) << i;
			ASSERT_LE(world.kineticEnergy() + flowed + stored, first + ahead) << i;
			ASSERT_LE(flowed, work + ahead) << i;
		}
	}
}

TEST(EnergyLedger, FreeStructuresOfTheDirectFormTellNoMoreThanTheyHad)
{
	// Other scenes in each precision.
	const unsigned first = unsigned(inPrecision(0, 500)), last = first + unsigned(repeats(500, 150));
	for (unsigned seed = first; seed < last; ++seed)
	{
		// At most 1e-5 in these.
		expectToldNoMoreThanHad(withoutInnerSteps(), seed, 1e-4);
		// The share that is allowed; of 40 000 seeds the worst has 1.4e-4 with inner steps, and 9.2e-4 without.
		expectToldNoMoreThanHad(Solver::Direct, seed, 1e-3);
	}
}

TEST(EnergyLedger, FreeStructuresThatFlowOnTellNoMoreThanTheyHad)
{
	// Of 40 000 seeds the ones in which a joint whose debt had been told, or that had none, was ahead by 0.1 to 1.1 % of the start: turned
	// ever faster by the others, it flows by more than bodies have given.
	for (const unsigned seed : {6410u, 15274u, 22486u, 24272u, 25974u, 28820u, 29688u, 34616u})
		expectToldNoMoreThanHad(withoutInnerSteps(), seed, 1e-4);
	for (const unsigned seed : {7077u, 15045u})
		expectToldNoMoreThanHad(Solver::Direct, seed, 1e-4);
}

TEST(EnergyLedger, KeepsMomentum)
{
	for (const Solver solver : UNFINISHED)
		for (unsigned seed = 0; seed < 20; ++seed)
		{
			FreeStructure structure(solver, seed);
			const auto measure = [&](btVector3& momentum, btVector3& spin)
			{
				momentum = spin = btVector3(0, 0, 0);
				for (const auto& body : structure.m_world.bodies())
				{
					const btVector3 own = body->getLinearVelocity() / body->getInvMass();
					momentum += own;
					spin += body->getCenterOfMassPosition().cross(own) +
							body->getInvInertiaTensorWorld().inverse() * body->getAngularVelocity();
				}
			};
			for (int i = 0; i < 20; ++i)
			{
				btVector3 before[2], after[2];
				measure(before[0], before[1]);
				double size = 0;
				for (const auto& body : structure.m_world.bodies())
					size += double(body->getLinearVelocity().length() / body->getInvMass());
				structure.m_world.step(btScalar(1e-3));
				measure(after[0], after[1]);
				EXPECT_LE(double((after[0] - before[0]).length()), byPrecision(1e-12, 1e-5) * size)
					<< seed << ", " << i;
			}
		}
}

TEST(EnergyLedger, WhatHangsOnSomethingThatMovesGoesWithIt)
{
	// A chain that four iterations cannot hold, on a platform that moves evenly: seen from there it gains nothing.
	for (const Solver solver : UNFINISHED)
	{
		World world(solver, btVector3(0, 0, -10));
		world.bullet().getSolverInfo().m_numIterations = 4;
		const btVector3 speed(7, 0, 0);
		btCollisionShape* box = world.box(btVector3(btScalar(0.5), btScalar(0.1), btScalar(0.1)));
		btRigidBody* platform = world.body(0, box, at(0), false);
		platform->setCollisionFlags(platform->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
		platform->setActivationState(DISABLE_DEACTIVATION);
		btRigidBody* last = platform;
		for (int i = 1; i <= 12; ++i)
		{
			btRigidBody* next = world.body(btScalar(i < 12 ? 5 : 2000), box, at(btScalar(0.5 * i)), false);
			next->setLinearVelocity(speed);
			btElasticPlasticCapacity capacity;
			for (int dof = 0; dof < 3; ++dof)
				capacity.set(dof, btScalar(2e7), btElasticPlasticCapacity::unlimited());
			world.joint(*last, *next, at(btScalar(0.5 * i - 0.25)), capacity);
			last = next;
		}
		const double dt = 1. / 60;
		const auto energy = [&]
		{
			double sum = 0;
			for (const auto& body : world.bodies())
				if (body->getInvMass() > 0)
				{
					const btVector3 velocity = body->getLinearVelocity() - speed;
					const btVector3 place = body->getCenterOfMassPosition() - velocity * btScalar(dt / 2);
					sum += (0.5 * double(velocity.length2()) + 10 * double(place.z())) / double(body->getInvMass()) +
						   0.5 * double(body->getAngularVelocity().dot(body->getInvInertiaTensorWorld().inverse() *
																	   body->getAngularVelocity()));
				}
			return sum;
		};
		const double first = energy();
		double most = first;
		for (int i = 0; i < 240; ++i)
		{
			platform->setWorldTransform(btTransform(btQuaternion::getIdentity(), speed * btScalar((i + 1) * dt)));
			world.step(btScalar(dt));
			most = std::max(most, energy());
		}
		// The first step gets the platform's velocity before the platform has one: bodies that move with it are held back once.
		EXPECT_LE(most - first, byPrecision(1e-6, 1e-3) * 2000 * 10) << int(solver);
	}
}

TEST(EnergyLedger, ShortOfIterationsAPlateUnderBoxesIsSoft)
{
	Stage::Settings settings;
	const DestructionScene* scene = findDestructionScene("plate");
	ASSERT_NE(nullptr, scene);
	Stage stage(settings);
	stage.solver()->setForm(BT_EP_ITERATIVE);
	stage.world().bullet().getSolverInfo().m_numIterations = 10;
	scene->build(stage);
	EnergyAudit audit(stage.world());
	for (int i = 0; i < 120; ++i)
	{
		stage.playScript();
		audit.begin();
		stage.step();
		audit.end(btScalar(Stage::FRAME));
	}
	// Half a step's work of what flows or swings, see EnergyAudit.
	EXPECT_LE(audit.createdByJoints(), EnergyAudit::SLACK);
	EXPECT_LE(audit.created(), byPrecision(1e-12, 1e-4));
}
TEST(EnergyLedger, TakesNothingOfDampingFromFlow)
{
	// A cantilever whose material damps sinks in ten iterations, far below yield.
	for (const Solver solver : UNFINISHED)
	{
		World world(solver);
		world.bullet().getSolverInfo().m_numIterations = 10;
		btElasticPlasticCapacity capacity = evenCapacity(1e7, 1e9);
		capacity.m_damping = btScalar(.05);
		btRigidBody* before = world.body(0, world.box(btVector3(1, 1, 1)), at(0));
		for (int i = 1; i <= 6; ++i)
		{
			btRigidBody* const block = world.body(100, world.box(btVector3(1, 1, 1)), at(btScalar(i)), false);
			world.joint(*before, *block, at(btScalar(i) - btScalar(.5)), capacity);
			before = block;
		}
		for (int i = 0; i < 120; ++i)
		{
			run(world, 1);
			for (const btElasticPlasticJoint* joint : world.joints())
			{
				EXPECT_EQ(joint->getPlasticEnergy(), 0) << "step " << i;
				EXPECT_GE(joint->getDampingEnergy(), 0) << "step " << i;
			}
		}
	}
}
}  // namespace testEnergyLedger
