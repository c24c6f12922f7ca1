// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Fibres whose strength in tension falls by a fracture energy.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/Close.h"
#include "support/DirectSolver.h"
#include "support/Run.h"
#include "world/Place.h"

namespace testSoftening
{
using namespace ep;

const double SIDE = 0.1, TENSION = 3e6, COMPRESSION = 30e6, YOUNGS = 30e9, ENERGY = 1000;
const double WIDTH = 2 * ENERGY / TENSION, WORK = SIDE * SIDE * ENERGY;  // of an open crack [m], [J]

btElasticPlasticMaterial concrete(double strength = 1, double crushingStrain = 0.1)
{
	btElasticPlasticMaterial concrete;
	concrete.m_youngsModulus = btScalar(YOUNGS);
	concrete.m_yieldStress = btScalar(COMPRESSION * strength);
	concrete.m_tensileShare = btScalar(TENSION / COMPRESSION);
	concrete.m_crushingStrain = btScalar(crushingStrain);
	concrete.m_fractureEnergy = btScalar(ENERGY);
	concrete.m_dampingRatio = 0;  // the branch is that of slow motion
	return concrete;
}

/// Four fibres have the section's area and second moments with stiffness as their area is.
btElasticPlasticSection section()
{
	btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE));
	const btScalar arm = btScalar(SIDE / std::sqrt(12.));
	for (int i = 0; i < 4; ++i)
		section.m_fibres.push_back({i % 2 ? arm : -arm, i < 2 ? arm : -arm, btScalar(SIDE * SIDE / 4), 0});
	return section;
}

/// A bar of 1 m in pieces, between the ground and a body that is too heavy to be stopped.
struct PulledBar
{
	World m_world;
	btRigidBody* m_last;
	std::vector<btElasticPlasticJoint*> m_joints;

	explicit PulledBar(int pieces = 1, double crushingStrain = 0.1, Solver solver = Solver::Direct)
		: m_world(solver, btVector3(0, 0, 0))
	{
		btRigidBody* before = m_world.body(0, m_world.box(btVector3(1, 1, 1)), at(0), false);
		const double length = 1. / pieces;
		btCollisionShape* const piece = m_world.box(btVector3(btScalar(length), btScalar(SIDE), btScalar(SIDE)));
		for (int i = 0; i < pieces; ++i)
		{
			const bool isLast = i + 1 == pieces;
			btRigidBody* const body =
				m_world.body(btScalar(isLast ? 1e6 : 24. / pieces), piece, at(btScalar((i + 1) * length)), false);
			// One is the weakest, or chance would decide.
			m_joints.push_back(
				m_world.joint(*before, *body, at(btScalar((i + 0.5) * length)),
							  btElasticPlasticCapacity::fromMember(concrete(i == pieces / 2 ? 1 : 1.02, crushingStrain),
																   section(), btScalar(length), btScalar(length))));
			before = body;
		}
		m_last = before;
	}

	/// \param speed  [m/s]
	void step(double speed, double dt)
	{
		m_last->setLinearVelocity(btVector3(btScalar(speed), 0, 0));
		m_world.step(btScalar(dt));
	}
	double plasticEnergy() const
	{
		double sum = 0;
		for (const btElasticPlasticJoint* joint : m_joints)
			sum += joint->getPlasticEnergy();
		return sum;
	}
	bool isApart() const
	{
		return std::any_of(m_joints.begin(), m_joints.end(),
						   [](const btElasticPlasticJoint* joint) { return joint->isBroken(); });
	}
};

TEST(Softening, TakesUpTheFractureEnergyWhateverTheStep)
{
	for (const int steps : {4, 16, 64, 256})
	{
		PulledBar bar;
		const double speed = 0.05, dt = WIDTH / speed / steps;
		for (int i = 0; i < 3 * steps && !bar.isApart(); ++i)
			bar.step(speed, dt);
		EXPECT_NEAR(WORK, bar.plasticEnergy(), (steps < 16 ? 0.01 : 0.001) * WORK) << steps << " steps";
		// All is open, and wider than the crack's last width.
		EXPECT_TRUE(bar.isApart());
	}
}

