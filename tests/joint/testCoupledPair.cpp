// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Two springs with coupled compliance: the projection, and joints that stand beside the middle of what is elastic.

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/CoupledPair.h"
#include "scenes/Member.h"
#include "support/DirectSolver.h"
#include "support/Precision.h"
#include "support/Run.h"
#include "world/EnergyAudit.h"

namespace testCoupledPair
{
using namespace ep;

TEST(CoupledPair, ProjectsOntoTheBox)
{
	std::mt19937 random(3);
	const auto between = [&random](double a, double b)
	{ return a + (b - a) * double(random()) / double(std::mt19937::max()); };
	int ends[3][3] = {};
	for (int trial = 0; trial < 20000; ++trial)
	{
		btElasticPlastic::CoupledPair<double> pair = {{between(0.1, 1), between(0.1, 1)}, 0};
		pair.m_coupling = between(-0.99, 0.99) * std::sqrt(pair.m_compliance[0] * pair.m_compliance[1]);
		const double u[2] = {between(-2, 2), between(-2, 2)}, lower[2] = {between(-2, 0.5), between(-2, 0.5)},
					 upper[2] = {lower[0] + between(0, 2), lower[1] + between(0, 2)};
		double force[2];
		signed char bound[2];
		pair.project(u, lower, upper, force, bound);
		++ends[bound[0] + 1][bound[1] + 1];
		for (int i = 0; i < 2; ++i)
		{
			// The conditions of Karush, Kuhn and Tucker, which in a convex problem are enough.
			const double pressing = u[i] - pair.m_compliance[i] * force[i] - pair.m_coupling * force[1 - i];
			EXPECT_EQ(bound[i] > 0 ? upper[i] : bound[i] < 0 ? lower[i] : force[i], force[i]);
			EXPECT_GE(force[i], lower[i]);
			EXPECT_LE(force[i], upper[i]);
			if (bound[i] == 0)
				EXPECT_NEAR(0, pressing, 1e-10);
			else
				EXPECT_GE(pressing * bound[i], -1e-12);
		}
	}
	for (const auto& of : ends)
		for (int count : of)
			EXPECT_GT(count, 100);  // all nine regions are met
}

TEST(CoupledPair, TangentIsTheDerivative)
{
	const btElasticPlastic::CoupledPair<double> pair = {{0.5, 0.2}, 0.25};
	const double lower[2] = {-1, -1}, upper[2] = {1, 1}, step = 1e-6;
	for (const auto& at : {std::array<double, 2>{0.1, 0.1}, {0.9, 0.1}, {0.1, 0.6}, {3, 3}, {-0.9, 0.3}})
	{
		double u[2] = {at[0], at[1]}, force[2], diagonal[2], beside;
		signed char bound[2];
		pair.project(u, lower, upper, force, bound);
		pair.getTangent(bound, diagonal, beside);
		for (int i = 0; i < 2; ++i)
		{
			double moved[2] = {u[0], u[1]}, after[2];
			moved[i] += step;
			pair.project(moved, lower, upper, after, bound);
			EXPECT_NEAR(diagonal[i], (after[i] - force[i]) / step, 1e-6);
			EXPECT_NEAR(beside, (after[1 - i] - force[1 - i]) / step, 1e-6);
		}
	}
}

/// A cantilever of one block on a joint at its root, whose middle of what is elastic is a quarter of the block away.
struct OneBlock
{
	World m_world;
	btRigidBody* m_block;
	btElasticPlasticJoint* m_joint;
	static constexpr double LENGTH = 2, SIDE = 0.1, YIELD_STRESS = 200e6;

