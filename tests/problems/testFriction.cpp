// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Materials whose strength in shear grows with pressure: a brick on a bed joint, pressed and pushed aside.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticMaterials.h"
#include "support/Close.h"
#include "world/Place.h"
#include "world/World.h"

namespace testFriction
{
using namespace ep;

const double WIDTH = 0.24, LENGTH = 0.3, AREA = WIDTH * LENGTH, BOND = 0.2e6, FRICTION = 0.4;

btElasticPlasticMaterial mortar()
{
	btElasticPlasticMaterial brick = btElasticPlasticReadyMaterial::find("clay brick");
	// It does not tear before it has been seen to slip.
	brick.m_ultimatePlasticStrain = 1;
	return brick;
}

/// A brick that does not turn on a bed joint along an axis.
struct Brick
{
	World m_world;
	btTransform m_frame;
	btRigidBody* m_body;
	btElasticPlasticJoint* m_joint;

	Brick(Solver solver, bool hasFibres, const btQuaternion& turn, bool isReversed)
		: m_world(solver, btVector3(0, 0, 0)), m_frame(turn)
	{
		btCollisionShape* const box = m_world.box(btVector3(btScalar(0.1), btScalar(WIDTH), btScalar(LENGTH)));
		btRigidBody* const ground = m_world.body(0, box, m_frame * at(btScalar(-0.05)), false);
		m_body = m_world.body(20, box, m_frame * at(btScalar(0.05)), false);
		m_body->setAngularFactor(0);
		btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(LENGTH), btScalar(WIDTH));
		if (hasFibres)
			section = section.withFibres();
		const btElasticPlasticCapacity capacity =
			btElasticPlasticCapacity::fromMember(mortar(), section, btScalar(0.1), btScalar(0.1));
		// From the first body to the second one.
		const btTransform back(btQuaternion(btVector3(0, 0, 1), SIMD_PI), btVector3(0, 0, 0));
		m_joint = isReversed ? m_world.joint(*m_body, *ground, m_frame * back, capacity)
							 : m_world.joint(*ground, *m_body, m_frame, capacity);
	}

	/// Pressed by a force [N] and pushed aside by one that grows. \return that at which it slips [N]
	double push(double pressure)
	{
		const int rate = 240;
		for (int i = 0; i < 4 * rate; ++i)
		{
			const double share = std::max(0, i - rate) / (3. * rate),
						 shear = share * 2 * (BOND * AREA + FRICTION * pressure);
			m_body->applyCentralForce(m_frame.getBasis() *
									  btVector3(btScalar(-pressure * std::min(1., double(i) / rate)),
												btScalar(0.6 * shear), btScalar(0.8 * shear)));
			m_world.step(btScalar(1) / rate);
			if (m_joint->getPlasticPath(BT_EP_SHEAR_Y) + m_joint->getPlasticPath(BT_EP_SHEAR_Z) > 1e-6)
				return shear;
		}
		return 0;
	}
};

TEST(Friction, AddsToTheStrengthInShear)
{
	// Each direction of shear by itself: of a force at 3 : 4 the larger part slips first, at 0.8 of it. It grows by a 360th of what is expected in a step.
	for (const double pressure : {0., 50e3, 200e3})
		for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
			for (const bool hasFibres : {false, true})
				for (const bool isReversed : {false, true})
				{
					const double slips =
						Brick(solver, hasFibres, btQuaternion(btVector3(1, 2, 3).normalized(), 1), isReversed)
							.push(pressure);
					EXPECT_NEAR((BOND * AREA + FRICTION * pressure) / 0.8, slips,
								0.01 * (BOND * AREA + FRICTION * pressure) / 0.8)
						<< pressure << " " << int(solver) << " " << hasFibres << " " << isReversed;
				}
}

TEST(Friction, IsAllThatIsLeftWhereTheBondIsTorn)
{
	// Every fibre is torn: what is left is friction.
	Brick brick(Solver::Direct, true, btQuaternion(0, 0, 0, 1), false);
	btElasticPlasticState state = brick.m_joint->getState();
	for (int i = 0; i < state.m_fibres.size(); ++i)
		state.m_fibres[i].m_isCracked = true;
	ASSERT_TRUE(brick.m_joint->setState(state));
	EXPECT_NEAR(FRICTION * 50e3 / 0.8, brick.push(50e3), 0.02 * FRICTION * 50e3 / 0.8);
}