TEST(Softening, StopsABodyOrLetsItGoOnHoweverFastItIs)
{
	// At the game's step it opens the crack in ten steps, or five times over in one.
	for (const Solver solver : {Solver::Direct, Solver::Iterative})
		for (const bool hasInnerSteps : {true, false})
			for (const double widths : {0.1, 0.5, 1., 2., 5.})
				for (const double ratio : {0.3, 1.2, 3.})
				{
					PulledBar bar(1, 0.1, solver);
					btElasticPlasticSolverSettings settings = solverOf(bar.m_world).getSettings();
					if (!hasInnerSteps)
						settings.m_innerError = 0;
					solverOf(bar.m_world).setSettings(settings);
					const double speed = widths * WIDTH * 60, mass = 2 * ratio * WORK / (speed * speed);
					bar.m_last->setMassProps(btScalar(mass), btScalar(mass) * btVector3(1, 1, 1));
					bar.m_last->updateInertiaTensor();
					bar.m_last->setLinearVelocity(btVector3(btScalar(speed), 0, 0));
					const double before = mass * speed * speed / 2;
					double most = before;
					for (int i = 0; i < 60; ++i)
					{
						bar.m_world.step(btScalar(1) / 60);
						most = std::max(most, mass * double(bar.m_last->getLinearVelocity().length2()) / 2);
					}
					const double left = mass * double(bar.m_last->getLinearVelocity().length2()) / 2;
					// What is torn in one step takes its work at the speed before it: at 1.2, (1 - 1 / 2.4)^2 are left, which is 0.174 more than
					// 1 - 1 / 1.2.
					EXPECT_NEAR(std::max(0., 1 - 1 / ratio), left / before, 0.18)
						<< int(solver) << ", " << widths << " widths in a step, ratio " << ratio;
					EXPECT_EQ(ratio > 1, bar.isApart()) << int(solver) << ", " << widths << ", " << ratio;
					EXPECT_LE(most, before * (1 + 1e-6));
				}
}

TEST(Softening, FallsLinearlyWithTheCrack)
{
	PulledBar bar;
	const double stiffness = YOUNGS * SIDE * SIDE, strength = TENSION * SIDE * SIDE;
	for (int i = 0; i < 300; ++i)
	{
		bar.step(0.01, 1. / 4800);
		const double elongation = double(bar.m_last->getCenterOfMassPosition().x()) - 1;
		// k e until it cracks; then (1 - w / w_u) f, with e = w + f / k.
		const double rate = strength / WIDTH,
					 exact = std::min(stiffness * elongation, (strength - rate * elongation) / (1 - rate / stiffness));
		EXPECT_NEAR(exact, bar.m_joints[0]->getForce(BT_EP_AXIAL), 0.01 * strength) << i;
	}
}

TEST(Softening, TakesUpAsMuchHoweverFinelyAMemberIsCut)
{
	for (const int pieces : {1, 2, 4, 8})
	{
		PulledBar bar(pieces);
		for (int i = 0; i < 2000 && !bar.isApart(); ++i)
			bar.step(0.01, 1. / 4800);
		EXPECT_NEAR(WORK, bar.plasticEnergy(), 0.05 * WORK) << pieces << " pieces";
	}
}

TEST(Softening, UnloadsByTheSpringAndBearsPressureWhenItHasClosed)
{
	PulledBar bar;
	const double stiffness = YOUNGS * SIDE * SIDE, dt = 1. / 4800;
	const auto force = [&] { return double(bar.m_joints[0]->getForce(BT_EP_AXIAL)); };
	const auto elongation = [&] { return double(bar.m_last->getCenterOfMassPosition().x()) - 1; };
	while (bar.m_joints[0]->getState().m_fibres[0].m_damage < 0.5)
		bar.step(0.01, dt);
	const double half = force(), from = elongation();
	EXPECT_NEAR(0.5 * TENSION * SIDE * SIDE, half, 0.01 * TENSION * SIDE * SIDE);
	// Of what it tells, a part waits for what bodies have given.
	const auto dissipated = [&] { return bar.m_joints[0]->getState().m_plasticEnergy; };
	const double taken = dissipated();
	// In float places of 1 m are rounded by 1e-7 m.
	const double rounding = byPrecision(0.002 * half, 2e-7 * stiffness);
	for (int i = 0; i < 20; ++i)
		bar.step(-0.01, dt);
	EXPECT_NEAR(half - stiffness * (from - elongation()), force(), rounding);
	for (int i = 0; i < 18; ++i)
		bar.step(0.01, dt);
	EXPECT_NEAR(half - stiffness * (from - elongation()), force(), rounding);
	EXPECT_EQ(taken, dissipated());
	while (!bar.m_joints[0]->getState().m_fibres[0].m_isCracked && !bar.isApart())
		bar.step(0.01, dt);
	EXPECT_FALSE(bar.isApart());
	EXPECT_NEAR(WORK, bar.plasticEnergy(), 0.01 * WORK);
	// It is open now, and closes where it was whole.
	while (elongation() > 0 && bar.m_joints[0]->getForce(BT_EP_AXIAL) >= 0)
		bar.step(-0.01, dt);
	EXPECT_NEAR(0, elongation(), 0.01 * dt + 2e-7);
	for (int i = 0; i < 120; ++i)
		bar.step(-0.01, dt);
	EXPECT_NEAR(stiffness * elongation(), force(), rounding);
	EXPECT_LT(force(), -2 * TENSION * SIDE * SIDE);
	EXPECT_NEAR(WORK, bar.plasticEnergy(), 0.01 * WORK);
}

