// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The bookkeeping: events, removal, repair, order of deletion, what happens after a break.

#include <math.h>

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/BlockUnderTension.h"
#include "support/Precision.h"

namespace
{
using namespace ep;

/// Blocks hanging side by side, each on its own joint that breaks after the given plastic elongation.
struct Row
{
	World m_world;
	btRigidBody* m_ceiling;
	std::vector<btElasticPlasticJoint*> m_joints;

	explicit Row(int count, Solver solver = Solver::Iterative, double ductility = 0.05) : m_world(solver)
	{
		m_ceiling = m_world.body(0, m_world.box(btVector3(100, 1, 1)), btTransform::getIdentity(), false);
		for (int i = 0; i < count; ++i)
		{
			const btVector3 place(btScalar(2 * i), -1, 0);
			btRigidBody* block =
				m_world.body(100, m_world.box(btVector3(1, 1, 1)), btTransform(btQuaternion(0, 0, 0, 1), place), false);
			btElasticPlasticCapacity capacity;
			for (int d = 0; d < BT_EP_DOF_COUNT; ++d)
				capacity.set(d, btScalar(1e7), 800, btScalar(ductility));
			m_joints.push_back(m_world.joint(
				*m_ceiling, *block,
				btTransform(btQuaternion(btVector3(0, 0, 1), -SIMD_HALF_PI), place + btVector3(0, btScalar(0.5), 0)),
				capacity));
		}
	}

	void run(int steps)
	{
		for (int i = 0; i < steps; ++i)
			m_world.step(btScalar(1) / 240);
	}
};

struct Diary : btElasticPlasticListener
{
	std::vector<btElasticPlasticEvent> m_events;
	std::vector<std::string> m_refused;

	void onYield(const btElasticPlasticEvent& e) override { m_events.push_back(e); }
	void onBreak(const btElasticPlasticEvent& e) override { m_events.push_back(e); }
	void onRefused(btElasticPlasticJoint&, const char* text) override { m_refused.push_back(text); }
};

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
	btElasticPlasticEvent event;
	int count = 0;
	while (row.m_world.action().popEvent(event))
		++count;
	EXPECT_EQ(4, count);
	EXPECT_FALSE(row.m_world.action().popEvent(event));
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
	btElasticPlasticEvent event;
	int count = 0;
	while (row.m_world.action().popEvent(event))
		++count;
	EXPECT_EQ(4, count);
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

TEST(Action, EvaluatingChangesNothing)
{
	// Trial and revert: rows may be asked for as often as one likes; only a commit moves the state.
	Row row(1);
	row.run(20);
	btElasticPlasticJoint* joint = row.m_joints[0];
	const btElasticPlasticState before = joint->getState();
	for (int i = 0; i < 5; ++i)
	{
		EXPECT_EQ(6, joint->prepare());
		joint->revert();
		EXPECT_EQ(0, joint->commit());
	}
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		EXPECT_EQ(before.m_force[i], joint->getState().m_force[i]);
		EXPECT_EQ(before.m_plastic[i], joint->getState().m_plastic[i]);
	}
	EXPECT_EQ(before.m_work, joint->getState().m_work);
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

/// Two blocks bent against each other until their corners overlap deeply; then the joint breaks.
struct BentBreak
{
	World m_world;
	btRigidBody* m_a;
	btRigidBody* m_b;
	btElasticPlasticJoint* m_joint;

