// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Structures of bodies that touch.

#include <math.h>

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticBonding.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticMaterials.h"
#include "support/Close.h"
#include "support/Run.h"
#include "world/Place.h"

namespace testBonding
{
using namespace ep;
typedef btElasticPlasticBonding Bonding;
typedef btAlignedObjectArray<btElasticPlasticFace> Faces;

const btScalar GAP = btScalar(0.002);

/// Rounding of places some metres from the origin, through a dozen operations.
const double ROUNDING = byPrecision(1e-12, 2e-5);

std::vector<btTransform> places()
{
	return {btTransform::getIdentity(),
			btTransform(btQuaternion(btVector3(1, -2, 3).normalized(), btScalar(1.1)), btVector3(3, -4, 5))};
}

std::vector<btRigidBody*> pointersTo(const World& world)
{
	std::vector<btRigidBody*> bodies;
	for (const auto& body : world.bodies())
		bodies.push_back(body.get());
	return bodies;
}

Faces facesOf(const World& world, btScalar gap = GAP)
{
	const std::vector<btRigidBody*> bodies = pointersTo(world);
	Faces faces;
	EXPECT_TRUE(Bonding::findFaces(bodies.data(), int(bodies.size()), gap, faces));
	return faces;
}

TEST(Bonding, TwoBoxesTouchInARectangle)
{
	for (const btTransform& place : places())
		for (bool isFirstFixed : {true, false})
			for (btScalar apart : {btScalar(0), btScalar(0.001), btScalar(-0.001)})
			{
				World world(Solver::Direct);
				// 1 x 2 x 3 and 2 x 1 x 1 m, side by side along x, 0.3 m beside each other along y.
				btRigidBody* a = world.body(isFirstFixed ? 0 : 5, world.box(btVector3(1, 2, 3)), place * at(0));
				btRigidBody* b =
					world.body(7, world.box(btVector3(2, 1, 1)), place * at(btScalar(1.5) + apart, btScalar(0.7)));
				const Faces faces = facesOf(world);
				ASSERT_EQ(1, faces.size());
				const btElasticPlasticFace& face = faces[0];
				EXPECT_EQ(a, face.m_bodyA);
				EXPECT_EQ(b, face.m_bodyB);
				// Common is y from 0.2 to 1, z from -0.5 to 0.5.
				EXPECT_NEAR(0.8, face.m_area, ROUNDING);
				EXPECT_NEAR(1, face.m_height, ROUNDING);
				EXPECT_NEAR(0.8, face.m_width, ROUNDING);
				EXPECT_NEAR(isFirstFixed ? 0 : 1 + apart, face.m_lengthA, ROUNDING);
				EXPECT_NEAR(2 + apart, face.m_lengthB, ROUNDING);
				const btTransform frame = place.inverse() * face.m_frame;
				EXPECT_NEAR(0, (frame.getOrigin() - btVector3(btScalar(0.5) + apart / 2, btScalar(0.6), 0)).length(),
							ROUNDING);
				EXPECT_NEAR(1, frame.getBasis().getColumn(0).x(), ROUNDING);
				EXPECT_NEAR(1, fabs(frame.getBasis().getColumn(1).z()), ROUNDING);
				EXPECT_NEAR(1, frame.getBasis().determinant(), ROUNDING);
				const btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel();
				const btElasticPlasticCapacity capacity = Bonding::capacityOf(face, steel);
				expectClose(0.8 * double(steel.m_yieldStress), capacity.m_yield[BT_EP_AXIAL], 1e-4);
			}
}

TEST(Bonding, WhatDoesNotTouchIsNotJoined)
{
	World world(Solver::Direct);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	world.body(1, cube, at(0));
	world.body(1, cube, at(btScalar(1.01)));  // a gap that is too large
	world.body(1, cube, at(0, 1, 1));         // an edge
	world.body(1, cube, at(-1, -1, -1));      // a corner
	world.body(0, cube, at(0, 10));
	world.body(0, cube, at(1, 10));  // two that do not move
	world.body(1, world.keep(new btSphereShape(1)), at(0, 0, btScalar(-1.5)));
	world.body(1, cube, at(20));
	world.body(1, cube, btTransform(btQuaternion(btVector3(0, 0, 1), btScalar(0.3)), btVector3(20, btScalar(1.1), 0)));
	EXPECT_EQ(0, facesOf(world).size());
	Faces faces;
	for (btScalar bad : {btScalar(0), btScalar(-1), btScalar(NAN), btScalar(INFINITY)})
		EXPECT_FALSE(Bonding::findFaces(pointersTo(world).data(), 8, bad, faces));
}

TEST(Bonding, SquaresAreDrawnByTheirSides)
{
	// They have no principal axes: rounding turned them by anything, and by 45 degrees they bore 1.41 times as much about a side.
	for (int i = 0; i < 100; ++i)
	{
		World world(Solver::Direct);
		const btTransform place(btQuaternion(btVector3(1, btScalar(0.1 * i), -2).normalized(), btScalar(0.37 * i)),
								btVector3(btScalar(i), -3, 5));
		world.body(5, world.box(btVector3(1, btScalar(0.2), btScalar(0.2))), place * at(0));
		world.body(5, world.box(btVector3(1, btScalar(0.2), btScalar(0.2))), place * at(1));
		const Faces faces = facesOf(world);
		ASSERT_EQ(1, faces.size());
		EXPECT_NEAR(0.2, faces[0].m_height, 0.001);
		const btVector3 y = (place.inverse() * faces[0].m_frame).getBasis().getColumn(1);
		EXPECT_NEAR(1, btMax(btFabs(y.y()), btFabs(y.z())), byPrecision(1e-9, 1e-4)) << i;
	}
}

TEST(Bonding, AMaterialThatIsNoneIsRefused)
{
	World world(Solver::Direct);
	world.body(5, world.box(btVector3(1, 1, 1)), at(0));
	world.body(5, world.box(btVector3(1, 1, 1)), at(1));
	const std::vector<btRigidBody*> bodies = pointersTo(world);
	btAlignedObjectArray<btElasticPlastic6DofSpring2Constraint*> joints;
	EXPECT_FALSE(Bonding::joinAll(world.bullet(), world.action(), bodies.data(), int(bodies.size()), GAP,
								  btElasticPlasticReadyMaterial::find("unobtainium"), joints));
	EXPECT_EQ(0, joints.size());
	EXPECT_EQ(0, world.bullet().getNumConstraints());
}

TEST(Bonding, VoxelsAreJoinedToTheirNeighbours)
{
	for (const btTransform& place : places())
	{
		World world(Solver::Direct);
		btCollisionShape* cube = world.box(btVector3(1, 1, 1) * btScalar(0.5));
		const int n = 4;
		for (int i = 0; i < n * n * n; ++i)
			world.body(1, cube, place * at(btScalar(i % n), btScalar(i / n % n), btScalar(i / n / n)));
		EXPECT_EQ(0, facesOf(world).size());
		for (int i = 0; i < n * n * n; ++i)
			world.bodies()[size_t(i)]->setCenterOfMassTransform(place * at(btScalar(0.5) * btScalar(i % n),
																		   btScalar(0.5) * btScalar(i / n % n),
																		   btScalar(0.5) * btScalar(i / n / n)));
		const Faces faces = facesOf(world);
		ASSERT_EQ(3 * n * n * (n - 1), faces.size());
		for (int i = 0; i < faces.size(); ++i)
			EXPECT_NEAR(0.25, faces[i].m_area, ROUNDING);
	}
}

TEST(Bonding, PiecesOfAFracturedBlockFillItsSection)
{
	for (const btTransform& place : places())
	{
		// A cube of 2 m, cut by its middle plane across x; one half in four wedges that meet in an axis along x, the other whole.
		World world(Solver::Direct);
		for (int i = 0; i < 4; ++i)
		{
			btConvexHullShape* wedge = new btConvexHullShape;
			wedge->setMargin(0);
			const btScalar y[5] = {1, -1, -1, 1, 1}, z[5] = {1, 1, -1, -1, 1};
			for (btScalar x : {btScalar(-0.5), btScalar(0.5)})
			{
				wedge->addPoint(btVector3(x, 0, 0));
				wedge->addPoint(btVector3(x, y[i], z[i]));
				wedge->addPoint(btVector3(x, y[i + 1], z[i + 1]));
			}
			world.body(1, world.keep(wedge), place * at(btScalar(-0.5)));
		}
		world.body(4, world.box(btVector3(1, 2, 2)), place * at(btScalar(0.5)));
		const Faces faces = facesOf(world);
		// Each wedge touches two others and the whole half.
		ASSERT_EQ(8, faces.size());
		double across = 0, between = 0;
		for (int i = 0; i < faces.size(); ++i)
			if (faces[i].m_bodyB == world.bodies()[4].get())
			{
				across += double(faces[i].m_area);
				// A right-angled triangle with legs of root 2: second moments a^4 / 24 and a^4 / 72 about its middle.
				EXPECT_NEAR(sqrt(3.), faces[i].m_height / faces[i].m_width, 1e-3);
			}
			else
				between += double(faces[i].m_area);
		EXPECT_NEAR(4, across, 4 * ROUNDING);
		EXPECT_NEAR(4 * sqrt(2.), between, 6 * ROUNDING);
	}
}

TEST(Bonding, CompoundsAreJoinedByTheirChildren)
{
	World world(Solver::Direct);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btCompoundShape* table = new btCompoundShape;
	table->addChildShape(at(btScalar(-1.5)), cube);
	table->addChildShape(at(btScalar(1.5)), cube);
	world.body(0, world.box(btVector3(10, 1, 1)), at(0, -1));
	world.body(5, world.keep(table), at(0));
	const Faces faces = facesOf(world);
	ASSERT_EQ(2, faces.size());
	EXPECT_NEAR(1.5, fabs(faces[0].m_frame.getOrigin().x()), ROUNDING);
}

TEST(Bonding, BrickWithFibresHangsByItsStrengthInTension)
{
	const btElasticPlasticMaterial brick = btElasticPlasticReadyMaterial::find("clay brick");
	// 0.1 MPa on 1 m^2, against 5 MPa in compression.
	const double strength = double(brick.m_tensileShare * brick.m_yieldStress);
	for (const double share : {0.98, 1.02})
	{
		World world(Solver::Direct);
		btCollisionShape* const cube = world.box(btVector3(1, 1, 1));
		world.body(0, cube, at(0));
		world.body(btScalar(share * strength / 10), cube, at(0, -1));
		const Faces faces = facesOf(world);
		ASSERT_EQ(1, faces.size());
		const btElasticPlasticSection section =
			btElasticPlasticSection::rectangle(faces[0].m_width, faces[0].m_height).withFibres();
		const std::unique_ptr<btElasticPlastic6DofSpring2Constraint> joint(Bonding::join(
			faces[0], btElasticPlasticCapacity::fromMember(brick, section, faces[0].m_lengthA, faces[0].m_lengthB)));
		world.bullet().addConstraint(joint.get(), true);
		ASSERT_TRUE(world.action().addJoint(joint.get()));
		run(world, 240);
		EXPECT_EQ(share > 1, joint->isBroken()) << share;
		if (!joint->isBroken())
			world.bullet().removeConstraint(joint.get());
	}
}

TEST(Bonding, AJoinedWallStandsAndFallsWhenItIsWeakened)
{
	World world(Solver::Direct);
	world.body(0, world.box(btVector3(10, 1, 1)), at(0, btScalar(-0.5)));
	btCollisionShape* brick = world.box(btVector3(1, btScalar(0.5), btScalar(0.5)));
	for (int row = 0; row < 4; ++row)
		for (int i = 0; i < 4; ++i)
			world.body(600, brick,
					   at(btScalar(i) + (row % 2 ? btScalar(0.5) : btScalar(0)), btScalar(0.25 + 0.5 * row)));
	const std::vector<btRigidBody*> bodies = pointersTo(world);
	btAlignedObjectArray<btElasticPlastic6DofSpring2Constraint*> joints;
	btElasticPlasticMaterial mortar;
	mortar.m_youngsModulus = btScalar(5e9);
	mortar.m_yieldStress = btScalar(0.5e6);
	mortar.m_ultimatePlasticStrain = btScalar(0.001);
	// What the caller has already stays his.
	joints.push_back(nullptr);
	EXPECT_FALSE(
		Bonding::joinAll(world.bullet(), world.action(), bodies.data(), int(bodies.size()), 0, mortar, joints));
	EXPECT_EQ(1, joints.size());
	ASSERT_TRUE(
		Bonding::joinAll(world.bullet(), world.action(), bodies.data(), int(bodies.size()), GAP, mortar, joints));
	ASSERT_EQ(nullptr, joints[0]);
	joints.remove(nullptr);
	std::vector<std::unique_ptr<btElasticPlastic6DofSpring2Constraint>> owners;
	for (int i = 0; i < joints.size(); ++i)
		owners.emplace_back(joints[i]);
	// On the ground 4, beside each other 3 in each row, and between rows 7.
	EXPECT_EQ(4 + 4 * 3 + 3 * 7, joints.size());
	EXPECT_EQ(joints.size(), world.action().getNumJoints());
	run(world, 60);
	double weight = 0;
	for (int i = 0; i < joints.size(); ++i)
	{
		EXPECT_FALSE(joints[i]->hasYielded());
		if (&joints[i]->getRigidBodyA() == bodies[0])
			weight -= double(joints[i]->getForce(BT_EP_AXIAL));
	}
	// The ground's joints bear the 16 bricks: x points up, from the ground to them.
	EXPECT_NEAR(16 * 600 * 10, weight, 0.01 * 96000);
	for (int i = 0; i < joints.size(); ++i)
	{
		btElasticPlasticCapacity weak = joints[i]->getCapacity();
		weak.scaleYield(btScalar(1e-3));
		joints[i]->setCapacity(weak);
	}
	bodies[15]->applyCentralImpulse(btVector3(0, 0, 3000));
	run(world, 120);
	EXPECT_GT(world.action().getNumBroken(), 0);
	for (int i = 0; i < joints.size(); ++i)
	{
		world.bullet().removeConstraint(joints[i]);
		world.action().removeJoint(joints[i]);
	}
}

TEST(Bonding, BodiesThatAreNoneOrNowhereAreRefused)
{
	World world(Solver::Direct);
	btCollisionShape* const cube = world.box(btVector3(1, 1, 1));
	btRigidBody* bodies[3] = {world.body(5, cube, at(0)), world.body(5, cube, at(1)), world.body(5, cube, at(2))};
	btTransform nowhere = at(1);
	nowhere.getOrigin().setX(std::numeric_limits<btScalar>::quiet_NaN());
	Faces faces;
	bodies[1]->setWorldTransform(nowhere);
	EXPECT_FALSE(Bonding::findFaces(bodies, 3, GAP, faces));
	EXPECT_EQ(0, faces.size());
	bodies[1] = nullptr;
	EXPECT_FALSE(Bonding::findFaces(bodies, 3, GAP, faces));
	EXPECT_EQ(0, faces.size());
}
}  // namespace testBonding
