// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Bodies that are hard for the direct form: light and heavy, huge, held in some directions, kinematic, not a number.

#include <math.h>

#include <algorithm>

#include <gtest/gtest.h>

#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "support/Run.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testHardBodies
{
using namespace ep;

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

TEST(HardBodies, MassesFromKilogramsToThousandsOfTons)
{
	hang(1, 1e7, false);
	hang(1, 1e7, true);
}

// addRow's floor of 1e-10 on a row's compliance, relative to the light body's 1/m, makes the joint 28 times too soft here.
TEST(HardBodies, MassesFromGramsToThousandsOfTons)
{
	hang(1e-3, 1e7, false);
	hang(1e-3, 1e7, true);
}

TEST(HardBodies, HugeBodiesHangFromASupport)
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

TEST(HardBodies, FactorsKeepBodiesInPlaneOrUpright)
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

TEST(HardBodies, FactorsGiveTheAccelerationsOfAConstrainedBody)
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

TEST(HardBodies, FactorsBetweenNoneAndAllWorkAsInBullet)
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

TEST(HardBodies, KinematicPartnerCarriesTheStructure)
{
	World world(Solver::Direct);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* crane = world.body(0, cube, at(0, 0), false);
	makeKinematic(*crane);
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

TEST(HardBodies, AKinematicBodyWithAMassKeepsItsVelocityUnderContacts)
{
	// A jointed beam comes to rest on it. Once it may fall, it begins at rest: nothing of the contacts' impulses is left on it.
	for (btElasticPlasticContacts contacts : {BT_EP_EXACT_CONTACTS, BT_EP_SWEPT_CONTACTS})
	{
		World world(Solver::Direct);
		btElasticPlasticSolverSettings settings = solverOf(world).getSettings();
		settings.m_contacts = contacts;
		solverOf(world).setSettings(settings);
		btCollisionShape* cube = world.box(btVector3(1, 1, 1));
		btRigidBody* table = world.body(50, cube, at(0));
		makeKinematic(*table);
		btRigidBody *a = world.body(1000, cube, at(0, btScalar(1.01))),
					*b = world.body(1000, cube, at(1, btScalar(1.01)));
		world.joint(*a, *b, at(btScalar(0.5), btScalar(1.01)), evenCapacity(1e8));
		for (int i = 0; i < 60; ++i)
		{
			world.step(FRAME);
			EXPECT_EQ(btVector3(0, 0, 0), table->getLinearVelocity()) << "step " << i;
			EXPECT_EQ(btVector3(0, 0, 0), table->getAngularVelocity()) << "step " << i;
		}
	}
}

TEST(HardBodies, BodyWithoutNumbersDoesNotSpoilOtherIslands)
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
}  // namespace testHardBodies
