// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What events tell, levels, and several listeners.

#include <math.h>

#include <functional>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "support/DirectSolver.h"
#include "support/Pair.h"
#include "support/Precision.h"
#include "support/Row.h"

namespace testEvents
{
using namespace ep;

struct Diary : btElasticPlasticListener
{
	std::vector<btElasticPlasticEvent> m_events;
	std::function<void(const btElasticPlasticEvent&)> m_act;
	int m_refused = 0;

	void onYield(const btElasticPlasticEvent& e) override { note(e); }
	void onBreak(const btElasticPlasticEvent& e) override { note(e); }
	void onLevel(const btElasticPlasticEvent& e) override { note(e); }
	void onRefused(btElasticPlasticJoint&, const char*) override { ++m_refused; }

	void note(const btElasticPlasticEvent& e)
	{
		m_events.push_back(e);
		if (m_act)
			m_act(e);
	}
};

/// A quarter turn about z, so that the joint's x axis is the world's y axis.
btTransform turned(bool isTurned)
{
	return btTransform(btQuaternion(btVector3(0, 0, 1), isTurned ? SIMD_HALF_PI : btScalar(0)), btVector3(5, 6, 7));
}

TEST(Events, ABreakTellsImpulseSpeedAndDirection)
{
	for (bool isTurned : {false, true})
		for (bool isFirstStatic : {true, false})
		{
			// An impulse is that of a step: here of one of the world.
			Pair pair(withoutInnerSteps(), isFirstStatic ? 0 : 12, isFirstStatic ? 12 : 0);
			const btTransform turn = turned(isTurned);
			for (btRigidBody* body : {pair.m_a, pair.m_b})
				body->setWorldTransform(turn * body->getWorldTransform());
			pair.m_frame = turn * pair.m_frame;
			btElasticPlasticCapacity capacity = evenCapacity(1e7, 1e6);
			capacity.set(BT_EP_AXIAL, btScalar(1e7), 600, btScalar(0.3));
			pair.join(capacity);
			Diary diary;
			pair.m_world.action().addListener(&diary);
			// 600 J are 3.3 times what 0.3 m take: 3 m/s slow down by 50 m/s^2 along 0.3 m.
			const btVector3 axis = turn.getBasis() * btVector3(1, 0, 0);
			btRigidBody& moving = isFirstStatic ? *pair.m_b : *pair.m_a;
			moving.setLinearVelocity(axis * (isFirstStatic ? btScalar(10) : btScalar(-10)));
			run(pair.m_world, 30);
			ASSERT_EQ(2u, diary.m_events.size());
			const btElasticPlasticEvent& tear = diary.m_events[1];
			ASSERT_EQ(BT_EP_EVENT_BREAK, tear.m_type);
			// Body B leaves along x by what the joint has left of its speed, whichever of them is fixed; and what pulled B back pulled
			// A forward. A step has 600 N / 60 s.
			const double steps = tear.m_time * 60;
			EXPECT_NEAR(10 - (600. / 60 * steps) / 12, tear.m_velocity.dot(axis), 0.2);
			EXPECT_NEAR(tear.m_velocity.length(), tear.m_velocity.dot(axis), 1e-4);
			EXPECT_NEAR(600. / 60, tear.m_impulse.dot(axis), 600. / 60 * byPrecision(1e-9, 1e-5));
			EXPECT_NEAR(tear.m_impulse.length(), tear.m_impulse.dot(axis), 1e-3);
			EXPECT_NEAR((tear.m_velocity - (pair.m_b->getLinearVelocity() - pair.m_a->getLinearVelocity())).length(), 0,
						1e-3);
		}
}

TEST(Events, LevelsAreToldWhenTheyArePassed)
{
	for (Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
	{
		Pair pair(solver);
		btElasticPlasticJoint* joint = pair.join(evenCapacity(1e5, 1e3));
		Diary diary;
		pair.m_world.action().addListener(&diary);
		ASSERT_TRUE(joint->setLevel(BT_EP_QUANTITY_FORCE, 300));
		ASSERT_TRUE(joint->setLevel(BT_EP_QUANTITY_MOMENT, 200));
		ASSERT_TRUE(joint->setLevel(BT_EP_QUANTITY_UTILISATION, btScalar(0.5)));
		// The load grows by 10 N a step, slowly against a period of 2 pi sqrt(12 / 1e5) = 4 steps.
		double forceAt = 0, useAt = 0;
		for (int i = 1; i <= 60; ++i)
		{
			const btScalar load = btScalar(10 * i);
			pair.m_b->applyCentralForce(btVector3(load, 0, 0));
			pair.m_world.step(FRAME);
			for (const btElasticPlasticEvent& e : diary.m_events)
				(e.m_quantity == BT_EP_QUANTITY_FORCE ? forceAt : useAt) = load;
			diary.m_events.clear();
		}
		// A load that grows evenly is followed with a sway of 10 N / 4 steps around it.
		EXPECT_NEAR(300, forceAt, 30);
		EXPECT_NEAR(500, useAt, 30);
		EXPECT_FALSE(joint->hasYielded());
	}
}

TEST(Events, ALevelIsToldAgainAfterItWasLeft)
{
	// Long steps damp: a load that comes suddenly does not swing up to twice its size.
	Pair pair(withoutInnerSteps());
	btElasticPlasticJoint* joint = pair.join(evenCapacity(1e6, 1e3));
	ASSERT_TRUE(joint->setLevel(BT_EP_QUANTITY_UTILISATION, btScalar(0.5)));
	int events = 0;
	const auto load = [&](btScalar force)
	{
		btElasticPlasticEvent event;
		for (int i = 0; i < 60; ++i)
		{
			pair.m_b->applyCentralForce(btVector3(force, 0, 0));
			pair.m_world.step(FRAME);
			while (pair.m_world.action().popEvent(event))
			{
				EXPECT_EQ(BT_EP_EVENT_LEVEL, event.m_type);
				EXPECT_EQ(BT_EP_QUANTITY_UTILISATION, event.m_quantity);
				EXPECT_GE(event.m_value, btScalar(0.5));
				EXPECT_EQ(int(BT_EP_AXIAL), event.m_dof);
				++events;
			}
		}
	};
	load(700);
	EXPECT_EQ(1, events);
	load(480);  // not below nine tenths of the level
	load(700);
	EXPECT_EQ(1, events);
	load(400);
	load(700);
	EXPECT_EQ(2, events);
	// What has been passed belongs to the state.
	load(400);
	const btElasticPlasticState below = joint->getState();
	load(700);
	EXPECT_EQ(3, events);
	ASSERT_TRUE(joint->setState(below));
	load(700);
	EXPECT_EQ(4, events);
}

TEST(Events, DamageIsToldBeforeTheBreak)
{
	Row row(1);
	Diary diary;
	row.m_world.action().addListener(&diary);
	ASSERT_TRUE(row.m_joints[0]->setLevel(BT_EP_QUANTITY_DAMAGE, btScalar(0.5)));
	row.run(240);
	ASSERT_EQ(3u, diary.m_events.size());
	EXPECT_EQ(BT_EP_EVENT_YIELD, diary.m_events[0].m_type);
	EXPECT_EQ(BT_EP_EVENT_LEVEL, diary.m_events[1].m_type);
	EXPECT_EQ(BT_EP_QUANTITY_DAMAGE, diary.m_events[1].m_quantity);
	EXPECT_EQ(BT_EP_EVENT_BREAK, diary.m_events[2].m_type);
	EXPECT_GE(diary.m_events[1].m_value, btScalar(0.5));
	EXPECT_LT(diary.m_events[1].m_value, btScalar(0.7));  // 5 cm, of which a step at that speed takes less than 1
}

TEST(Events, LevelsOutOfRangeAreRefused)
{
	Pair pair(Solver::Direct);
	btElasticPlasticJoint* joint = pair.join(evenCapacity(1e6, 1e3));
	for (btScalar level : {btScalar(0), btScalar(-1), btScalar(NAN), btScalar(INFINITY)})
		EXPECT_FALSE(joint->setLevel(BT_EP_QUANTITY_FORCE, level));
	for (int none : {-1, int(BT_EP_QUANTITY_COUNT)})
	{
		EXPECT_FALSE(joint->setLevel(btElasticPlasticQuantity(none), 1));
		EXPECT_EQ(0, joint->getQuantity(btElasticPlasticQuantity(none)));
	}
	EXPECT_EQ(btElasticPlasticCapacity::unlimited(), joint->getLevel(BT_EP_QUANTITY_FORCE));
	ASSERT_TRUE(joint->setLevel(BT_EP_QUANTITY_FORCE, 5));
	EXPECT_EQ(5, joint->getLevel(BT_EP_QUANTITY_FORCE));
}

TEST(Events, SeveralListenersHearAllInTheirOrder)
{
	Row row(2);
	btElasticPlasticAction& action = row.m_world.action();
	Diary first, second, none;
	std::vector<Diary*> told;
	for (Diary* diary : {&first, &second, &none})
	{
		action.addListener(diary);
		diary->m_act = [&told, diary](const btElasticPlasticEvent&) { told.push_back(diary); };
	}
	action.addListener(&first);
	action.addListener(nullptr);
	action.removeListener(&none);
	EXPECT_FALSE(row.m_joints[0]->setCapacity(
		[]
		{
			btElasticPlasticCapacity bad;
			bad.set(BT_EP_AXIAL, -1, 1);
			return bad;
		}()));
	EXPECT_EQ(1, first.m_refused);
	EXPECT_EQ(1, second.m_refused);
	row.run(240);
	EXPECT_EQ(2u, first.m_events.size());
	EXPECT_EQ(2u, second.m_events.size());
	EXPECT_EQ((std::vector<Diary*>{&first, &second, &first, &second}), told);
	action.setListener(&none);
	btElasticPlasticEvent event;
	EXPECT_FALSE(action.popEvent(event));
}

TEST(Events, AListenerMayRemoveOthersAndTakeTheJoint)
{
	Row row(1);
	btElasticPlasticAction& action = row.m_world.action();
	Diary first, second, third;
	for (Diary* diary : {&first, &second, &third})
		action.addListener(diary);
	first.m_act = [&](const btElasticPlasticEvent& e)
	{
		action.removeListener(&third);
		if (e.m_type == BT_EP_EVENT_BREAK)
			action.removeJoint(e.m_joint);
	};
	row.run(240);
	EXPECT_EQ(2u, first.m_events.size());
	ASSERT_EQ(2u, second.m_events.size());
	EXPECT_EQ(0u, third.m_events.size());
	EXPECT_EQ(row.m_joints[0], second.m_events[0].m_joint);
	EXPECT_EQ(nullptr, second.m_events[1].m_joint);
}

TEST(Events, AListenerMayDeleteTheActionBeforeOthersHear)
{
	Pair pair(Solver::Direct, 0, 12, btVector3(0, -10, 0));
	std::unique_ptr<btElasticPlasticAction> action(new btElasticPlasticAction);
	pair.m_world.bullet().addAction(action.get());
	btElasticPlasticCapacity weak = evenCapacity(1e7, 1);
	for (btScalar& each : weak.m_ductility)
		each = btScalar(0.001);
	btElasticPlasticJoint* joint = pair.join(weak);
	ASSERT_TRUE(action->addJoint(joint));
	Diary first, second;
	action->addListener(&first);
	action->addListener(&second);
	first.m_act = [&](const btElasticPlasticEvent&)
	{
		pair.m_world.bullet().removeAction(action.get());
		action.reset();
	};
	for (int i = 0; i < 10 && action; ++i)
		pair.m_world.step(FRAME);
	EXPECT_EQ(1u, first.m_events.size());
	EXPECT_EQ(0u, second.m_events.size());
}
}  // namespace testEvents