	explicit BentBreak(Solver solver) : m_world(solver, btVector3(0, 0, 0))
	{
		btCollisionShape* cube = m_world.box(btVector3(1, 1, 1));
		m_a = m_world.body(1000, cube, btTransform::getIdentity());
		m_b = m_world.body(1000, cube, btTransform(btQuaternion(0, 0, 0, 1), btVector3(1, 0, 0)));
		btElasticPlasticCapacity capacity;
		for (int d = 0; d < BT_EP_DOF_COUNT; ++d)
			capacity.set(d, btScalar(1e8), btScalar(1e6));
		capacity.set(BT_EP_BENDING_Z, btScalar(1e6), 2000, btScalar(0.6));
		m_joint =
			m_world.joint(*m_a, *m_b, btTransform(btQuaternion(0, 0, 0, 1), btVector3(btScalar(0.5), 0, 0)), capacity);
		m_b->setAngularVelocity(btVector3(0, 0, 4));
		m_a->setAngularVelocity(btVector3(0, 0, -4));
	}
};

TEST(Parting, GivesNoEnergyAtABreak)
{
	for (Solver solver : {Solver::Stock, Solver::Iterative})
	{
		BentBreak scene(solver);
		bool broke = false;
		double energy = 1e30;
		int collidedAfter = 0;
		for (int i = 0; i < 960; ++i)
		{
			scene.m_world.step(btScalar(1) / 240);
			if (scene.m_joint->isBroken())
			{
				broke = true;
				// Nothing acts any more but their contact: kinetic energy never rises, to the rounding of velocities.
				EXPECT_LE(scene.m_world.kineticEnergy(), energy * (1 + byPrecision(1e-9, 1e-5)));
				EXPECT_TRUE(scene.m_a->checkCollideWith(scene.m_b));
				collidedAfter += scene.m_world.bullet().getDispatcher()->getNumManifolds() > 0;
			}
			energy = scene.m_world.kineticEnergy();
		}
		EXPECT_TRUE(broke);
		// They did overlap and touch, else this proves nothing.
		EXPECT_GT(collidedAfter, 0);
	}
}

TEST(Parting, EndsWhenTheBodiesHaveParted)
{
	BentBreak scene(Solver::Iterative);
	int steps = 0;
	while (!scene.m_joint->isBroken() && steps++ < 960)
		scene.m_world.step(btScalar(1) / 240);
	ASSERT_TRUE(scene.m_joint->isBroken());
	EXPECT_EQ(1, scene.m_world.bullet().getNumConstraints());
	scene.m_b->setLinearVelocity(btVector3(2, 0, 0));
	scene.m_a->setLinearVelocity(btVector3(-2, 0, 0));
	for (int i = 0; i < 480; ++i)
		scene.m_world.step(btScalar(1) / 240);
	EXPECT_EQ(0, scene.m_world.bullet().getNumConstraints());
}

TEST(Parting, StillLetsBodiesRestOnEachOther)
{
	// A column crushed at a joint does not telescope: the upper block stays on the lower one.
	World world(Solver::Iterative);
	btCollisionShape* cube = world.box(btVector3(1, 1, 1));
	btRigidBody* lower = world.body(0, cube, btTransform::getIdentity());
	btRigidBody* upper = world.body(1000, cube, btTransform(btQuaternion(0, 0, 0, 1), btVector3(0, 1, 0)));
	btElasticPlasticCapacity capacity;
	for (int d = 0; d < BT_EP_DOF_COUNT; ++d)
		capacity.set(d, btScalar(1e7), 8000, btScalar(0.1));
	btElasticPlasticJoint* joint = world.joint(
		*lower, *upper, btTransform(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI), btVector3(0, btScalar(0.5), 0)),
		capacity);
	for (int i = 0; i < 480; ++i)
		world.step(btScalar(1) / 240);
	ASSERT_TRUE(joint->isBroken());
	EXPECT_NEAR(0.9, upper->getCenterOfMassPosition().y(), 0.02);
}

TEST(Parting, OutlivesDeletionOfTheBrokenJoint)
{
	BentBreak scene(Solver::Iterative);
	while (!scene.m_joint->isBroken())
		scene.m_world.step(btScalar(1) / 240);
	ASSERT_EQ(1, scene.m_world.bullet().getNumConstraints());
	scene.m_world.action().removeJoint(scene.m_joint);
	EXPECT_EQ(0, scene.m_world.bullet().getNumConstraints());
	for (int i = 0; i < 10; ++i)
		scene.m_world.step(btScalar(1) / 240);
}

/// Counts what is drawn.
struct Canvas : btIDebugDraw
{
	int m_lines = 0;
	std::vector<btVector3> m_colours;

	void drawLine(const btVector3&, const btVector3&, const btVector3& colour) override
	{
		++m_lines;
		m_colours.push_back(colour);
	}
	void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override {}
	void reportErrorWarning(const char*) override {}
	void draw3dText(const btVector3&, const char*) override {}
	void setDebugMode(int) override {}
	int getDebugMode() const override { return DBG_DrawWireframe; }
};

TEST(DebugDraw, ColoursJointsByUse)
{
	Row row(1);
	Canvas fresh, broken;
	row.m_world.action().debugDraw(&fresh);
	ASSERT_GT(fresh.m_lines, 0);
	EXPECT_EQ(btVector3(0, 1, 0), fresh.m_colours[0]);
	row.run(240);
	row.m_world.bullet().setDebugDrawer(&broken);
	row.m_world.action().debugDraw(&broken);
	ASSERT_GT(broken.m_lines, 0);
	// Red, dark.
	EXPECT_GT(broken.m_colours[0].x(), 5 * broken.m_colours[0].y());
	EXPECT_LT(broken.m_colours[0].x(), 0.3);
	// Bullet draws its actions itself.
	const int lines = broken.m_lines;
	row.m_world.bullet().debugDrawWorld();
	EXPECT_GT(broken.m_lines, lines);
	row.m_world.bullet().setDebugDrawer(nullptr);
}
}  // namespace