	/// \param turn, isSwapped  of the scene; whether the block is body A
	OneBlock(const btQuaternion& turn, JointClass jointClass, bool isSwapped, double shearYield)
		: m_world(Solver::Direct, btVector3(0, 0, 0)), m_turn(turn)
	{
		const btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(YIELD_STRESS));
		const btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(SIDE), btScalar(SIDE));
		btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(steel, section, 0, btScalar(LENGTH));
		for (btScalar& ductility : capacity.m_ductility)
			ductility = btElasticPlasticCapacity::unlimited();
		capacity.m_yield[BT_EP_SHEAR_Y] = capacity.m_yield[BT_EP_SHEAR_Z] = btScalar(shearYield);
		const btTransform scene(turn);
		btRigidBody* support = m_world.body(0, m_world.box(btVector3(1, 1, 1)), scene * at(btScalar(-0.5)), false);
		m_block = m_world.body(btScalar(7800 * SIDE * SIDE * LENGTH),
							   m_world.box(btVector3(btScalar(LENGTH), btScalar(SIDE), btScalar(SIDE))),
							   scene * at(btScalar(LENGTH / 2)), false);
		m_joint = isSwapped ? m_world.joint(*m_block, *support, scene, capacity, jointClass)
							: m_world.joint(*support, *m_block, scene, capacity, jointClass);
	}

	/// Lets forces across the block, along y and z at a place of its axis, grow for a second and rest.
	void load(double alongY, double alongZ, double place)
	{
		m_block->setDamping(btScalar(0.9), btScalar(0.9));
		for (int i = 0; i < 240; ++i)
		{
			const double share = std::min(1., (i + 1) / 60.);
			const btVector3 force =
				quatRotate(m_turn, btVector3(0, btScalar(share * alongY), btScalar(share * alongZ)));
			m_block->applyForce(force, quatRotate(m_turn, btVector3(btScalar(place - LENGTH / 2), 0, 0)));
			m_world.step(FRAME);
		}
	}

	btQuaternion m_turn;
};

const double MP = OneBlock::SIDE * OneBlock::SIDE * OneBlock::SIDE / 4 * OneBlock::YIELD_STRESS;

/// The moment is that of the section at the joint, in both planes, whichever body comes first; it yields by this, while the moment in
/// the middle of what is elastic is three quarters of it or, where the load is near the root, has the other sign.
TEST(CoupledPair, AJointYieldsByItsOwnSectionsMoment)
{
	for (const bool isSwapped : {false, true})
		for (const JointClass jointClass : {JointClass::Spring, JointClass::Spring2})
			for (const double place : {2., 1., 0.3})
				for (const bool isAlongZ : {false, true})
					for (const double factor : {0.99, 1.01})
					{
						const btQuaternion turn =
							isSwapped ? btQuaternion(btVector3(1, 1, 0).normalized(), 1) : btQuaternion::getIdentity();
						OneBlock one(turn, jointClass, isSwapped, 1e9);
						const double force = factor * MP / place;
						one.load(isAlongZ ? 0 : force, isAlongZ ? force : 0, place);
						const int dof = isAlongZ ? BT_EP_BENDING_Y : BT_EP_BENDING_Z,
								  shear = isAlongZ ? BT_EP_SHEAR_Z : BT_EP_SHEAR_Y;
						SCOPED_TRACE(testing::Message() << "at " << place << ", factor " << factor << ", swapped "
														<< isSwapped << ", along z " << isAlongZ);
						EXPECT_EQ(factor > 1, one.m_joint->hasYielded());
						EXPECT_EQ(0, one.m_joint->getPlasticPath(shear));
						if (factor < 1)
						{
							// Second order: the deflection, a hundredth of the length, shortens the lever by its square.
							EXPECT_NEAR(factor * MP, std::fabs(one.m_joint->getForce(dof)), 1e-3 * MP);
							EXPECT_NEAR(force, std::fabs(one.m_joint->getForce(shear)), 1e-3 * force);
						}
						else
							EXPECT_GT(one.m_joint->getPlasticPath(dof), 0.01);
					}
}

