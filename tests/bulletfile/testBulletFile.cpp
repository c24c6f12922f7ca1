// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Worlds in Bullet's own files: loaded by Bullet alone, and with elastic-plastic joints put back.

#include <math.h>
#include <string.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/bulletfile/JointBlock.h"
#include "BulletDynamics/ConstraintSolver/ElasticPlastic/snapshot/Archive.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlastic6DofSpring2Constraint.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticBulletFile.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "BulletWorldImporter/btBulletWorldImporter.h"
#include "LinearMath/btSerializer.h"
#include "support/Layout.h"
#include "support/Precision.h"
#include "support/Repeats.h"
#include "support/Run.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testBulletFile
{
using namespace ep;

typedef std::vector<char> Bytes;

/// A beam of blocks out of a wall, bent by its weight and a blow, with joints of both classes. One has fibres, one a hinge of
/// Bullet's class beside its capacity. Between the last two blocks is a constraint of Bullet's own.
struct Beam
{
	World m_world{Solver::Direct};
	std::vector<btRigidBody*> m_blocks;
	std::vector<btElasticPlasticJoint*> m_joints;

	Beam()
	{
		btCollisionShape* const cube = m_world.box(btVector3(1, 1, 1));
		for (int i = 0; i < 5; ++i)
			m_blocks.push_back(m_world.body(i == 0 ? 0 : btScalar(100), cube, at(btScalar(i)), false));
		const btElasticPlasticCapacity rod = btElasticPlasticCapacity::fromRod(
			btElasticPlasticMaterial::steel(200e6),
			btElasticPlasticSection::rectangle(btScalar(0.06), btScalar(0.06)).withFibres(16), 1);
		btElasticPlasticCapacity hinge = evenCapacity(1e7, 1e5);
		hinge.clear(BT_EP_TORSION);
		m_joints = {m_world.joint(*m_blocks[0], *m_blocks[1], at(0.5), evenCapacity(1e6, 7e3), JointClass::Spring2),
					m_world.joint(*m_blocks[1], *m_blocks[2], at(1.5), rod, JointClass::Spring2)};
		auto* const ball = new btPoint2PointConstraint(*m_blocks[3], *m_blocks[4], btVector3(btScalar(0.5), 0, 0),
													   btVector3(btScalar(-0.5), 0, 0));
		m_world.add(ball);
		m_joints.push_back(m_world.joint(*m_blocks[2], *m_blocks[3], at(2.5), hinge, JointClass::Spring));
		static_cast<btGeneric6DofSpringConstraint&>(m_joints[2]->getConstraint())
			.setLimit(BT_EP_TORSION, btScalar(-0.1), btScalar(0.2));
		m_joints[0]->setName("at the wall");
		m_joints[0]->setLevel(BT_EP_QUANTITY_DAMAGE, btScalar(0.5));
		m_joints[1]->getConstraint().setUserConstraintId(7);
		m_joints[1]->getConstraint().setBreakingImpulseThreshold(btScalar(1e8));
		m_blocks[3]->setLinearVelocity(btVector3(0, -1, 1));
		run(m_world, 30, btScalar(1) / 120);
	}

	Bytes write()
	{
		btDefaultSerializer serializer;
		m_world.bullet().serialize(&serializer);
		const char* const begin = reinterpret_cast<const char*>(serializer.getBufferPointer());
		return Bytes(begin, begin + serializer.getCurrentBufferSize());
	}
};

/// A world as a game has it that loads a file.
struct Loaded
{
	btDefaultCollisionConfiguration m_configuration;
	btCollisionDispatcher m_dispatcher{&m_configuration};
	btDbvtBroadphase m_broadphase;
	btElasticPlasticConstraintSolver m_solver;
	btDiscreteDynamicsWorld m_world{&m_dispatcher, &m_broadphase, &m_solver, &m_configuration};
	btElasticPlasticAction m_action;
	btBulletWorldImporter m_importer{&m_world};
	btAlignedObjectArray<btTypedConstraint*> m_made;

	explicit Loaded(const Bytes& bytes)
	{
		m_world.addAction(&m_action);
		Bytes own = bytes;
		EXPECT_TRUE(m_importer.loadFileFromMemory(own.data(), int(own.size())));
	}
	~Loaded()
	{
		for (int i = 0; i < m_made.size(); ++i)
		{
			m_world.removeConstraint(m_made[i]);
			delete m_made[i];
		}
		m_importer.deleteAllData();
		m_world.removeAction(&m_action);
	}

	btElasticPlasticFault import(const Bytes& bytes)
	{
		return btElasticPlasticImport(m_world, m_action, bytes.data(), int(bytes.size()), m_made);
	}
	void run(int steps)
	{
		for (int i = 0; i < steps; ++i)
			m_world.stepSimulation(btScalar(1) / 120, 0);
	}
};

void expectSame(const btElasticPlasticJoint& was, const btElasticPlasticJoint& is)
{
	const btElasticPlasticState &a = was.getState(), &b = is.getState();
	EXPECT_TRUE(was.getCapacity().isSameAs(is.getCapacity()));
	EXPECT_EQ(was.getScheme(), is.getScheme());
	EXPECT_STREQ(was.getName(), is.getName());
	for (int q = 0; q < BT_EP_QUANTITY_COUNT; ++q)
		EXPECT_EQ(was.getLevel(btElasticPlasticQuantity(q)), is.getLevel(btElasticPlasticQuantity(q)));
	EXPECT_TRUE(a.m_plasticRotation == b.m_plasticRotation);
	EXPECT_TRUE(a.m_plasticMiddle == b.m_plasticMiddle);
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		EXPECT_EQ(a.m_plastic[i], b.m_plastic[i]);
		EXPECT_EQ(a.m_force[i], b.m_force[i]);
		EXPECT_EQ(a.m_forceRate[i], b.m_forceRate[i]);
		EXPECT_EQ(a.m_withheld[i], b.m_withheld[i]);
		EXPECT_EQ(a.m_applied[i], b.m_applied[i]);
		EXPECT_EQ(a.m_plasticPath[i], b.m_plasticPath[i]);
		EXPECT_EQ(a.m_watched[i], b.m_watched[i]);
	}
	for (int i = 0; i < 3; ++i)
		EXPECT_EQ(a.m_initial[i], b.m_initial[i]);
	EXPECT_EQ(a.m_work, b.m_work);
	EXPECT_EQ(a.m_plasticEnergy, b.m_plasticEnergy);
	EXPECT_EQ(a.m_lastStep, b.m_lastStep);
	EXPECT_EQ(a.m_yielded, b.m_yielded);
	EXPECT_EQ(a.m_solvedExactly, b.m_solvedExactly);
	ASSERT_EQ(a.m_fibres.size(), b.m_fibres.size());
	for (int i = 0; i < a.m_fibres.size(); ++i)
	{
		EXPECT_EQ(a.m_fibres[i].m_force, b.m_fibres[i].m_force);
		EXPECT_EQ(a.m_fibres[i].m_offset, b.m_fibres[i].m_offset);
		EXPECT_EQ(a.m_fibres[i].m_damage, b.m_fibres[i].m_damage);
	}
}

