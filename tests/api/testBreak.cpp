// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Joints that do not break by load: on purpose, by a state that is loaded, by bodies that are put elsewhere; and those that are let go.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/Pair.h"
#include "support/Precision.h"

namespace testBreak
{
using namespace ep;

const Solver SOLVERS[] = {Solver::Direct, Solver::Iterative, Solver::Stock};

struct Diary : btElasticPlasticListener
{
	std::vector<btElasticPlasticEvent> m_breaks;
	std::vector<std::string> m_refused;
	std::function<void()> m_atBreak;

	void onBreak(const btElasticPlasticEvent& event) override
	{
		m_breaks.push_back(event);
		if (m_atBreak)
			m_atBreak();
	}
	void onRefused(btElasticPlasticJoint&, const char* text) override { m_refused.push_back(text); }
};

int countEvents(btElasticPlasticAction& action)
{
	btElasticPlasticEvent event;
	int count = 0;
	while (action.popEvent(event))
		++count;
	return count;
}

btElasticPlasticCapacity strong() { return evenCapacity(1e7, 1e5); }

btElasticPlasticCapacity brittle()
{
	btElasticPlasticCapacity capacity = strong();
	capacity.m_ductility[BT_EP_AXIAL] = btScalar(0.01);
	return capacity;
}

/// The state of a brittle joint that has torn.
btElasticPlasticState brokenState()
{
	Pair pair(Solver::Direct);
	btElasticPlasticJoint* joint = pair.join(brittle());
	pair.m_b->setLinearVelocity(btVector3(1000, 0, 0));
	run(pair.m_world, 1);
	EXPECT_TRUE(joint->isBroken());
	return joint->getState();
}

TEST(BreakJoint, LetsGoWakesAndTells)
{
	for (Solver solver : SOLVERS)
		for (bool hasListener : {true, false})
		{
			Diary diary;
			Pair pair(solver, 0, 12, btVector3(0, -10, 0));
			btElasticPlasticAction& action = pair.m_world.action();
			if (hasListener)
				action.setListener(&diary);
			btElasticPlasticJoint* joint = pair.join(strong());
			run(pair.m_world, 30);
			const double damage = double(joint->getDamage()), before = double(pair.m_b->getLinearVelocity().y());
			pair.m_b->forceActivationState(ISLAND_SLEEPING);
			EXPECT_TRUE(action.breakJoint(pair.m_world.bullet(), joint));
			EXPECT_TRUE(joint->isBroken());
			EXPECT_EQ(damage, joint->getDamage());
			EXPECT_EQ(1, action.getNumBroken());
			EXPECT_EQ(0, pair.m_world.bullet().getNumConstraints());
			EXPECT_TRUE(pair.m_b->isActive());
			EXPECT_TRUE(pair.m_a->checkCollideWith(pair.m_b));
			if (hasListener)
			{
				ASSERT_EQ(1u, diary.m_breaks.size());
				EXPECT_EQ(joint, diary.m_breaks[0].m_joint);
				EXPECT_EQ(pair.m_b, diary.m_breaks[0].m_bodyB);
				EXPECT_NEAR(0.5, diary.m_breaks[0].m_position.x(), 1e-3);
			}
			else
				EXPECT_EQ(1, countEvents(action));
			// Once only.
			EXPECT_FALSE(action.breakJoint(pair.m_world.bullet(), joint));
			run(pair.m_world, 6);
			// Free fall for a tenth of a second, to float's rounding of a velocity of 1 m/s.
			EXPECT_NEAR(before - 1, pair.m_b->getLinearVelocity().y(), 1e-5);
			EXPECT_EQ(0, countEvents(action));
			EXPECT_EQ(hasListener ? 1u : 0u, diary.m_breaks.size());
			// And it can be mended.
			EXPECT_TRUE(action.repair(joint));
			run(pair.m_world, 1);
			EXPECT_EQ(6, joint->getNumCommittedRows());
		}
}

TEST(BreakJoint, RefusesWhatIsNotThere)
{
	Pair pair;
	btElasticPlasticAction other;
	btElasticPlasticJoint* joint = pair.join(strong());
	EXPECT_FALSE(other.breakJoint(pair.m_world.bullet(), joint));
	pair.m_world.bullet().removeConstraint(&joint->getConstraint());
	EXPECT_FALSE(pair.m_world.action().breakJoint(pair.m_world.bullet(), joint));
	EXPECT_FALSE(joint->isBroken());
	EXPECT_EQ(0, countEvents(pair.m_world.action()));
	pair.m_world.bullet().addConstraint(&joint->getConstraint(), true);
	// Before the first step as well.
	EXPECT_TRUE(pair.m_world.action().breakJoint(pair.m_world.bullet(), joint));
}

TEST(BreakJoint, AListenerBreaksAChainOfThem)
{
	const int COUNT = 20;
	World world(Solver::Direct);
	std::vector<btElasticPlasticJoint*> joints;
	btRigidBody* last = world.body(0, world.box(btVector3(1, 1, 1)), at(0), false);
	for (int i = 0; i < COUNT; ++i)
	{
		btRigidBody* next = world.body(1, world.box(btVector3(1, 1, 1)), at(i + 1.), false);
		joints.push_back(world.joint(*last, *next, at(i + 0.5), strong()));
		last = next;
	}
	Diary diary;
	world.action().setListener(&diary);
	int depth = 0, deepest = 0;
	diary.m_atBreak = [&]
	{
		deepest = btMax(deepest, ++depth);
		if (int(diary.m_breaks.size()) < COUNT)
		{
			EXPECT_TRUE(world.action().breakJoint(world.bullet(), joints[diary.m_breaks.size()]));
		}
		--depth;
	};
	run(world, 2);
	EXPECT_TRUE(world.action().breakJoint(world.bullet(), joints[0]));
	ASSERT_EQ(size_t(COUNT), diary.m_breaks.size());
	for (int i = 0; i < COUNT; ++i)
		EXPECT_EQ(joints[size_t(i)], diary.m_breaks[size_t(i)].m_joint);
	// One after another, however long the chain.
	EXPECT_EQ(1, deepest);
	EXPECT_EQ(0, world.bullet().getNumConstraints());
}

TEST(BreakJoint, AListenerMayDeleteTheActionAtIt)
{
	btDefaultCollisionConfiguration configuration;
	btCollisionDispatcher dispatcher(&configuration);
	btDbvtBroadphase broadphase;
	btSequentialImpulseConstraintSolver solver;
	btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
	btBoxShape shape(btVector3(1, 1, 1));
	btRigidBody a(1, nullptr, &shape, btVector3(1, 1, 1)), b(1, nullptr, &shape, btVector3(1, 1, 1));
	world.addRigidBody(&a);
	world.addRigidBody(&b);
	const btTransform frame = btTransform::getIdentity();
	btElasticPlastic6DofSpring2Constraint joint(a, b, frame, frame);
	joint.setCapacity(strong());
	world.addConstraint(&joint);
	auto action = std::make_unique<btElasticPlasticAction>();
	action->addJoint(&joint);
	Diary diary;
	diary.m_atBreak = [&] { action.reset(); };
	action->setListener(&diary);
	EXPECT_TRUE(action->breakJoint(world, &joint));
	EXPECT_FALSE(action);
	world.removeConstraint(&joint);
	world.removeRigidBody(&a);
	world.removeRigidBody(&b);
}

TEST(BreakJoint, ShootsNoOverlappingBodiesApart)
{
	for (bool byState : {false, true})
		for (Solver solver : SOLVERS)
		{
			// They overlap by 0.2 m.
			World world(solver, btVector3(0, 0, 0));
			btCollisionShape* cube = world.box(btVector3(1, 1, 1));
			btRigidBody *a = world.body(12, cube, at(0)), *b = world.body(12, cube, at(0.8));
			btElasticPlasticJoint* joint = world.joint(*a, *b, at(0.4), strong());
			run(world, 2);
			if (byState)
				EXPECT_TRUE(joint->setState(brokenState()));
			else
				EXPECT_TRUE(world.action().breakJoint(world.bullet(), joint));
			run(world, 30);
			EXPECT_TRUE(joint->isBroken());
			// The rounding of places that do not change.
			EXPECT_NEAR(0, world.kineticEnergy(), byPrecision(1e-15, 1e-7)) << int(solver);
			a->setLinearVelocity(btVector3(-3, 0, 0));
			run(world, 30);
			EXPECT_EQ(0, world.bullet().getNumConstraints());
		}
}

TEST(LoadedState, ABrokenOneHoldsNothing)
{
	const btElasticPlasticState broken = brokenState();
	for (Solver solver : SOLVERS)
		for (double away : {0., 0.5, 20.})
			for (bool isStepped : {false, true})
			{
				Diary diary;
				Pair pair(solver, 0, 12, btVector3(0, 0, 0), true);
				pair.m_world.action().setListener(&diary);
				btElasticPlasticJoint* joint = pair.join(brittle());
				if (isStepped)
					run(pair.m_world, 2);
				pair.m_b->setCenterOfMassTransform(at(1 + away, away, 0));
				EXPECT_TRUE(joint->setState(broken));
				EXPECT_TRUE(joint->isBroken());
				EXPECT_GE(joint->getDamage(), 1);
				EXPECT_EQ(1, pair.m_world.action().getNumBroken());
				run(pair.m_world, 10);
				EXPECT_EQ(0, pair.m_b->getLinearVelocity().length()) << away;
				EXPECT_EQ(0, pair.m_b->getAngularVelocity().length()) << away;
				EXPECT_TRUE(joint->isBroken());
				// It has left the world without a word.
				EXPECT_EQ(0, pair.m_world.bullet().getNumConstraints());
				EXPECT_TRUE(pair.m_a->checkCollideWith(pair.m_b));
				EXPECT_TRUE(diary.m_breaks.empty() && diary.m_refused.empty());
				EXPECT_TRUE(pair.m_world.action().repair(joint));
				EXPECT_FALSE(pair.m_a->checkCollideWith(pair.m_b));
			}
}

TEST(LoadedState, GoesToJointsThatNoActionOrNoWorldKnows)
{
	for (bool isKnown : {false, true})
		for (bool isInWorld : {false, true})
		{
			Diary diary;
			Pair pair(Solver::Direct);
			pair.m_world.action().setListener(&diary);
			btElasticPlastic6DofSpring2Constraint joint(*pair.m_a, *pair.m_b, at(0.5), at(-0.5));
			EXPECT_TRUE(joint.setCapacity(strong()));
			EXPECT_TRUE(joint.setState(brokenState()));
			if (isInWorld)
				pair.m_world.bullet().addConstraint(&joint, true);
			if (isKnown)
			{
				EXPECT_TRUE(pair.m_world.action().addJoint(&joint));
			}
			pair.m_b->setCenterOfMassTransform(at(5));
			testing::internal::CaptureStderr();
			run(pair.m_world, 5);
			EXPECT_EQ("", testing::internal::GetCapturedStderr());
			EXPECT_EQ(0, pair.m_b->getLinearVelocity().length());
			EXPECT_EQ(isInWorld && !isKnown ? 1 : 0, pair.m_world.bullet().getNumConstraints());
			EXPECT_EQ(isKnown ? 1 : 0, pair.m_world.action().getNumBroken());
			EXPECT_TRUE(diary.m_refused.empty());
			pair.m_world.bullet().removeConstraint(&joint);
		}
}

TEST(LoadedState, ABrokenOneMayLoseItsBodiesBeforeTheNextStep)
{
	World world(Solver::Direct);
	btBoxShape cube(btVector3(1, 1, 1));
	btRigidBody* support = world.body(0, &cube, at(0), false);
	auto body = std::make_unique<btRigidBody>(1, nullptr, &cube, btVector3(1, 1, 1));
	world.bullet().addRigidBody(body.get());
	btElasticPlastic6DofSpring2Constraint joint(*support, *body, at(0), at(0));
	EXPECT_TRUE(joint.setCapacity(strong()));
	world.bullet().addConstraint(&joint, true);
	EXPECT_TRUE(world.action().addJoint(&joint));
	run(world, 2);
	EXPECT_TRUE(joint.setState(brokenState()));
	world.bullet().removeConstraint(&joint);
	world.bullet().removeRigidBody(body.get());
	body.reset();
	run(world, 2);
	EXPECT_EQ(1, world.action().getNumBroken());
}

TEST(LoadedState, OfAJointThatHeldGoesBackOnlyWithItsBodies)
{
	Diary diary;
	Pair pair;
	pair.m_world.action().setListener(&diary);
	btElasticPlasticJoint* joint = pair.join(strong());
	const btElasticPlasticState whole = joint->getState();
	EXPECT_TRUE(pair.m_world.action().breakJoint(pair.m_world.bullet(), joint));
	pair.m_world.bullet().removeRigidBody(pair.m_b);
	EXPECT_FALSE(joint->setState(whole));
	EXPECT_TRUE(joint->isBroken());
	ASSERT_EQ(1u, diary.m_refused.size());
	EXPECT_NE(std::string::npos, diary.m_refused[0].find("body B")) << diary.m_refused[0];
	pair.m_world.bullet().addRigidBody(pair.m_b);
	EXPECT_TRUE(joint->setState(whole));
	run(pair.m_world, 1);
	EXPECT_EQ(6, joint->getNumCommittedRows());
}

/// Puts joints' states back before the action of the joints ends the step.
struct PutsBack : btActionInterface
{
	std::vector<std::pair<btElasticPlasticJoint*, btElasticPlasticState>> m_states;
	int m_broken = 0;

