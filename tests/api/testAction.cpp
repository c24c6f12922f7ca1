// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The bookkeeping: events, removal, repair, order of deletion.

#include <math.h>

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/Row.h"

namespace testAction
{
using namespace ep;

struct Diary : btElasticPlasticListener
{
	std::vector<btElasticPlasticEvent> m_events;
	std::vector<std::string> m_refused;

	void onYield(const btElasticPlasticEvent& e) override { m_events.push_back(e); }
	void onBreak(const btElasticPlasticEvent& e) override { m_events.push_back(e); }
	void onRefused(btElasticPlasticJoint&, const char* text) override { m_refused.push_back(text); }
};

/// Reads all events.
int countEvents(btElasticPlasticAction& action)
{
	btElasticPlasticEvent event;
	int count = 0;
	while (action.popEvent(event))
		++count;
	return count;
}

TEST(Action, ReportsYieldAndBreakOnceInOrder)
{
	Row row(3);
	Diary diary;
	row.m_world.action().setListener(&diary);
	// The middle one is loaded most and breaks first.
	row.m_joints[1]->getConstraint().getRigidBodyB().applyCentralForce(btVector3(0, -500, 0));
	row.run(240);
	ASSERT_EQ(6u, diary.m_events.size());
	int yields = 0;
	for (size_t i = 0; i < diary.m_events.size(); ++i)
	{
		const btElasticPlasticEvent& e = diary.m_events[i];
		yields += e.m_type == BT_EP_EVENT_YIELD;
		EXPECT_EQ(int(BT_EP_AXIAL), e.m_dof);
		EXPECT_EQ(row.m_ceiling, e.m_bodyA);
		EXPECT_EQ(&e.m_joint->getConstraint().getRigidBodyB(), e.m_bodyB);
		EXPECT_NEAR(800, e.m_force.x(), 1e-3);
		EXPECT_NEAR(0, e.m_moment.length(), 1);
		// In time order, and in the order the joints were added within a substep.
		if (i > 0)
		{
			EXPECT_GE(e.m_time, diary.m_events[i - 1].m_time);
			const bool together = e.m_time == diary.m_events[i - 1].m_time && e.m_type == diary.m_events[i - 1].m_type;
			EXPECT_TRUE(!together || e.m_position.x() > diary.m_events[i - 1].m_position.x());
		}
		if (e.m_type != BT_EP_EVENT_BREAK)
			continue;
		// 800 N over 5 cm, and what the spring holds.
		EXPECT_NEAR(800 * 0.05, e.m_energy, 800 * 0.01);
		EXPECT_NEAR(-0.5, e.m_position.y(), 0.1);
		EXPECT_TRUE(e.m_joint->isBroken());
	}
	EXPECT_EQ(3, yields);
}

TEST(Action, KeepsEventsInAQueueWithoutListener)
{
	Row row(2);
	row.run(240);
	EXPECT_EQ(4, countEvents(row.m_world.action()));
	EXPECT_EQ(0, countEvents(row.m_world.action()));
}

TEST(Action, TakesBrokenJointsOutOnce)
{
	Row row(3);
	for (int i = 0; i < 240; ++i)
	{
		row.run(1);
		int whole = 0;
		for (btElasticPlasticJoint* joint : row.m_joints)
			whole += !joint->isBroken();
		EXPECT_EQ(whole, row.m_world.bullet().getNumConstraints());
		EXPECT_EQ(3 - whole, row.m_world.action().getNumBroken());
	}
	EXPECT_EQ(3, row.m_world.action().getNumBroken());
	EXPECT_EQ(3, row.m_world.action().getNumJoints());
	for (btElasticPlasticJoint* joint : row.m_joints)
	{
		btTypedConstraint& constraint = joint->getConstraint();
		EXPECT_TRUE(constraint.getRigidBodyA().checkCollideWith(&constraint.getRigidBodyB()));
		EXPECT_EQ(0, constraint.getRigidBodyB().getNumConstraintRefs());
		// What it held when it broke stays readable.
		EXPECT_NEAR(1, joint->getDamage(), 0.2);
		EXPECT_NEAR(800, joint->getForce(BT_EP_AXIAL), 1e-3);
	}
	// Free fall from now on: nothing is left of the joint.
	const double velocity = row.m_joints[0]->getConstraint().getRigidBodyB().getLinearVelocity().y();
	row.run(24);
	EXPECT_NEAR(velocity - 1, row.m_joints[0]->getConstraint().getRigidBodyB().getLinearVelocity().y(), 1e-4);
}

TEST(Action, RepairsAJointAsNew)
{
	Row row(1);
	row.run(240);
	btElasticPlasticJoint* joint = row.m_joints[0];
	btRigidBody& block = joint->getConstraint().getRigidBodyB();
	ASSERT_TRUE(joint->isBroken());
	EXPECT_EQ(2, countEvents(row.m_world.action()));
	const btVector3 place = block.getCenterOfMassPosition();
	block.setLinearVelocity(btVector3(0, 0, 0));
	block.setGravity(btVector3(0, -1, 0));
	EXPECT_TRUE(row.m_world.action().repair(joint));
	EXPECT_FALSE(row.m_world.action().repair(joint));
	EXPECT_FALSE(joint->isBroken() || joint->hasYielded());
	EXPECT_EQ(0, joint->getDamage());
	EXPECT_EQ(0, joint->getPlasticEnergy());
	EXPECT_EQ(1, row.m_world.bullet().getNumConstraints());
	EXPECT_FALSE(block.checkCollideWith(row.m_ceiling));
	row.run(480);
	// It holds where it was put back, and can break again.
	EXPECT_NEAR(place.y(), block.getCenterOfMassPosition().y(), 1e-3);
	EXPECT_NEAR(100, joint->getForce(BT_EP_AXIAL), 20);
	block.setGravity(btVector3(0, -10, 0));
	row.run(240);
	EXPECT_TRUE(joint->isBroken());
	// Two of each life, of which the last ones are in the queue.
	EXPECT_EQ(2, countEvents(row.m_world.action()));
}

TEST(Action, SurvivesDeletionInAnyOrder)
{
	btDefaultCollisionConfiguration configuration;
	btCollisionDispatcher dispatcher(&configuration);
	btDbvtBroadphase broadphase;
	btSequentialImpulseConstraintSolver solver;
	btBoxShape shape(btVector3(1, 1, 1));
	for (int order = 0; order < 6; ++order)
	{
		auto world = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher, &broadphase, &solver, &configuration);
		auto action = std::make_unique<btElasticPlasticAction>();
		btRigidBody a(1, nullptr, &shape, btVector3(1, 1, 1)), b(1, nullptr, &shape, btVector3(1, 1, 1));
		world->addRigidBody(&a);
		world->addRigidBody(&b);
		btTransform frame = btTransform::getIdentity();
		auto joint = std::make_unique<btElasticPlastic6DofSpring2Constraint>(a, b, frame, frame);
		btElasticPlasticCapacity capacity;
		capacity.set(BT_EP_AXIAL, 100, 10);
		joint->setCapacity(capacity);
		// Joints may come to the action before or after the world, and twice.
		if (order % 2)
			world->addAction(action.get());
		EXPECT_TRUE(action->addJoint(joint.get()));
		EXPECT_TRUE(action->addJoint(joint.get()));
		EXPECT_EQ(1, action->getNumJoints());
		world->addConstraint(joint.get());
		if (!(order % 2))
			world->addAction(action.get());
		world->stepSimulation(btScalar(1) / 60, 0);
		switch (order)
		{
			case 0:  // the joint, still known to the action
				world->removeConstraint(joint.get());
				joint.reset();
				EXPECT_EQ(0, action->getNumJoints());
				break;
			case 1:  // out of the world, still known
				world->removeConstraint(joint.get());
				break;
			case 2:  // out of the books, still in the world
				action->removeJoint(joint.get());
				action->removeJoint(joint.get());
				break;
			case 3:  // the action first
				world->removeAction(action.get());
				action.reset();
				break;
			case 4:  // a body with its joints
				action->removeBody(*world, a);
				EXPECT_EQ(0, world->getNumConstraints());
				EXPECT_EQ(0, action->getNumJoints());
				break;
			case 5:  // from one action to another
			{
				btElasticPlasticAction other;
				EXPECT_TRUE(other.addJoint(joint.get()));
				EXPECT_EQ(0, action->getNumJoints());
				break;
			}
		}
		for (int i = 0; i < 3; ++i)
			world->stepSimulation(btScalar(1) / 60, 0);
		if (joint)
			world->removeConstraint(joint.get());
		world->removeRigidBody(&a);
		world->removeRigidBody(&b);
		world.reset();
		// The joint and the action outlive the world here.
	}
}