TEST(BulletFile, BulletLoadsJointsAsItsOwn)
{
	Beam beam;
	ASSERT_TRUE(beam.m_joints[0]->hasYielded());
	ASSERT_TRUE(beam.m_joints[1]->getCapacity().hasFibres());
	Loaded loaded(beam.write());
	ASSERT_EQ(4, loaded.m_world.getNumConstraints());
	const int types[4] = {D6_SPRING_2_CONSTRAINT_TYPE, D6_SPRING_2_CONSTRAINT_TYPE, POINT2POINT_CONSTRAINT_TYPE,
						  D6_SPRING_CONSTRAINT_TYPE};
	for (int i = 0; i < 4; ++i)
	{
		EXPECT_EQ(types[i], loaded.m_world.getConstraint(i)->getConstraintType());
		EXPECT_EQ(nullptr, btElasticPlasticJoint::from(loaded.m_world.getConstraint(i)));
	}
	auto& hinge = static_cast<btGeneric6DofSpringConstraint&>(*loaded.m_world.getConstraint(3));
	EXPECT_EQ(btScalar(-0.1), hinge.getRotationalLimitMotor(0)->m_loLimit);
	EXPECT_EQ(btScalar(0.2), hinge.getRotationalLimitMotor(0)->m_hiLimit);

	// Bullet's constraints hold the beam as it is bent: without load its first block is turned by what is plastic.
	loaded.m_world.setGravity(btVector3(0, 0, 0));
	loaded.run(600);
	const btTransform& first = loaded.m_world.getCollisionObjectArray()[1]->getWorldTransform();
	const btVector3 turn = first.getRotation().getAxis() * first.getRotation().getAngleShortestPath();
	ASSERT_GT(fabs(double(beam.m_joints[0]->getPlasticDeformation(BT_EP_BENDING_Z))), 0.03);
	for (int i = 0; i < 3; ++i)
		EXPECT_NEAR(double(beam.m_joints[0]->getPlasticDeformation(3 + i)), double(turn[i]), 1e-3) << i;
}

