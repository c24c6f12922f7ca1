// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What a joint tells of itself where it has no part in the simulation, and where it refuses what it is given.

#include <math.h>

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/Pair.h"

namespace testMessages
{
using namespace ep;

struct Refusals : btElasticPlasticListener
{
	std::vector<std::string> m_texts;

	void onRefused(btElasticPlasticJoint&, const char* text) override { m_texts.push_back(text); }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string printed(const btElasticPlasticJoint& joint)
{
	char text[300];
	joint.printFault(text, sizeof text);
	return text;
}

TEST(Messages, TheFaultIsThatOfTheStep)
{
	const struct
	{
		std::function<void(World&, btRigidBody&)> m_spoil, m_mend;
		const char* m_names;
	} cases[] = {{[](World& w, btRigidBody& b) { w.bullet().removeRigidBody(&b); },
				  [](World& w, btRigidBody& b) { w.bullet().addRigidBody(&b); }, "addRigidBody"},
				 {[](World&, btRigidBody& b) { b.setAngularVelocity(btVector3(0, btScalar(NAN), 0)); },
				  [](World&, btRigidBody& b) { b.setAngularVelocity(btVector3(0, 0, 0)); }, "velocity"},
				 {[](World&, btRigidBody& b) { b.setMassProps(12, btVector3(0, 0, 0)); },
				  [](World&, btRigidBody& b) { b.setMassProps(12, btVector3(2, 2, 2)); }, "inertia"}};
	for (const auto& c : cases)
		for (Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
			for (bool isA : {true, false})
			{
				SCOPED_TRACE(std::string(c.m_names) + (isA ? ", body A" : ", body B") + ", solver " +
							 std::to_string(int(solver)));
				Refusals refusals;
				Pair pair(solver, 12, 12);
				pair.m_world.action().setListener(&refusals);
				btElasticPlasticJoint* joint = pair.join(evenCapacity(1e6, 1e5));
				run(pair.m_world, 2);
				EXPECT_FALSE(joint->fault()) << printed(*joint);
				btRigidBody& spoilt = isA ? *pair.m_a : *pair.m_b;
				c.m_spoil(pair.m_world, spoilt);
				for (int i = 0; i < 4; ++i)
				{
					run(pair.m_world, 1);
					EXPECT_TRUE(bool(joint->fault()));
					EXPECT_TRUE(contains(printed(*joint), isA ? "body A" : "body B")) << printed(*joint);
					EXPECT_TRUE(contains(printed(*joint), c.m_names)) << printed(*joint);
				}
				EXPECT_EQ(1u, refusals.m_texts.size());
				c.m_mend(pair.m_world, spoilt);
				run(pair.m_world, 1);
				EXPECT_FALSE(joint->fault()) << printed(*joint);
				EXPECT_EQ(6, joint->getNumCommittedRows());
			}
}

TEST(Messages, ARefusedStateIsNamedWithItsRange)
{
	const struct
	{
		std::function<void(btElasticPlasticState&)> m_spoil;
		std::vector<const char*> m_names;
	} cases[] = {
		{[](btElasticPlasticState& s) { s.m_force[1] = btScalar(1e12); }, {"force", "shear y", "1e+12", "yield value"}},
		{[](btElasticPlasticState& s) { s.m_force[4] = btScalar(NAN); }, {"force", "bending y", "nan", "finite"}},
		{[](btElasticPlasticState& s) { s.m_watched[2] = btScalar(NAN); },
		 {"watched deformation", "shear z", "nan", "finite"}},
		{[](btElasticPlasticState& s) { s.m_plasticPath[0] = -2; }, {"plastic path", "axial", "-2", "not negative"}},
		{[](btElasticPlasticState& s) { s.m_plasticRotation = btQuaternion(0, 0, 0, 2); }, {"rotation", "2", "1"}},
		{[](btElasticPlasticState& s) { s.m_plasticEnergy = -3; }, {"plastic energy [J]", "-3", "not negative"}},
		{[](btElasticPlasticState& s) { s.m_work = INFINITY; }, {"work [J]", "inf", "finite"}},
		{[](btElasticPlasticState& s) { s.m_lastStep = -4; }, {"last step [s]", "-4", "not negative"}}};
	for (const auto& c : cases)
	{
		Refusals refusals;
		Pair pair;
		pair.m_world.action().setListener(&refusals);
		btElasticPlasticJoint* joint = pair.join(evenCapacity(1e6, 1e5));
		joint->setName("gate");
		btElasticPlasticState state = joint->getState();
		c.m_spoil(state);
		EXPECT_FALSE(joint->setState(state));
		ASSERT_EQ(1u, refusals.m_texts.size());
		for (const char* name : c.m_names)
			EXPECT_TRUE(contains(refusals.m_texts[0], name)) << refusals.m_texts[0];
		EXPECT_TRUE(contains(refusals.m_texts[0], "'gate'")) << refusals.m_texts[0];
		// The joint itself has no fault.
		EXPECT_FALSE(joint->fault());
		EXPECT_TRUE(joint->setState(joint->getState()));
		EXPECT_EQ(1u, refusals.m_texts.size());
	}
}

TEST(Messages, LeaveOutWhatIsNotSet)
{
	Pair pair;
	btElasticPlasticJoint* joint = pair.join(evenCapacity(1e6, 1e5));
	EXPECT_EQ("joint at (0.5, 0, 0): no fault", printed(*joint));
	joint->setName("gate");
	EXPECT_EQ("joint 'gate' at (0.5, 0, 0): no fault", printed(*joint));
	joint->getConstraint().setUserConstraintId(7);
	EXPECT_EQ("joint 'gate' (id 7) at (0.5, 0, 0): no fault", printed(*joint));
	joint->setName("");
	EXPECT_EQ("joint (id 7) at (0.5, 0, 0): no fault", printed(*joint));
}
/// A multibody's link as a joint sees it that was given one by a cast from btCollisionObject. Its own memory is that of a rigid body.
struct CastLink : btRigidBody
{
	explicit CastLink(btCollisionShape& shape) : btRigidBody(1, nullptr, &shape, btVector3(1, 1, 1))
	{
		m_internalType = CO_FEATHERSTONE_LINK;
	}
};

TEST(Messages, AJointToALinkIsRefused)
{
	for (bool isA : {true, false})
	{
		Refusals refusals;
		Pair pair(Solver::Direct, 12, 12);
		World& world = pair.m_world;
		world.action().setListener(&refusals);
		btBoxShape shape(btVector3(1, 1, 1));
		CastLink link(shape);
		btElasticPlastic6DofSpring2Constraint joint(isA ? link : *pair.m_a, isA ? *pair.m_a : link,
													btTransform::getIdentity(), btTransform::getIdentity());
		joint.setCapacity(evenCapacity(1e6, 1e5));
		world.bullet().addConstraint(&joint);
		EXPECT_FALSE(world.action().addJoint(&joint));
		ASSERT_EQ(1u, refusals.m_texts.size());
		EXPECT_TRUE(contains(refusals.m_texts[0], isA ? "of body A is 64" : "of body B is 64")) << refusals.m_texts[0];
		EXPECT_TRUE(contains(refusals.m_texts[0], "btMultiBodyFixedConstraint")) << refusals.m_texts[0];
		// Bullet does not see it either.
		run(world, 3);
		EXPECT_EQ(btVector3(0, 0, 0), link.getLinearVelocity());
		world.bullet().removeConstraint(&joint);
	}
}
}  // namespace testMessages