TEST(Softening, ClosesWhereItHasBeenCrushedTo)
{
	// Pressed beyond its strength first, and once more when it is half open: the crack is what it was stretched by.
	PulledBar bar;
	const double stiffness = YOUNGS * SIDE * SIDE, dt = 1. / 4800;
	const auto elongation = [&] { return double(bar.m_last->getCenterOfMassPosition().x()) - 1; };
	const auto state = [&]() -> const btElasticPlasticFibreState& { return bar.m_joints[0]->getState().m_fibres[0]; };
	const auto press = [&](double crushed)
	{
		while (bar.m_joints[0]->getPlasticPath(BT_EP_AXIAL) < btScalar(crushed))
			bar.step(-0.01, dt);
	};
	press(1e-4);
	const double first = double(state().m_path);
	while (double(state().m_damage) < 0.5)
		bar.step(0.01, dt);
	const double stretched = double(state().m_path) - first;
	press(double(state().m_path) + 5e-5);
	const double crushed = double(state().m_path) - stretched;
	while (!state().m_isCracked && !bar.isApart())
		bar.step(0.01, dt);
	ASSERT_FALSE(bar.isApart());
	while (bar.m_joints[0]->getForce(BT_EP_AXIAL) >= 0)
		bar.step(-0.01, dt);
	// In float the places of some hundred steps are rounded by 1e-7 m each.
	EXPECT_NEAR(-crushed, elongation(), 0.01 * dt + byPrecision(1e-9, 1e-6));
	for (int i = 0; i < 20; ++i)
		bar.step(-0.01, dt);
	EXPECT_NEAR(stiffness * (elongation() + crushed), double(bar.m_joints[0]->getForce(BT_EP_AXIAL)),
				byPrecision(0.002, 0.02) * TENSION * SIDE * SIDE + stiffness * byPrecision(1e-9, 1e-6));
}

TEST(Softening, WhatIsTornAsItIsPressedBearsWhatItHasNotBeenCrushedBy)
{
	// Half torn, and then crushed until both together have spent it: a crack whose faces are together, which bears on as any.
	const double limit = 1e-3, dt = 1. / 4800;
	PulledBar bar(1, limit);
	const auto state = [&]() -> const btElasticPlasticFibreState& { return bar.m_joints[0]->getState().m_fibres[0]; };
	const auto force = [&] { return double(bar.m_joints[0]->getForce(BT_EP_AXIAL)); };
	while (double(state().m_damage) < 0.5)
		bar.step(0.01, dt);
	const double stretched = double(state().m_path), worn = double(state().m_damage);
	while (!state().m_isCracked && !bar.isApart())
		bar.step(-0.01, dt);
	ASSERT_FALSE(bar.isApart());
	const double strength = COMPRESSION * SIDE * SIDE;
	EXPECT_NEAR(-strength, force(), byPrecision(1e-9, 1e-4) * strength);
	const auto crushed = [&] { return (double(state().m_path) - stretched) / limit; };
	EXPECT_NEAR(1 - worn, crushed(), 0.01 * dt / limit);
	EXPECT_NEAR(crushed(), double(state().m_damage), byPrecision(1e-9, 1e-3));
	while (!bar.isApart() && crushed() < 2)
		bar.step(-0.01, dt);
	EXPECT_NEAR(1, crushed(), 0.01 * dt / limit);
	EXPECT_NEAR(WORK * worn * (2 - worn) + strength * limit, bar.plasticEnergy(), 0.01 * strength * limit);
}

TEST(Softening, RemembersWhatItHasBeenCrushedByAsItIsTorn)
{
	const double limit = 1e-3, dt = 1. / 4800;
	PulledBar bar(1, limit);
	const auto state = [&]() -> const btElasticPlasticFibreState& { return bar.m_joints[0]->getState().m_fibres[0]; };
	while (double(state().m_damage) < 0.25)
		bar.step(-0.01, dt);
	const double crushed = double(state().m_path);
	while (!state().m_isCracked && !bar.isApart())
		bar.step(0.01, dt);
	ASSERT_FALSE(bar.isApart());
	EXPECT_NEAR(crushed / limit, double(state().m_damage), byPrecision(1e-9, 1e-3));
}

TEST(Softening, TellsWhatIsWrong)
{
	btElasticPlasticMaterial bad = concrete();
	EXPECT_FALSE(bad.fault());
	bad.m_fractureEnergy = -1;
	EXPECT_STREQ("fracture energy [J/m^2]", bad.fault().m_quantity);
	bad = concrete();
	bad.m_tensileShare = 0;
	EXPECT_STREQ("fracture energy [J/m^2]", bad.fault().m_quantity);
	bad = concrete();
	bad.m_hardening.push_back({btScalar(0.1), btScalar(40e6)});
	EXPECT_STREQ("fracture energy [J/m^2]", bad.fault().m_quantity);
}
}  // namespace testSoftening