TEST(BulletFile, JointsAreRestoredAndGoOn)
{
	Beam beam;
	const Bytes bytes = beam.write();
	Loaded loaded(bytes);
	const btElasticPlasticFault fault = loaded.import(bytes);
	ASSERT_FALSE(fault) << fault.m_quantity;
	ASSERT_EQ(3, loaded.m_made.size());
	ASSERT_EQ(4, loaded.m_world.getNumConstraints());
	EXPECT_EQ(3, loaded.m_action.getNumJoints());
	const int places[3] = {0, 1, 3};
	for (int i = 0; i < 3; ++i)
	{
		btTypedConstraint* const constraint = loaded.m_world.getConstraint(places[i]);
		ASSERT_EQ(loaded.m_made[i], constraint);
		ASSERT_NE(nullptr, btElasticPlasticJoint::from(constraint));
		expectSame(*beam.m_joints[size_t(i)], *btElasticPlasticJoint::from(constraint));
		const btTypedConstraint& was = beam.m_joints[size_t(i)]->getConstraint();
		EXPECT_EQ(was.getConstraintType(), constraint->getConstraintType());
		EXPECT_EQ(was.getUserConstraintId(), constraint->getUserConstraintId());
		EXPECT_EQ(was.getBreakingImpulseThreshold(), constraint->getBreakingImpulseThreshold());
	}
	EXPECT_EQ(POINT2POINT_CONSTRAINT_TYPE, loaded.m_world.getConstraint(2)->getConstraintType());

	// Bullet's importer brings bodies to rest, and shapes, which make inertia, come in single precision.
	for (int i = 0; i < 5; ++i)
	{
		btRigidBody& body = *btRigidBody::upcast(loaded.m_world.getCollisionObjectArray()[i]);
		body.setLinearVelocity(beam.m_blocks[size_t(i)]->getLinearVelocity());
		body.setAngularVelocity(beam.m_blocks[size_t(i)]->getAngularVelocity());
		body.setDamping(0, 0);
		if (i > 0)
			body.setMassProps(100, beam.m_blocks[size_t(i)]->getLocalInertia());
		body.updateInertiaTensor();
	}
	loaded.run(60);
	run(beam.m_world, 60, btScalar(1) / 120);
	for (int i = 0; i < 5; ++i)
		EXPECT_LT(double((loaded.m_world.getCollisionObjectArray()[i]->getWorldTransform().getOrigin() -
						  beam.m_blocks[size_t(i)]->getCenterOfMassPosition())
							 .length()),
				  byPrecision(1e-12, 1e-4))
			<< i;
}

TEST(BulletFile, ASecondFileComesBesideWhatIsThere)
{
	Beam beam;
	const Bytes bytes = beam.write();
	Loaded loaded(bytes);
	ASSERT_FALSE(loaded.import(bytes));
	Bytes own = bytes;
	ASSERT_TRUE(loaded.m_importer.loadFileFromMemory(own.data(), int(own.size())));
	EXPECT_FALSE(
		btElasticPlasticImport(loaded.m_world, loaded.m_action, bytes.data(), int(bytes.size()), loaded.m_made, 4));
	EXPECT_EQ(6, loaded.m_made.size());
	EXPECT_EQ(8, loaded.m_world.getNumConstraints());
}