TEST(Action, LetsAListenerDeleteJoints)
{
	struct Reaper : btElasticPlasticListener
	{
		btDiscreteDynamicsWorld* m_world;
		std::vector<std::unique_ptr<btElasticPlastic6DofSpring2Constraint>> m_joints;
		int m_breaks = 0;

		void onBreak(const btElasticPlasticEvent&) override
		{
			++m_breaks;
			// All at once, whatever events are still to come.
			for (auto& joint : m_joints)
				m_world->removeConstraint(joint.get());
			m_joints.clear();
		}
	} reaper;
	Row row(0);
	reaper.m_world = &row.m_world.bullet();
	row.m_world.action().setListener(&reaper);
	for (int i = 0; i < 3; ++i)
	{
		btRigidBody* block =
			row.m_world.body(100, row.m_world.box(btVector3(1, 1, 1)),
							 btTransform(btQuaternion(0, 0, 0, 1), btVector3(btScalar(2 * i), -1, 0)), false);
		reaper.m_joints.emplace_back(new btElasticPlastic6DofSpring2Constraint(*block, btTransform::getIdentity()));
		btElasticPlasticCapacity capacity;
		capacity.set(BT_EP_SHEAR_Y, btScalar(1e6), 500, btScalar(0.01));
		reaper.m_joints.back()->setCapacity(capacity);
		row.m_world.bullet().addConstraint(reaper.m_joints.back().get());
		row.m_world.action().addJoint(reaper.m_joints.back().get());
	}
	row.run(240);
	EXPECT_EQ(1, reaper.m_breaks);
	EXPECT_EQ(0, row.m_world.action().getNumJoints());
	EXPECT_EQ(0, row.m_world.bullet().getNumConstraints());
}

