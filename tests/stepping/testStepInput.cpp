// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What a game does to bodies before a step that is made in substeps: loads, kinematic bodies, bodies that come and go.

#include <gtest/gtest.h>

#include "scenes/BlockUnderTension.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticStepControl.h"
#include "support/Precision.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"
#include "support/Run.h"

namespace testStepInput
{
using namespace ep;

TEST(StepInput, LoadsHoldThroughoutTheStep)
{
	for (const btScalar factor : {btScalar(1), btScalar(0.5)})
	{
		World world(Solver::Direct, btVector3(0, 0, 0));
		btRigidBody* body = world.body(2, world.box(btVector3(1, 1, 1)), btTransform::getIdentity(), false);
		body->setLinearFactor(btVector3(1, factor, 1));
		btElasticPlasticStepControl control(0.01);
		body->applyCentralForce(btVector3(0, 12, 0));
		body->applyTorque(btVector3(0, 0, 1));
		EXPECT_GT(control.step(world.bullet(), world.action(), btScalar(0.5)), 3);
		EXPECT_NEAR(factor * 3, body->getLinearVelocity().y(), byPrecision(1e-12, 1e-5));
		EXPECT_NEAR(0.5 / (2. / 6), body->getAngularVelocity().z(), byPrecision(1e-12, 1e-5));
		EXPECT_EQ(0, body->getTotalForce().length());
	}
}

TEST(StepInput, KinematicBodiesGoEvenly)
{
	// A piston moves against a free block at 3 m/s, placed by the game once in a step: by a motion state, or by itself.
	for (const bool hasMotionState : {true, false})
	{
		World world(Solver::Direct, btVector3(0, 0, 0));
		btCollisionShape* const cube = world.box(btVector3(1, 1, 1));
		btRigidBody* const piston = world.body(0, cube, btTransform::getIdentity());
		btRigidBody* const block = world.body(10, cube, at(1.1));
		btDefaultMotionState place;
		makeKinematic(*piston);
		piston->setMotionState(hasMotionState ? &place : nullptr);
		btElasticPlasticStepControl control(0.01);
		for (int i = 1; i <= 30; ++i)
		{
			const btTransform to = at(0.05 * i);
			if (hasMotionState)
				place.setWorldTransform(to);
			else
				piston->setWorldTransform(to);
			control.expectBlow();
			EXPECT_GT(control.step(world.bullet(), world.action(), btScalar(1) / 60), 5);
			EXPECT_EQ(hasMotionState ? &place : nullptr, piston->getMotionState());
			EXPECT_TRUE(piston->getWorldTransform() == to);
			// Differences of places 1 m away over substeps of 0.26 ms.
			EXPECT_NEAR(3, piston->getLinearVelocity().x(), byPrecision(1e-9, 1e-3));
		}
		// A substep's way, 0.8 mm, is how deep the piston gets, of which Bullet pushes out a fifth in a step.
		EXPECT_NEAR(3, block->getLinearVelocity().x(), 0.01);
	}
}

/// A block whose joint breaks within the first steps.
BlockUnderTension::Settings overloaded()
{
	BlockUnderTension::Settings settings;
	settings.method = Solver::Direct;
	settings.mass = 20000;
	settings.ductility = btScalar(0.001);
	return settings;
}

TEST(StepInput, ABodyMadeWhereOneWasDeletedDoesNotGetItsLoad)
{
	struct Replacement : btElasticPlasticListener
	{
		BlockUnderTension* m_block;
		bool m_isDone = false;
		void onBreak(const btElasticPlasticEvent&) override
		{
			World& world = m_block->m_world;
			btRigidBody* const body = m_block->m_block;
			btCollisionShape* const shape = body->getCollisionShape();
			world.action().removeBody(world.bullet(), *body);
			body->~btRigidBody();
			new (body) btRigidBody(1, nullptr, shape, btVector3(1, 1, 1));
			world.bullet().addRigidBody(body);
			body->setGravity(btVector3(0, 0, 0));
			m_isDone = true;
		}
	};
	BlockUnderTension block(overloaded());
	Replacement replacement;
	replacement.m_block = &block;
	block.m_world.action().setListener(&replacement);
	btElasticPlasticStepControl control(0.01);
	for (int i = 0; i < 30 && !replacement.m_isDone; ++i)
	{
		block.m_block->applyCentralForce(btVector3(0, -1000, 0));
		control.expectBlow();
		control.step(block.m_world.bullet(), block.m_world.action(), btScalar(1) / 60);
	}
	EXPECT_TRUE(replacement.m_isDone);
	EXPECT_EQ(0, block.m_block->getLinearVelocity().length());
}

TEST(StepInput, WhatBreaksMayBeDeletedBetweenSubsteps)
{
	struct Remover : btElasticPlasticListener
	{
		World* m_world;
		btRigidBody* m_body;
		void onBreak(const btElasticPlasticEvent&) override
		{
			m_world->action().removeBody(m_world->bullet(), *m_body);
			m_body = nullptr;
		}
	};
	BlockUnderTension block(overloaded());
	Remover remover;
	remover.m_world = &block.m_world;
	remover.m_body = block.m_block;
	block.m_world.action().setListener(&remover);
	btElasticPlasticStepControl control(0.01);
	for (int i = 0; i < 30 && remover.m_body; ++i)
	{
		block.m_block->applyCentralForce(btVector3(0, -1000, 0));
		control.step(block.m_world.bullet(), block.m_world.action(), btScalar(1) / 60);
	}
	EXPECT_EQ(nullptr, remover.m_body);
}
}  // namespace testStepInput