	void updateAction(btCollisionWorld*, btScalar) override
	{
		for (auto& state : m_states)
		{
			m_broken += state.first->isBroken();
			EXPECT_TRUE(state.first->setState(state.second));
		}
	}
	void debugDraw(btIDebugDraw*) override {}
};

TEST(LoadedState, PutBackBeforeTheStepEndsUndoesABreakOfInnerSteps)
{
	Diary diary;
	Pair pair(Solver::Direct);
	btDynamicsWorld& world = pair.m_world.bullet();
	pair.m_world.action().setListener(&diary);
	PutsBack putsBack;
	// Before the joints' own.
	world.removeAction(&pair.m_world.action());
	world.addAction(&putsBack);
	world.addAction(&pair.m_world.action());
	btElasticPlasticJoint* const joint = pair.join(brittle());
	run(pair.m_world, 2);
	putsBack.m_states.push_back({joint, joint->getState()});
	for (int i = 0; i < 5; ++i)
	{
		pair.m_b->setLinearVelocity(btVector3(30, 0, 0));
		run(pair.m_world, 1);
		EXPECT_FALSE(joint->isBroken());
		EXPECT_EQ(0, pair.m_world.action().getNumBroken());
	}
	EXPECT_GT(putsBack.m_broken, 0);
	EXPECT_TRUE(diary.m_breaks.empty());
	world.removeAction(&putsBack);
}

/// Gives a joint one capacity after another before the action of the joints ends the step.
struct ChangesCapacity : btActionInterface
{
	btElasticPlasticJoint* m_joint = nullptr;
	std::vector<btElasticPlasticCapacity> m_capacities;
	size_t m_next = 0;