TEST(Action, DoesNothingToJointsThatWereNotSolved)
{
	Row row(1);
	row.run(2);
	const btElasticPlasticState before = row.m_joints[0]->getState();
	row.m_joints[0]->getConstraint().getRigidBodyB().forceActivationState(ISLAND_SLEEPING);
	row.run(10);
	EXPECT_EQ(before.m_work, row.m_joints[0]->getState().m_work);
	EXPECT_EQ(before.m_force[0], row.m_joints[0]->getState().m_force[0]);
}

TEST(Action, NullIsNoneOfItsJoints)
{
	Row row(1);
	btElasticPlasticAction& action = row.m_world.action();
	EXPECT_EQ(nullptr, btElasticPlasticJoint::from(nullptr));
	EXPECT_FALSE(action.addJoint(nullptr));
	EXPECT_FALSE(action.breakJoint(row.m_world.bullet(), nullptr));
	EXPECT_FALSE(action.repair(nullptr));
	action.removeJoint(nullptr);
	EXPECT_EQ(1, action.getNumJoints());
}

TEST(Action, StatesCanBeSavedAndPutBack)
{
	Row row(1, Solver::Iterative, 10);
	row.run(20);
	const btElasticPlasticState saved = row.m_joints[0]->getState();
	btRigidBody& block = row.m_joints[0]->getConstraint().getRigidBodyB();
	const btTransform pose = block.getCenterOfMassTransform();
	const btVector3 velocity = block.getLinearVelocity(), spin = block.getAngularVelocity();
	row.run(30);
	const double first = row.m_joints[0]->getPlasticEnergy();
	row.m_joints[0]->setState(saved);
	block.setCenterOfMassTransform(pose);
	block.setLinearVelocity(velocity);
	block.setAngularVelocity(spin);
	row.run(30);
	EXPECT_EQ(first, row.m_joints[0]->getPlasticEnergy());
}
}  // namespace testAction
