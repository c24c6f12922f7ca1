// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Elastic-plastic joints in each of Bullet's dynamics worlds, as docs/games.md has them in a table.

#include <math.h>

#include <functional>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/Featherstone/btMultiBodyFixedConstraint.h"
#include "BulletDynamics/Featherstone/btMultiBodyLinkCollider.h"
#include "BulletSoftBody/btSoftBodyHelpers.h"
#include "support/Close.h"
#include "support/Site.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testWorlds
{
using namespace ep;

/// A cantilever of steel, 2 m long, of ten blocks. \return its tip
btRigidBody& buildCantilever(Site& site)
{
	const btScalar length = btScalar(0.2), side = btScalar(0.1);
	const auto steel = btElasticPlasticMaterial::steel(btScalar(355e6));
	const auto section = btElasticPlasticSection::rectangle(side, side);
	btRigidBody* former = &site.body(0, btVector3(1, 1, 1), at(btScalar(-0.5)));
	for (int i = 0; i < 10; ++i)
	{
		btRigidBody& block = site.body(steel.m_density * section.m_area * length, btVector3(length, side, side),
									   at((btScalar(i) + btScalar(0.5)) * length));
		site.join(*former, block, at(btScalar(i) * length),
				  btElasticPlasticCapacity::fromMember(steel, section, i > 0 ? length : btScalar(0), length));
		former = &block;
	}
	return *former;
}

TEST(Worlds, ACantileverSagsByItsStaticSag)
{
	for (Kind kind : {Kind::Discrete, Kind::Multithreaded, Kind::SoftRigid, Kind::MultiBody})
	{
		SCOPED_TRACE(nameOf(kind));
		Site site(kind);
		btRigidBody& tip = buildCantilever(site);
		// The mean of a swing, from 2 s on: 16 Hz are damped by the step.
		site.run(120);
		double sum = 0;
		for (int i = 0; i < 60; ++i, site.run(1))
			sum -= tip.getCenterOfMassPosition().y() / 60;
		// rho A g of 780 N/m: at s = 1.9 m of L = 2 m a sag of q s^2 (s^2 - 4 L s + 6 L^2) / (24 E I), and q s (2 L - s) / (2 G A_s) by shear.
		const double q = 780, s = 1.9, l = 2,
					 bending = q * s * s * (s * s - 4 * l * s + 6 * l * l) / (24 * 200e9 * 1e-4 / 12);
		const double shear = q * s * (2 * l - s) / (2 * 76.9e9 * 0.01 * 5 / 6);
		EXPECT_NEAR(bending + shear, sum, 0.01 * (bending + shear));
	}
}

TEST(Worlds, WhatIsFastDoesNotGoThroughWhatIsJoined)
{
	// 0.67 m a step, at a plate of 0.1 m. Bullet's worlds with threads look no further than that: there inner steps are none.
	for (Kind kind : {Kind::Discrete, Kind::SoftRigid, Kind::MultiBody})
	{
		SCOPED_TRACE(nameOf(kind));
		Site site(kind, btVector3(0, 0, 0));
		btRigidBody &wall = site.body(0, btVector3(1, 1, 1), at(0, -1)),
					&plate = site.body(100, btVector3(btScalar(0.1), 1, 1), at(0)),
					&ball = site.body(10, btVector3(1, 1, 1) / 5, at(-1));
		site.join(wall, plate, at(0, -0.5), evenCapacity(1e9, 1e7));
		ball.setLinearVelocity(btVector3(40, 0, 0));
		site.run(20);
		// It may be as deep as an inner step is long.
		EXPECT_LT(ball.getCenterOfMassPosition().x(), -0.1);
	}
}

TEST(Worlds, AJointYieldsAndBreaksAtItsCapacity)
{
	for (Kind kind : {Kind::Discrete, Kind::Multithreaded, Kind::SoftRigid, Kind::MultiBody})
	{
		SCOPED_TRACE(nameOf(kind));
		Site site(kind);
		btRigidBody &ceiling = site.body(0, btVector3(1, 1, 1), at(0)),
					&load = site.body(1000, btVector3(1, 1, 1), at(0, -2));
		btElasticPlasticCapacity capacity = evenCapacity(1e8, 1e7);
		capacity.set(BT_EP_AXIAL, btScalar(1e8), 8000, btScalar(0.1));
		const btTransform down(btQuaternion(btVector3(0, 0, 1), -SIMD_HALF_PI), btVector3(0, -1, 0));
		btElasticPlasticJoint& joint = site.join(ceiling, load, down, capacity);
		site.run(20);
		EXPECT_TRUE(joint.hasYielded());
		expectClose(8000, joint.getAppliedForce(BT_EP_AXIAL), 1e-5);
		// By 2 m/s^2: 0.1 m after 0.316 s, 19 steps; a step more or less.
		site.run(2);
		EXPECT_TRUE(joint.isBroken());
		EXPECT_EQ(0, site.m_world->getNumConstraints());
	}
}

/// A box that Bullet moves as a multibody without links.
struct Robot
{
	btBoxShape m_shape;
	btMultiBody m_body;
	btMultiBodyLinkCollider m_collider;
	btMultiBodyDynamicsWorld& m_world;

	static btVector3 inertia(const btBoxShape& shape, btScalar mass)
	{
		btVector3 inertia;
		shape.calculateLocalInertia(mass, inertia);
		return inertia;
	}

	Robot(Site& site, btScalar mass, btScalar size, const btVector3& place)
		: m_shape(btVector3(size, size, size) / 2),
		  m_body(0, mass, inertia(m_shape, mass), false, false),
		  m_collider(&m_body, -1),
		  m_world(static_cast<btMultiBodyDynamicsWorld&>(*site.m_world))
	{
		m_body.setBaseWorldTransform(at(place.x(), place.y(), place.z()));
		m_body.finalizeMultiDof();
		m_body.setLinearDamping(0);
		m_body.setAngularDamping(0);
		m_body.setCanSleep(false);
		m_collider.setCollisionShape(&m_shape);
		m_collider.setWorldTransform(m_body.getBaseWorldTransform());
		m_collider.setActivationState(DISABLE_DEACTIVATION);
		m_world.addCollisionObject(&m_collider, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
		m_body.setBaseCollider(&m_collider);
		m_world.addMultiBody(&m_body);
	}
	~Robot()
	{
		m_world.removeMultiBody(&m_body);
		m_world.removeCollisionObject(&m_collider);
	}
};

TEST(Worlds, ARobotStandsOnAStructureWithItsWeight)
{
	for (bool isFirstStatic : {true, false})
	{
		Site site(Kind::MultiBody);
		// A plate of 200 kg that a spring of 1 MN/m holds, and 50 kg on it.
		btRigidBody &wall = site.body(0, btVector3(1, 1, 1), at(0, -5)),
					&plate = site.body(200, btVector3(2, btScalar(0.2), 2), at(0));
		btElasticPlasticCapacity capacity = evenCapacity(1e6, 1e6);
		const btTransform up(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI), btVector3(0, 0, 0));
		btElasticPlasticJoint& joint =
			isFirstStatic ? site.join(wall, plate, up, capacity) : site.join(plate, wall, up, capacity);
		Robot robot(site, 50, 1, btVector3(0, btScalar(0.6), 0));
		site.run(240);
		// Compression, whichever is body A: x points up, from the wall to the plate; positive force is what pulls B back.
		const double force = (isFirstStatic ? -1 : 1) * double(joint.getForce(BT_EP_AXIAL));
		EXPECT_NEAR(250 * GRAVITY, force, 0.01 * 2500);
		EXPECT_NEAR(-250. * GRAVITY / 1e6, plate.getCenterOfMassPosition().y(), 0.02 * 0.0025);
		// The contact gives by dt^2 g m / (0.2 m_p) = 3.5 mm.
		const double gap = double(robot.m_body.getBasePos().y() - plate.getCenterOfMassPosition().y()) - 0.6;
		EXPECT_LT(fabs(gap), 0.005);
	}
}

TEST(Worlds, ARobotThatHitsAStructureKeepsTheMomentum)
{
	Site site(Kind::MultiBody, btVector3(0, 0, 0));
	btRigidBody &a = site.body(10, btVector3(1, 1, 1), at(0)), &b = site.body(30, btVector3(1, 1, 1), at(1));
	btElasticPlasticJoint& joint = site.join(a, b, at(btScalar(0.5)), evenCapacity(1e6, 1e3));
	Robot robot(site, 20, 1, btVector3(-2, btScalar(0.3), 0));
	robot.m_body.setBaseVel(btVector3(5, 0, 0));
	double least = 1e9, most = 0;
	for (int i = 0; i < 120; ++i)
	{
		site.run(1);
		const double momentum = double(20 * robot.m_body.getBaseVel().x()) + double(10 * a.getLinearVelocity().x()) +
								double(30 * b.getLinearVelocity().x());
		least = btMin(least, momentum);
		most = btMax(most, momentum);
	}
	EXPECT_GT(b.getLinearVelocity().x(), 1);
	EXPECT_TRUE(joint.hasYielded());
	EXPECT_NEAR(100, least, 100 * byPrecision(1e-9, 1e-5));
	EXPECT_NEAR(100, most, 100 * byPrecision(1e-9, 1e-5));
}

TEST(Worlds, AMultibodyTiedToAStructureHangsOnItsJoints)
{
	Site site(Kind::MultiBody);
	btRigidBody &ceiling = site.body(0, btVector3(1, 1, 1), at(0)),
				&block = site.body(100, btVector3(1, 1, 1), at(0, -1));
	const btTransform down(btQuaternion(btVector3(0, 0, 1), -SIMD_HALF_PI), btVector3(0, btScalar(-0.5), 0));
	btElasticPlasticJoint& joint = site.join(ceiling, block, down, evenCapacity(1e6, 1e6));
	Robot robot(site, 50, btScalar(0.5), btVector3(0, -2, 0));
	btMultiBodyFixedConstraint tie(&robot.m_body, -1, &block, btVector3(0, btScalar(0.5), 0),
								   btVector3(0, btScalar(-0.5), 0), btMatrix3x3::getIdentity(),
								   btMatrix3x3::getIdentity());
	robot.m_world.addMultiBodyConstraint(&tie);
	site.run(240);
	EXPECT_NEAR(150 * GRAVITY, joint.getForce(BT_EP_AXIAL), 0.01 * 1500);
	EXPECT_NEAR(-2, robot.m_body.getBasePos().y(), 0.01);
	robot.m_world.removeMultiBodyConstraint(&tie);
}

TEST(Worlds, WithoutJointsAMultibodyWorldIsAsBullets)
{
	std::vector<btVector3> places;
	for (bool isOurs : {true, false})
	{
		Site site(Kind::MultiBody);
		btMultiBodyConstraintSolver stock;
		if (!isOurs)
			static_cast<btMultiBodyDynamicsWorld&>(*site.m_world).setMultiBodyConstraintSolver(&stock);
		site.body(0, btVector3(20, 1, 20), at(0, btScalar(-0.5)));
		btRigidBody& box = site.body(30, btVector3(1, 1, 1), at(0, btScalar(0.6)));
		Robot robot(site, 50, 1, btVector3(btScalar(0.3), btScalar(1.7), 0));
		site.run(60);
		places.push_back(box.getCenterOfMassPosition());
		places.push_back(robot.m_body.getBasePos());
	}
	EXPECT_EQ(places[2], places[0]);
	EXPECT_EQ(places[3], places[1]);
}

TEST(Worlds, ASoftBodyLiesOnAStructure)
{
	Site site(Kind::SoftRigid);
	auto& world = static_cast<btSoftRigidDynamicsWorld&>(*site.m_world);
	btRigidBody &wall = site.body(0, btVector3(1, 1, 1), at(0, -5)),
				&plate = site.body(200, btVector3(4, btScalar(0.2), 4), at(0));
	const btTransform up(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI), btVector3(0, 0, 0));
	btElasticPlasticJoint& joint = site.join(wall, plate, up, evenCapacity(1e6, 1e6));
	world.getWorldInfo().m_gravity = world.getGravity();
	btSoftBody* cloth = btSoftBodyHelpers::CreatePatch(world.getWorldInfo(), btVector3(-1, btScalar(0.3), -1),
													   btVector3(1, btScalar(0.3), -1), btVector3(-1, btScalar(0.3), 1),
													   btVector3(1, btScalar(0.3), 1), 9, 9, 0, true);
	cloth->setTotalMass(20);
	world.addSoftBody(cloth);
	site.run(240);
	double height = 0;
	for (int i = 0; i < cloth->m_nodes.size(); ++i)
		height += double(cloth->m_nodes[i].m_x.y()) / cloth->m_nodes.size();
	// Bullet's soft contacts press by impulses of their own between the steps, so the weight is there on average only.
	double force = 0;
	for (int i = 0; i < 120; ++i, site.run(1))
		force -= double(joint.getAppliedForce(BT_EP_AXIAL)) / 120;
	EXPECT_GT(height, 0.05);
	EXPECT_LT(height, 0.4);
	EXPECT_NEAR(2200, force, 0.03 * 2200);
	world.removeSoftBody(cloth);
	delete cloth;
}
}  // namespace testWorlds