TEST(BulletFile, WhatIsNoFileOfTheWorldIsRefused)
{
	Beam beam;
	const Bytes bytes = beam.write();
	Loaded loaded(bytes);
	const auto expectRefused = [&loaded](const Bytes& file, int first, const char* what)
	{
		EXPECT_TRUE(btElasticPlasticImport(loaded.m_world, loaded.m_action, file.data(), int(file.size()),
										   loaded.m_made, first))
			<< what;
		EXPECT_EQ(0, loaded.m_made.size()) << what;
		EXPECT_EQ(4, loaded.m_world.getNumConstraints()) << what;
		EXPECT_EQ(0, loaded.m_action.getNumJoints()) << what;
	};
	expectRefused(Bytes(), 0, "nothing");
	expectRefused(bytes, 1, "another first constraint");
	expectRefused(bytes, -1, "no first constraint");
	for (size_t size = 0; size < bytes.size(); size += size < 4000 ? 1 : 101)
		expectRefused(Bytes(bytes.begin(), bytes.begin() + long(size)), 0, "a part");
	Beam other;
	other.m_world.action().breakJoint(other.m_world.bullet(), other.m_joints[1]);
	expectRefused(other.write(), 0, "a file of another world");
}

/// Where the version of the first joint in a file stands.
char* versionIn(Bytes& file)
{
	const std::string mark = "btEPjoin";
	return &*std::search(file.begin(), file.end(), mark.begin(), mark.end()) + mark.size();
}

uint32_t versionOf(Bytes& file)
{
	uint32_t version;
	memcpy(&version, versionIn(file), sizeof version);
	return version;
}

TEST(BulletFile, JointsOfAnotherVersionAreRefused)
{
	Beam beam;
	Bytes bytes = beam.write();
	Loaded loaded(bytes);
	const uint32_t version = versionOf(bytes);
	for (const uint32_t other : {uint32_t(0), version - 1, version + 1})
	{
		Bytes file = bytes;
		memcpy(versionIn(file), &other, sizeof other);
		const btElasticPlasticFault fault = loaded.import(file);
		ASSERT_TRUE(fault);
		EXPECT_STREQ("version of a joint in the file", fault.m_quantity);
		EXPECT_EQ(other, uint32_t(fault.m_value));
		EXPECT_STREQ("the one that this library writes", fault.m_range);
		EXPECT_EQ(0, loaded.m_made.size());
		EXPECT_EQ(4, loaded.m_world.getNumConstraints());
	}
	EXPECT_FALSE(loaded.import(bytes));
}

/// Joints of before are refused by their version alone. So who changes what is written of one raises the version in JointBlock.cpp, and
/// then writes both down here.
TEST(BulletFile, HasANewVersionForANewLayout)
{
	Bytes bytes = Beam().write();
	EXPECT_EQ(12u, versionOf(bytes));
	const uint64_t layout = sizeof(btScalar) == sizeof(double) ? 5380237951107593429u : 3763981478121941537u;
	EXPECT_EQ(layout, btElasticPlastic::layoutOf<btElasticPlastic::JointBlock>());
}

/// Bullet's importer loads no constraint of our classes that joins one body to the world, but one of Bullet's own.
TEST(BulletFile, WhatIsJoinedToTheWorldItselfIsLeftOut)
{
	Beam beam;
	auto* const toWorld = new btElasticPlastic6DofSpring2Constraint(*beam.m_blocks[4], at(btScalar(0.5)));
	toWorld->setCapacity(evenCapacity(1e6, 7e3));
	beam.m_world.bullet().addConstraint(toWorld);
	beam.m_world.action().addJoint(toWorld);
	auto* const hung = new btPoint2PointConstraint(*beam.m_blocks[2], btVector3(0, 0, 0));
	beam.m_world.bullet().addConstraint(hung);
	btElasticPlasticJoint* const last =
		beam.m_world.joint(*beam.m_blocks[1], *beam.m_blocks[3], at(2), evenCapacity(1e4, 1e3), JointClass::Spring2);
	const Bytes bytes = beam.write();
	Loaded loaded(bytes);
	EXPECT_EQ(6, loaded.m_world.getNumConstraints());
	ASSERT_FALSE(loaded.import(bytes));
	EXPECT_EQ(6, loaded.m_world.getNumConstraints());
	ASSERT_EQ(4, loaded.m_made.size());
	expectSame(*beam.m_joints[0], *btElasticPlasticJoint::from(loaded.m_made[0]));
	expectSame(*last, *btElasticPlasticJoint::from(loaded.m_made[3]));
	for (btTypedConstraint* const constraint :
		 {static_cast<btTypedConstraint*>(toWorld), static_cast<btTypedConstraint*>(hung)})
	{
		beam.m_world.bullet().removeConstraint(constraint);
		delete constraint;
	}
}

