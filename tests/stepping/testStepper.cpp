// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What a stepper tells of a world, and how it steps it.

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticStepper.h"
#include "scenes/Cantilever.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testStepper
{
using namespace ep;

TEST(Stepper, TellsMistakes)
{
	const auto textOf = [](btElasticPlasticConstraintSolver* solver, btScalar step)
	{
		World world(Solver::Direct);
		return std::string(btElasticPlasticStepper(world.bullet(), world.action(), solver, 0.01, step).getText());
	};
	btElasticPlasticConstraintSolver other;
	other.setForm(BT_EP_ITERATIVE);
	EXPECT_NE(std::string::npos, textOf(&other, btScalar(0.01)).find("the solver is not the world's"));
	EXPECT_EQ(BT_EP_ITERATIVE, other.getForm());
	EXPECT_NE(std::string::npos, textOf(nullptr, btScalar(0.01)).find("the action has no joints"));
	EXPECT_EQ(std::string::npos, textOf(nullptr, btScalar(0.01)).find("the step is"));
	for (const btScalar step : {btScalar(0), btScalar(-1), std::numeric_limits<btScalar>::quiet_NaN()})
		EXPECT_NE(std::string::npos, textOf(nullptr, step).find("mistake: the step is"));
}

TEST(Stepper, TellsWhatItLeavesOutAndKeepsToTheError)
{
	Cantilever::Settings settings;
	auto* solver = new btElasticPlasticConstraintSolver;
	solver->setForm(BT_EP_ITERATIVE);
	World world(Solver::Direct, btVector3(0, -10, 0), std::unique_ptr<btConstraintSolver>(solver));
	btRigidBody* support = world.body(0, world.box(btVector3(1, 1, 1)), at(-0.5), false);
	Member member(world, settings.member, btTransform::getIdentity(), 2);
	member.joinStart(world, *support);
	btElasticPlasticStepper stepper(world.bullet(), world.action(), solver, 0.01, btScalar(1) / 60);
	EXPECT_EQ(BT_EP_DIRECT, solver->getForm());
	const std::string text = stepper.getText();
	EXPECT_NE(std::string::npos, text.find("10 joints between 10 bodies; up to 10 joints from a support")) << text;
	EXPECT_NE(std::string::npos, text.find("substeps: left out")) << text;
	int substeps = 0;
	for (int i = 0; i < 60; ++i)
		substeps += stepper.step();
	EXPECT_LT(substeps, 60 + 20);
	EXPECT_EQ(0, stepper.step(0));
	const double time = world.action().getTime();
	stepper.step(btScalar(1) / 128);
	EXPECT_EQ(time + 1. / 128, world.action().getTime());
}
}  // namespace testStepper
