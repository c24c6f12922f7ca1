// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// A game may use any units that belong together.

#include <math.h>

#include <gtest/gtest.h>

#include "support/Close.h"
#include "support/Run.h"
#include "world/Place.h"

namespace testUnits
{
using namespace ep;

struct Units
{
	const char* name;
	double length, mass;  ///< how many of the unit a metre and a kilogram have; seconds are seconds
};

const Units SYSTEMS[] = {{"m, kg", 1, 1},      {"m, t", 1, 1e-3},     {"cm, kg", 100, 1},
						 {"cm, g", 100, 1000}, {"mm, t", 1000, 1e-3}, {"mm, kg", 1000, 1}};

/// A cantilever of two blocks of steel in SI units' terms: what it sags, when its hinge yields and breaks under a load.
struct Course
{
	double sag, yieldTime, breakTime, plasticTurn;
};

Course runIn(const Units& units, Solver solver)
{
	const double length = units.length, stress = units.mass / units.length;
	World world(solver, btVector3(0, btScalar(-10 * length), 0));
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(235e6 * stress));
	steel.m_youngsModulus = btScalar(200e9 * stress);
	steel.m_ultimatePlasticStrain = btScalar(0.05);
	const auto section = btElasticPlasticSection::rectangle(btScalar(0.1 * length), btScalar(0.1 * length));
	btCollisionShape* shape = world.box(btVector3(1, btScalar(0.1), btScalar(0.1)) * btScalar(length));
	btRigidBody* wall = world.body(0, shape, at(btScalar(-0.5 * length)), false);
	btRigidBody* blocks[2];
	for (int i = 0; i < 2; ++i)
		blocks[i] = world.body(btScalar(78 * units.mass), shape, at(btScalar((0.5 + i) * length)), false);
	btElasticPlasticJoint* root =
		world.joint(*wall, *blocks[0], at(0),
					btElasticPlasticCapacity::fromMember(steel, section, 0, btScalar(length), btScalar(0.2 * length)));
	world.joint(*blocks[0], *blocks[1], at(btScalar(length)),
				btElasticPlasticCapacity::fromMember(steel, section, btScalar(length), btScalar(length)));
	EXPECT_FALSE(root->fault());
	run(world, 60);
	Course course = {double(blocks[1]->getCenterOfMassPosition().y()) / length, 0, 0, 0};
	for (int i = 0; i < 240 && !root->isBroken(); ++i)
	{
		// 60 kN m of moment at the wall by 40 kN: more than M_p = 58.75 kN m with the own weight.
		blocks[1]->applyCentralForce(btVector3(0, btScalar(-40e3 * units.mass * length), 0));
		world.step(FRAME);
		if (!root->hasYielded())
			course.yieldTime += double(FRAME);
		course.breakTime += double(FRAME);
		course.plasticTurn = double(root->getPlasticDeformation(BT_EP_BENDING_Z));
	}
	EXPECT_TRUE(root->isBroken());
	return course;
}

TEST(Units, TheSameCourseInAnyConsistentSystem)
{
	for (Solver solver : {Solver::Direct, Solver::Stock})
	{
		const Course si = runIn(SYSTEMS[0], solver);
		EXPECT_LT(si.sag, 0);
		for (const Units& units : SYSTEMS)
		{
			SCOPED_TRACE(units.name);
			// Bullet's own solvers drop rows whose inverse mass or inertia is below SIMD_EPSILON: in float those of more than 8e6 g cm^2.
			if (solver == Solver::Stock && sizeof(btScalar) == sizeof(float) && units.mass > 100)
				continue;
			const Course course = runIn(units, solver);
			// Places are rounded to another digit, by 1e-7 of them in float; a second of swinging makes that a thousand times as much of
			// the sag, which is a thousandth of the length.
			EXPECT_NEAR(si.sag, course.sag, byPrecision(1e-9, 1e-4) * fabs(si.sag) + byPrecision(0, 1e-6));
			EXPECT_NEAR(si.yieldTime, course.yieldTime, 1e-9);
			EXPECT_NEAR(si.breakTime, course.breakTime, byPrecision(1e-9, 1. / 60 + 1e-9));
			EXPECT_NEAR(si.plasticTurn, course.plasticTurn, fabs(si.plasticTurn) * byPrecision(1e-6, 0.05));
		}
	}
}
}  // namespace testUnits