TEST(Friction, LeavesFibresThatBearShearTheirStrength)
{
	// Steel under half of its axial strength and a shear of 0.7 of what it bears with friction, which is 1.7 times what it would bear without.
	btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(200e6));
	steel.m_shearStrength = btScalar(20e6);
	steel.m_friction = btScalar(0.4);
	const btScalar side = btScalar(0.2);
	World world(Solver::Direct, btVector3(0, 0, 0));
	btCollisionShape* const box = world.box(btVector3(1, 1, 1));
	btRigidBody* const ground = world.body(0, box, at(btScalar(-0.5)), false);
	btRigidBody* const body = world.body(1000, box, at(btScalar(0.5)), false);
	body->setAngularFactor(0);
	btElasticPlasticJoint* const joint = world.joint(
		*ground, *body, at(0),
		btElasticPlasticCapacity::fromMember(steel, btElasticPlasticSection::rectangle(side, side).withFibres(), 1, 1));
	const double pressure = 0.5 * 200e6 * 0.04, shear = 0.7 * (20e6 * 0.04 + 0.4 * pressure);
	for (int i = 0; i < 480; ++i)
	{
		body->applyCentralForce(btVector3(btScalar(-pressure * std::min(1., i / 120.)),
										  btScalar(shear * std::min(1., std::max(0., i / 120. - 1))), 0));
		world.step(btScalar(1) / 240);
	}
	EXPECT_EQ(0, joint->getPlasticEnergy());
	EXPECT_NEAR(shear, double(joint->getAppliedForce(BT_EP_SHEAR_Y)), 0.01 * shear);
	EXPECT_NEAR(-pressure, double(joint->getAppliedForce(BT_EP_AXIAL)), 0.01 * pressure);
}

TEST(Friction, MakesNoEnergy)
{
	// Pressed to and fro by a tenth of its strength while it slides.
	for (const Solver solver : {Solver::Direct, Solver::Iterative})
	{
		Brick brick(solver, true, btQuaternion(0, 0, 0, 1), false);
		double given = 0, taken = 0;
		for (int i = 0; i < 480; ++i)
		{
			const double time = i / 240., pressure = 36e3 * (1 + std::sin(40 * time));
			const btVector3 force(btScalar(-pressure), btScalar(20e3 * std::sin(3 * time)), 0);
			const btVector3 before = brick.m_body->getCenterOfMassPosition();
			brick.m_body->applyCentralForce(force);
			brick.m_world.step(btScalar(1) / 240);
			given += double(force.dot(brick.m_body->getCenterOfMassPosition() - before));
			taken = brick.m_joint->getPlasticEnergy() + brick.m_joint->getElasticEnergy() +
					0.5 * 20 * double(brick.m_body->getLinearVelocity().length2());
			// A joint tells plastic energy half a step of flow late.
			EXPECT_LT(taken, 1.001 * given + 0.5) << i;
		}
		EXPECT_GT(brick.m_joint->getPlasticEnergy(), 10);
	}
}

TEST(Friction, IsRefusedOutOfItsRange)
{
	btElasticPlasticMaterial brick = mortar();
	brick.m_friction = -1;
	EXPECT_STREQ("friction of shear forces under pressure", brick.fault().m_quantity);
	brick.m_friction = 3;
	EXPECT_TRUE(brick.fault());
	brick = mortar();
	brick.m_shearStrength = -1;
	EXPECT_STREQ("strength in shear [Pa]", brick.fault().m_quantity);
	brick = mortar();
	brick.m_shearModulus = btScalar(NAN);
	EXPECT_STREQ("shear modulus [Pa]", brick.fault().m_quantity);
	for (const btScalar friction : {btScalar(-1), btScalar(3), btScalar(NAN), btScalar(INFINITY)})
	{
		btElasticPlasticCapacity capacity;
		capacity.m_friction = friction;
		EXPECT_STREQ("friction of shear forces under pressure", capacity.fault().m_quantity);
	}
}
}  // namespace testFriction