/// Deflection and turn of the block, which are those of a cantilever's middle and of the section there.
TEST(CoupledPair, ABlockMovesLikeTheSectionAtItsMiddle)
{
	const double E = 200e9, G = E / 2.6, side = OneBlock::SIDE, I = std::pow(side, 4) / 12, x = OneBlock::LENGTH / 2;
	const double force = 1e3, moment = force * (OneBlock::LENGTH - x);  // at the middle, of a force at the tip
	for (const bool isSwapped : {false, true})
	{
		OneBlock one(btQuaternion::getIdentity(), JointClass::Spring2, isSwapped, 1e9);
		one.load(0, -force, OneBlock::LENGTH);
		const double deflection = force * x * x * x / (3 * E * I) + moment * x * x / (2 * E * I) +
								  force * x / (G * side * side * 5 / 6),
					 turn = force * x * x / (2 * E * I) + moment * x / (E * I);
		EXPECT_NEAR(-deflection, one.m_block->getCenterOfMassPosition().z(), byPrecision(1e-4, 1e-3) * deflection);
		EXPECT_NEAR(-turn, one.m_block->getCenterOfMassTransform().getBasis().getColumn(0).z(),
					byPrecision(1e-4, 1e-3) * turn);
	}
}

/// Members of unequal blocks that are thrown about and yield in bending and shear, by every combination of bounds.
TEST(CoupledPair, FlowMakesNoEnergy)
{
	std::mt19937 random(11);
	const auto between = [&random](double a, double b)
	{ return btScalar(a + (b - a) * double(random()) / double(std::mt19937::max())); };
	int flows = 0;
	for (int trial = 0; trial < 60; ++trial)
	{
		const bool hasInnerSteps = trial % 2 == 1;
		World world(hasInnerSteps ? Method(Solver::Direct) : withoutInnerSteps(), btVector3(0, 0, 0));
		btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(between(20e6, 200e6));
		const btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(0.05), btScalar(0.1));
		btRigidBody* before = world.body(0, world.box(btVector3(1, 1, 1)), at(btScalar(-0.5)), false);
		btScalar lengthBefore = 0, place = 0;
		for (int i = 0; i < 4; ++i)
		{
			const btScalar length = between(0.1, 1);
			btRigidBody* next =
				world.body(7800 * btScalar(0.005) * length, world.box(btVector3(length, btScalar(0.1), btScalar(0.05))),
						   at(place + length / 2), false);
			btElasticPlasticCapacity capacity =
				btElasticPlasticCapacity::fromMember(steel, section, lengthBefore, length);
			for (btScalar& ductility : capacity.m_ductility)
				ductility = btElasticPlasticCapacity::unlimited();
			// Shear yields, too.
			const btScalar weak = between(0.01, 0.1);
			capacity.m_yield[BT_EP_SHEAR_Y] *= weak;
			capacity.m_yield[BT_EP_SHEAR_Z] *= weak;
			world.joint(*before, *next, at(place), capacity);
			next->setLinearVelocity(btVector3(0, between(-10, 10), between(-10, 10)));
			next->setAngularVelocity(btVector3(between(-5, 5), between(-5, 5), between(-5, 5)));
			before = next;
			lengthBefore = length;
			place += length;
		}
		const btScalar dt = btScalar(1) / (trial % 6 < 2 ? 60 : trial % 6 < 4 ? 240 : 960);
		EnergyAudit audit(world);
		const double put = world.kineticEnergy();
		for (int i = 0; i < 1 / dt; ++i)
		{
			audit.step(dt);
			double elastic = 0;
			for (const btElasticPlasticJoint* joint : world.joints())
				elastic += joint->getElasticEnergy();
			// Velocities stand half a step before places: at the beginning, the sum may be above what was put in by a little.
			ASSERT_LE(world.kineticEnergy() + elastic, put * 1.001) << "trial " << trial << " at " << i * dt;
		}
		EXPECT_LT(world.kineticEnergy(), put / 2);
		// What has flowed in the last of several inner steps is not told, and the audit takes it for an even share.
		EXPECT_LE(audit.createdByJoints(), hasInnerSteps ? 0.01 : 0.) << "trial " << trial;
		for (const btElasticPlasticJoint* joint : world.joints())
			for (int plane = 0; plane < 2; ++plane)
				flows += joint->getPlasticPath(BT_EP_SHEAR_Y + plane) > 0 &&
						 joint->getPlasticPath(BT_EP_BENDING_Z - plane) > 0;
	}
	EXPECT_GT(flows, 30);
}
}  // namespace testCoupledPair
