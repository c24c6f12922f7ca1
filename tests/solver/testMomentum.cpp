// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What nothing from outside acts on keeps its momentum.

#include <gtest/gtest.h>

#include <memory>

#include "BulletDynamics/ConstraintSolver/btFixedConstraint.h"
#include "BulletDynamics/ConstraintSolver/btHingeConstraint.h"
#include "BulletDynamics/ConstraintSolver/btPoint2PointConstraint.h"
#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "support/Run.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testMomentum
{
using namespace ep;

struct Momentum
{
	btVector3 m_linear = btVector3(0, 0, 0), m_angular = btVector3(0, 0, 0);  ///< about the origin

	explicit Momentum(const World& world)
	{
		for (const auto& body : world.bodies())
		{
			if (body->getInvMass() == 0)
				continue;
			const btVector3 linear = body->getLinearVelocity() / body->getInvMass();
			m_linear += linear;
			m_angular += body->getCenterOfMassPosition().cross(linear) +
						 body->getInvInertiaTensorWorld().inverse() * body->getAngularVelocity();
		}
	}
};

std::unique_ptr<btTypedConstraint> makeConstraint(int kind, btRigidBody& a, btRigidBody& b)
{
	const btVector3 onA(btScalar(0.55), 0, 0), axis(0, 0, 1);
	switch (kind)
	{
		case 0:
			return std::unique_ptr<btTypedConstraint>(new btPoint2PointConstraint(a, b, onA, -onA));
		case 1:
			return std::unique_ptr<btTypedConstraint>(new btHingeConstraint(a, b, onA, -onA, axis, axis));
		default:
			return std::unique_ptr<btTypedConstraint>(new btFixedConstraint(
				a, b, btTransform(btQuaternion::getIdentity(), onA), btTransform(btQuaternion::getIdentity(), -onA)));
	}
}

TEST(Momentum, IsKeptByBulletsConstraintsBesideJoints)
{
	for (int kind = 0; kind < 3; ++kind)
	{
		World world(Solver::Direct, btVector3(0, 0, 0));
		btRigidBody* bodies[3];
		for (int i = 0; i < 3; ++i)
			bodies[i] = world.body(100, world.box(btVector3(1, 1, 1)), at(1.1 * i));
		world.joint(*bodies[0], *bodies[1], at(0.55), evenCapacity(1e7, 1e6));
		world.add(makeConstraint(kind, *bodies[1], *bodies[2]).release());
		bodies[0]->setLinearVelocity(btVector3(1, btScalar(0.5), -2));
		const Momentum before(world);
		run(world, 60);
		// A row's least compliance, 1e-10 of its own, leaves of sixteen digits six, and one for the sum over steps; of float there are seven, in each of 60 steps.
		EXPECT_LT((Momentum(world).m_linear - before.m_linear).length(),
				  byPrecision(1e-6, 60 * 1e-7) * before.m_linear.length())
			<< kind;
	}
}

TEST(Momentum, OfTurnIsKeptWhereBodiesSlideOnEachOther)
{
	// A ball glances off two joined cubes without friction. What slides has its two points apart: impulses along two lines made 0.3 and 1.4 %.
	for (const double speed : {5., 20.})
		for (int i = 0; i < 10; ++i)
		{
			World world(Solver::Direct, btVector3(0, 0, 0));
			btRigidBody* const a = world.body(100, world.box(btVector3(1, 1, 1)), at(0));
			btRigidBody* const b = world.body(100, world.box(btVector3(1, 1, 1)), at(1));
			world.joint(*a, *b, at(0.5), evenCapacity(1e7, 1e5));
			btRigidBody* const ball = world.body(50, world.keep(new btSphereShape(btScalar(0.4))), at(0.04 * i, 2));
			ball->setLinearVelocity(btVector3(btScalar(speed / 2), btScalar(-speed), 0));
			for (btRigidBody* body : {a, b, ball})
				body->setFriction(0);
			const Momentum before(world);
			run(world, 60);
			EXPECT_GT(ball->getLinearVelocity().y(), btScalar(-0.9 * speed));
			// What penetration is taken back moves places beside velocities.
			EXPECT_LT((Momentum(world).m_angular - before.m_angular).length(), 1e-4 * before.m_angular.length())
				<< speed << ", " << i;
		}
}
}  // namespace testMomentum