/// The first joint in a file with something else in it, and a checksum that is right.
Bytes forge(const Bytes& bytes, std::mt19937& random)
{
	Bytes file = bytes;
	const std::string mark = "btEPjoin";
	std::vector<char*> blocks;
	for (auto at = file.begin(); (at = std::search(at, file.end(), mark.begin(), mark.end())) != file.end(); ++at)
		blocks.push_back(&*at);
	char* const block = blocks[random() % blocks.size()];
	uint32_t size;
	memcpy(&size, block + 12, sizeof size);
	char* const body = block + 24;
	for (unsigned n = 1 + random() % 3; n > 0; --n)
	{
		const double numbers[] = {std::numeric_limits<double>::quiet_NaN(),
								  std::numeric_limits<double>::infinity(),
								  -1,
								  0,
								  1e300,
								  -1e300,
								  1e-310,
								  1e30,
								  1,
								  1e-30};
		const int counts[] = {-1, 0, 1, 15, 16, 17, 100000, 0x7fffffff, -0x7fffffff - 1};
		const size_t place = random() % (size - 8);
		switch (random() % 4)
		{
			case 0:
				body[place] ^= char(1 << random() % 8);
				break;
			case 1:
				memcpy(body + place, &numbers[random() % 10], 8);
				break;
			case 2:
				memcpy(body + place / 8 * 8, &numbers[random() % 10], 8);
				break;
			default:
				memcpy(body + place / 4 * 4, &counts[random() % 9], 4);
		}
	}
	const uint64_t sum = btElasticPlastic::checksumOf(reinterpret_cast<unsigned char*>(body), size);
	memcpy(block + 16, &sum, sizeof sum);
	return file;
}

TEST(BulletFile, ForgedJointsAreRefusedOrJoints)
{
	const Bytes bytes = Beam().write();
	std::mt19937 random(2);
	std::unique_ptr<Loaded> loaded;
	int taken = 0, all = repeats(100000, 2000);
	for (int i = 0; i < all; ++i)
	{
		if (!loaded)
			loaded.reset(new Loaded(bytes));
		if (loaded->import(forge(bytes, random)))
		{
			ASSERT_EQ(0, loaded->m_made.size());
			ASSERT_EQ(4, loaded->m_world.getNumConstraints());
			continue;
		}
		++taken;
		loaded->run(3);
		for (int k = 0; k < loaded->m_world.getNumCollisionObjects(); ++k)
		{
			// There may be the action's own object, too.
			const btRigidBody* const body = btRigidBody::upcast(loaded->m_world.getCollisionObjectArray()[k]);
			ASSERT_TRUE(!body || isFinite(*body)) << i;
		}
		for (int j = 0; j < loaded->m_made.size(); ++j)
		{
			btElasticPlasticJoint* const joint = btElasticPlasticJoint::from(loaded->m_made[j]);
			ASSERT_TRUE(joint->setState(joint->getState())) << i;
		}
		loaded.reset();
	}
	EXPECT_GT(taken, 0);
	EXPECT_LT(taken, all);
}

TEST(BulletFile, NothingThatIsSpoiltChangesAJoint)
{
	// A joint that is taken is the one that was written, whatever has become of the file.
	Beam beam;
	const Bytes bytes = beam.write();
	std::mt19937 random(1);
	int taken = 0;
	for (int i = 0; i < 300; ++i)
	{
		Loaded loaded(bytes);
		Bytes spoilt = bytes;
		for (unsigned n = random() % 3; n < 3; ++n)
			// What comes after the joints is the description of types, which is not read.
			spoilt[random() % 12000 % spoilt.size()] ^= char(1 << random() % 8);
		if (loaded.import(spoilt))
		{
			EXPECT_EQ(0, loaded.m_made.size());
			EXPECT_EQ(4, loaded.m_world.getNumConstraints());
			continue;
		}
		++taken;
		for (int j = 0; j < loaded.m_made.size(); ++j)
			for (const btElasticPlasticJoint* joint : beam.m_joints)
				if (joint->getState().m_work == btElasticPlasticJoint::from(loaded.m_made[j])->getState().m_work)
					expectSame(*joint, *btElasticPlasticJoint::from(loaded.m_made[j]));
	}
	EXPECT_GT(taken, 0);
	EXPECT_LT(taken, 300);
}
}  // namespace testBulletFile