	void updateAction(btCollisionWorld*, btScalar) override
	{
		EXPECT_TRUE(m_joint->setCapacity(m_capacities[m_next++ % m_capacities.size()]));
	}
	void debugDraw(btIDebugDraw*) override {}
};

TEST(LoadedState, ACapacityWithOtherFibresBeforeTheStepEndsLeavesTheStep)
{
	Pair pair(Solver::Direct);
	btDynamicsWorld& world = pair.m_world.bullet();
	ChangesCapacity changes;
	// Before the joints' own.
	world.removeAction(&pair.m_world.action());
	world.addAction(&changes);
	world.addAction(&pair.m_world.action());
	const btElasticPlasticMaterial steel = btElasticPlasticMaterial::steel(btScalar(250e6));
	const btElasticPlasticSection bar = btElasticPlasticSection::rectangle(btScalar(0.1), btScalar(0.1));
	for (const int fibres : {36, 8, 0, 16})
		changes.m_capacities.push_back(
			btElasticPlasticCapacity::fromMember(steel, fibres > 0 ? bar.withFibres(fibres) : bar, 1, 1));
	changes.m_joint = pair.join(changes.m_capacities.back());
	for (int i = 0; i < 40; ++i)
	{
		pair.m_b->applyCentralForce(btVector3(1000, 0, 0));
		run(pair.m_world, 1);
		// Once it has come to rest. Of a step that is left the springs know nothing, so they bear less than the load for a while; what fibres that are no more
		// would bear again comes on top of it (1.76 times the load).
		if (i >= 10)
		{
			EXPECT_LE(changes.m_joint->getForce(BT_EP_AXIAL), 1050) << i;
			EXPECT_GE(changes.m_joint->getForce(BT_EP_AXIAL), 500) << i;
		}
	}
	EXPECT_FALSE(changes.m_joint->isBroken());
	world.removeAction(&changes);
}

TEST(Teleport, TellsNoMoreEnergyThanTheDuctilityAllows)
{
	// A tie of 20 kN that tears at 0.2 m: 4 kJ, and what its spring holds.
	const double YIELD = 20e3, DUCTILITY = 0.2, STIFFNESS = 2e7;
	const double most = YIELD * DUCTILITY * (1 + byPrecision(1e-12, 1e-5)) + YIELD * YIELD / 2 / STIFFNESS;
	for (Solver solver : SOLVERS)
		for (double away : {0.1, 0.5, 10., 1e4})
		{
			Diary diary;
			Pair pair(solver, 0, 100);
			pair.m_world.action().setListener(&diary);
			btElasticPlasticCapacity capacity;
			capacity.set(BT_EP_AXIAL, btScalar(STIFFNESS), btScalar(YIELD), btScalar(DUCTILITY));
			btElasticPlasticJoint* joint = pair.join(capacity);
			run(pair.m_world, 5);
			pair.m_b->setCenterOfMassTransform(at(1 + away));
			run(pair.m_world, 30);
			EXPECT_LE(joint->getPlasticEnergy() + joint->getElasticEnergy(), most) << int(solver) << ", " << away;
			EXPECT_EQ(away > DUCTILITY, joint->isBroken());
			EXPECT_EQ(away > DUCTILITY ? 1u : 0u, diary.m_breaks.size());
			for (const btElasticPlasticEvent& e : diary.m_breaks)
				EXPECT_LE(e.m_energy, most);
			if (joint->isBroken())
			{
				EXPECT_NEAR(1, joint->getDamage(), byPrecision(1e-14, 2e-6));
			}
		}
}

/// A body that moves fast, or turns fast about the joint, by each degree of freedom in turn: flow ends where the ductility is spent, in the middle of a step.
TEST(Ductility, IsSpentByEachDegreeOfFreedomWithinTheStep)
{
	for (const Solver solver : {Solver::Direct, Solver::Iterative})
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		{
			Pair pair(solver, 0, 1000);
			const double yield = 1e4, ductility = 0.02, stiffness = 1e9;
			btElasticPlasticCapacity capacity;
			for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
				capacity.set(i, btScalar(stiffness), btScalar(i == dof ? yield : 1e9), btScalar(ductility));
			btElasticPlasticJoint* const joint = pair.join(capacity);
			btVector3 motion(0, 0, 0);
			motion[dof % 3] = 10;
			if (dof < 3)
				pair.m_b->setLinearVelocity(motion);
			else
			{
				pair.m_b->setAngularVelocity(motion);
				pair.m_b->setLinearVelocity(
					motion.cross(pair.m_b->getCenterOfMassPosition() - pair.m_frame.getOrigin()));
			}
			run(pair.m_world, 2);
			EXPECT_TRUE(joint->isBroken()) << dof;
			// The joint is elastic to a two-thousandth of its ductility. What turns about the joint loads its other directions, too.
			EXPECT_NEAR(1, double(joint->getDamage()), byPrecision(1e-12, 1e-5)) << dof;
			EXPECT_NEAR(ductility, double(joint->getPlasticPath(dof)), ductility * byPrecision(1e-12, 1e-5)) << dof;
			EXPECT_LE(joint->getPlasticEnergy(), yield * ductility * (1 + byPrecision(1e-12, 1e-5))) << dof;
		}
}

TEST(Teleport, OfAWholeStructureIsNotFelt)
{
	const btTransform away(btQuaternion(btVector3(0, 1, 0), 2), btVector3(100, 20, -30));
	Pair pair(Solver::Direct, 0, 12, btVector3(0, -10, 0));
	btElasticPlasticJoint* joint = pair.join(strong());
	run(pair.m_world, 120);
	const double force = double(joint->getForce(BT_EP_SHEAR_Y)), moment = double(joint->getForce(BT_EP_BENDING_Z));
	for (btRigidBody* body : {pair.m_a, pair.m_b})
	{
		body->setCenterOfMassTransform(away * body->getCenterOfMassTransform());
		body->setLinearVelocity(away.getBasis() * body->getLinearVelocity());
		body->setAngularVelocity(away.getBasis() * body->getAngularVelocity());
	}
	for (int i = 0; i < 60; ++i)
	{
		run(pair.m_world, 1);
		// A coordinate of 100 m has a rounding of 4e-6 m in float, which is 40 N in this spring.
		EXPECT_NEAR(force, joint->getForce(BT_EP_SHEAR_Y), byPrecision(1e-3, 100));
		EXPECT_NEAR(moment, joint->getForce(BT_EP_BENDING_Z), byPrecision(1e-3, 100));
		EXPECT_FALSE(joint->hasYielded());
	}
}

TEST(Teleport, OfOneBodyIsNotFeltWithANewReference)
{
	Pair pair(Solver::Direct);
	btElasticPlasticJoint* joint = pair.join(strong());
	run(pair.m_world, 5);
	pair.m_b->setCenterOfMassTransform(at(3, 1, 0));
	joint->setReferenceToCurrentPose();
	run(pair.m_world, 30);
	EXPECT_FALSE(joint->hasYielded());
	// The spring's force by the rounding of a place.
	EXPECT_NEAR(0, pair.m_b->getLinearVelocity().length(), byPrecision(1e-12, 1e-3));
	EXPECT_EQ(6, joint->getNumCommittedRows());
}

TEST(LettingGo, ByAYieldOfZeroAndHoldingAgain)
{
	for (Solver solver : SOLVERS)
	{
		Diary diary;
		Pair pair(solver, 0, 12, btVector3(0, -10, 0));
		pair.m_world.action().setListener(&diary);
		btElasticPlasticJoint* joint = pair.join(strong());
		run(pair.m_world, 5);
		const double before = double(pair.m_b->getLinearVelocity().y());
		btElasticPlasticCapacity none = strong();
		none.scaleYield(0);
		EXPECT_TRUE(joint->setCapacity(none));
		run(pair.m_world, 6);
		EXPECT_NEAR(before - 1, pair.m_b->getLinearVelocity().y(), 1e-5);
		EXPECT_FALSE(joint->isBroken() || joint->fault());
		EXPECT_EQ(1, pair.m_world.bullet().getNumConstraints());
		EXPECT_TRUE(diary.m_breaks.empty() && diary.m_refused.empty());
		pair.m_b->setLinearVelocity(btVector3(0, 0, 0));
		const btVector3 place = pair.m_b->getCenterOfMassPosition();
		EXPECT_TRUE(joint->setCapacity(strong()));
		run(pair.m_world, 60);
		EXPECT_NEAR(0, (pair.m_b->getCenterOfMassPosition() - place).length(), 1e-3);
		EXPECT_FALSE(joint->hasYielded());
	}
}

TEST(AddConstraint, ThatIsForgottenIsToldOnce)
{
	for (Solver solver : SOLVERS)
	{
		Diary diary;
		Pair pair(solver, 0, 12, btVector3(0, -10, 0));
		pair.m_world.action().setListener(&diary);
		btElasticPlastic6DofSpring2Constraint joint(*pair.m_a, *pair.m_b, at(0.5), at(-0.5));
		joint.setName("gate hinge");
		EXPECT_TRUE(joint.setCapacity(strong()));
		EXPECT_TRUE(pair.m_world.action().addJoint(&joint));
		run(pair.m_world, 10);
		ASSERT_EQ(1u, diary.m_refused.size());
		EXPECT_NE(std::string::npos, diary.m_refused[0].find("gate hinge")) << diary.m_refused[0];
		EXPECT_NE(std::string::npos, diary.m_refused[0].find("addConstraint")) << diary.m_refused[0];
		EXPECT_TRUE(bool(joint.fault()));
		// Others do not bring it up again.
		btRigidBody* third = pair.m_world.body(1, pair.m_b->getCollisionShape(), at(2), false);
		pair.m_world.joint(*pair.m_b, *third, at(1.5), strong());
		run(pair.m_world, 10);
		EXPECT_EQ(1u, diary.m_refused.size());
		pair.m_world.bullet().addConstraint(&joint, true);
		run(pair.m_world, 1);
		EXPECT_FALSE(joint.fault());
		EXPECT_EQ(6, joint.getNumCommittedRows());
		// Taken out on purpose.
		pair.m_world.bullet().removeConstraint(&joint);
		run(pair.m_world, 10);
		EXPECT_EQ(1u, diary.m_refused.size());
	}
}

TEST(AddConstraint, OfSleepersIsSeen)
{
	Diary diary;
	Pair pair(Solver::Direct, 0, 12, btVector3(0, -10, 0));
	pair.m_world.action().setListener(&diary);
	pair.m_b->forceActivationState(ISLAND_SLEEPING);
	btElasticPlasticJoint* joint = pair.join(strong());
	run(pair.m_world, 10);
	EXPECT_EQ(0, joint->getNumCommittedRows());
	EXPECT_TRUE(diary.m_refused.empty());
	EXPECT_FALSE(joint->fault());
}
}  // namespace testBreak
