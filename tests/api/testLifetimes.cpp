// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Bodies, joints, actions and worlds come and go in any order.

#include <math.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "BulletCollision/CollisionDispatch/btSimulationIslandManager.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticStepper.h"
#include "LinearMath/btIDebugDraw.h"
#include "support/Run.h"
#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace testLifetimes
{
using namespace ep;

const Solver SOLVERS[] = {Solver::Direct, Solver::Iterative, Solver::Stock};

std::unique_ptr<btConstraintSolver> make(Solver solver)
{
	if (solver == Solver::Stock)
		return std::make_unique<btSequentialImpulseConstraintSolver>();
	auto ours = std::make_unique<btElasticPlasticConstraintSolver>();
	ours->setForm(solver == Solver::Direct ? BT_EP_DIRECT : BT_EP_ITERATIVE);
	return ours;
}

/// Writes down what it hears, and does something at each break.
struct Diary : btElasticPlasticListener
{
	std::vector<btElasticPlasticJoint*> m_broken;
	std::vector<std::string> m_refused;
	std::function<void()> m_atBreak;
	int m_cracks = 0;

	void onCrack(const btElasticPlasticEvent&) override { ++m_cracks; }
	void onBreak(const btElasticPlasticEvent& event) override
	{
		m_broken.push_back(event.m_joint);
		if (m_atBreak)
			m_atBreak();
	}
	void onRefused(btElasticPlasticJoint&, const char* text) override { m_refused.push_back(text); }
};

/// It breaks under the weight of a body.
btElasticPlasticCapacity weak()
{
	btElasticPlasticCapacity capacity;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		capacity.set(i, btScalar(1e6), 1, btScalar(1e-6));
	return capacity;
}

btElasticPlasticCapacity strong() { return evenCapacity(1e8, 1e6); }

/// A world of which each part may be deleted by itself, unlike ep::World.
struct Parts
{
	btDefaultCollisionConfiguration m_configuration;
	btCollisionDispatcher m_dispatcher{&m_configuration};
	btDbvtBroadphase m_broadphase;
	std::unique_ptr<btConstraintSolver> m_solver;
	btBoxShape m_shape{btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5))};
	std::vector<std::unique_ptr<btRigidBody>> m_bodies;
	std::vector<std::unique_ptr<btElasticPlastic6DofSpring2Constraint>> m_joints;
	std::unique_ptr<btElasticPlasticAction> m_action = std::make_unique<btElasticPlasticAction>();
	std::unique_ptr<btDiscreteDynamicsWorld> m_world;

	explicit Parts(Solver solver) : m_solver(make(solver))
	{
		m_world =
			std::make_unique<btDiscreteDynamicsWorld>(&m_dispatcher, &m_broadphase, m_solver.get(), &m_configuration);
		m_world->setGravity(btVector3(0, -10, 0));
		m_world->addAction(m_action.get());
	}
	~Parts()
	{
		deleteJoints();
		deleteAction();
		deleteBodies();
	}

	/// In no world yet.
	btRigidBody* body(btScalar mass, const btVector3& place)
	{
		btVector3 inertia(0, 0, 0);
		if (mass > 0)
			m_shape.calculateLocalInertia(mass, inertia);
		m_bodies.emplace_back(new btRigidBody(mass, nullptr, &m_shape, inertia));
		btRigidBody* body = m_bodies.back().get();
		body->setCenterOfMassTransform(at(place.x(), place.y(), place.z()));
		body->setActivationState(DISABLE_DEACTIVATION);
		return body;
	}

	/// In no world and unknown to the action yet.
	btElasticPlastic6DofSpring2Constraint* joint(btRigidBody& a, btRigidBody& b,
												 const btElasticPlasticCapacity& capacity)
	{
		const btVector3 half = (b.getCenterOfMassPosition() - a.getCenterOfMassPosition()) / 2;
		m_joints.emplace_back(new btElasticPlastic6DofSpring2Constraint(a, b, at(half.x(), half.y(), half.z()),
																		at(-half.x(), -half.y(), -half.z())));
		m_joints.back()->setCapacity(capacity);
		return m_joints.back().get();
	}

	/// A support and bodies in a row, joined.
	void row(int count, btScalar distance, const btElasticPlasticCapacity& capacity)
	{
		for (int i = 0; i <= count; ++i)
		{
			m_world->addRigidBody(body(i == 0 ? 0 : 100, btVector3(btScalar(i) * distance, 5, 0)));
			if (i == 0)
				continue;
			btElasticPlastic6DofSpring2Constraint* link = joint(*m_bodies[i - 1], *m_bodies[i], capacity);
			m_world->addConstraint(link, true);
			EXPECT_TRUE(m_action->addJoint(link));
		}
	}

	void step(int steps = 1)
	{
		for (int i = 0; i < steps; ++i)
			m_world->stepSimulation(FRAME, 0);
	}

	void deleteJoints()
	{
		for (auto& joint : m_joints)
			if (m_world && !joint->isBroken())
				m_world->removeConstraint(joint.get());
		m_joints.clear();
	}
	void deleteAction()
	{
		if (m_world && m_action)
			m_world->removeAction(m_action.get());
		m_action.reset();
	}
	void deleteBodies()
	{
		for (auto& body : m_bodies)
			if (m_world && body->getBroadphaseHandle())
				m_world->removeRigidBody(body.get());
		m_bodies.clear();
	}
	void deleteWorld() { m_world.reset(); }
};

/// Two bodies that overlap, and their joint that has just broken: it is still in the world.
struct Overlap : Parts
{
	explicit Overlap(Solver solver) : Parts(solver)
	{
		row(1, btScalar(0.5), weak());
		for (int i = 0; i < 20 && !m_joints[0]->isBroken(); ++i)
			step();
		EXPECT_TRUE(m_joints[0]->isBroken());
		EXPECT_EQ(1, m_world->getNumConstraints());
	}
};

TEST(Lifetimes, AnyOrderOfDeletionWhileBodiesOverlap)
{
	typedef std::function<void(Overlap&)> Deletion;
	const Deletion action = [](Overlap&s) { s.deleteAction(); }, world = [](Overlap&s) { s.deleteWorld(); },
				   joint = [](Overlap&s) { s.deleteJoints(); };
	const Deletion orders[][3] = {{action, world, joint}, {action, joint, world}, {world, action, joint},
								  {world, joint, action}, {joint, action, world}, {joint, world, action}};
	for (Solver solver : SOLVERS)
		for (const auto& order : orders)
			for (int stepped = 0; stepped < 2; ++stepped)
			{
				Overlap scene(solver);
				for (const Deletion& deletion : order)
				{
					deletion(scene);
					if (scene.m_world && stepped)
						scene.step(3);
					if (scene.m_world)
					{
						// Who leaves takes the constraint out of the world: nobody else would.
						EXPECT_EQ(0, scene.m_world->getNumConstraints());
						EXPECT_TRUE(isFinite(*scene.m_bodies[1]));
					}
				}
			}
}

TEST(Lifetimes, TheUserRemovesABrokenJointAndItsBodies)
{
	for (Solver solver : SOLVERS)
	{
		Overlap scene(solver);
		scene.m_world->removeConstraint(scene.m_joints[0].get());
		scene.deleteBodies();
		scene.step(3);
		EXPECT_EQ(0, scene.m_world->getNumConstraints());
		scene.m_joints.clear();
		scene.step(3);
		EXPECT_EQ(0, scene.m_action->getNumJoints());
	}
}

TEST(Lifetimes, NoRepairWithoutWorldOrBodies)
{
	for (Solver solver : SOLVERS)
		for (btScalar distance : {btScalar(0.5), btScalar(1.5)})
		{
			{
				Parts scene(solver);
				scene.row(1, distance, weak());
				scene.step(20);
				ASSERT_TRUE(scene.m_joints[0]->isBroken());
				scene.deleteWorld();
				EXPECT_FALSE(scene.m_action->repair(scene.m_joints[0].get()));
				EXPECT_TRUE(scene.m_joints[0]->isBroken());
			}
			Parts scene(solver);
			scene.row(1, distance, weak());
			scene.step(20);
			scene.m_world->removeRigidBody(scene.m_bodies[1].get());
			EXPECT_FALSE(scene.m_action->repair(scene.m_joints[0].get()));
			EXPECT_TRUE(scene.m_joints[0]->isBroken());
			// Bullet takes these masses, and the body for one that moves.
			for (btScalar mass : {btScalar(-1), btScalar(INFINITY)})
			{
				scene.m_bodies[1]->setMassProps(mass, btVector3(1, 1, 1));
				EXPECT_FALSE(scene.m_action->repair(scene.m_joints[0].get())) << mass;
				scene.step();
			}
			scene.m_bodies[1]->setMassProps(100, btVector3(20, 20, 20));
			scene.step(3);
			// Back in the world, it can be repaired.
			scene.m_world->addRigidBody(scene.m_bodies[1].get());
			EXPECT_TRUE(scene.m_action->repair(scene.m_joints[0].get()));
			EXPECT_FALSE(scene.m_joints[0]->isBroken());
			EXPECT_EQ(1, scene.m_world->getNumConstraints());
			scene.step(20);
			EXPECT_TRUE(scene.m_joints[0]->isBroken());
		}
}

/// Draws nothing, and counts it.
struct Canvas : btIDebugDraw
{
	int m_lines = 0;

	void drawLine(const btVector3&, const btVector3&, const btVector3&) override { ++m_lines; }
	void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override {}
	void reportErrorWarning(const char*) override {}
	void draw3dText(const btVector3&, const char*) override {}
	void setDebugMode(int) override {}
	int getDebugMode() const override { return DBG_DrawWireframe | DBG_DrawConstraints | DBG_DrawConstraintLimits; }
};

TEST(Lifetimes, AJointWhoseBodyIsDeletedIsNotDrawn)
{
	for (Solver solver : SOLVERS)
	{
		Parts scene(solver);
		Canvas canvas;
		scene.m_world->setDebugDrawer(&canvas);
		scene.row(2, btScalar(1.5), strong());
		scene.step(2);
		scene.m_world->debugDrawWorld();
		const int both = canvas.m_lines;
		scene.m_world->removeConstraint(scene.m_joints[1].get());
		scene.m_world->removeRigidBody(scene.m_bodies[2].get());
		scene.m_bodies.pop_back();
		canvas.m_lines = 0;
		scene.m_world->debugDrawWorld();
		EXPECT_GT(canvas.m_lines, 0);
		EXPECT_LT(canvas.m_lines, both);
		scene.step(2);
		scene.m_world->debugDrawWorld();
		scene.m_joints.pop_back();
		scene.m_world->setDebugDrawer(nullptr);
	}
}

/// A joint that has broken at the end of a row, without its bodies overlapping.
struct Torn : Parts
{
	explicit Torn(Solver solver) : Parts(solver)
	{
		row(2, btScalar(1.5), strong());
		step();
		EXPECT_TRUE(m_action->breakJoint(*m_world, m_joints[1].get()));
		EXPECT_EQ(1, m_world->getNumConstraints());
	}
};

TEST(Lifetimes, NoRepairInAWorldThatMayBeGone)
{
	for (Solver solver : SOLVERS)
	{
		Torn scene(solver), elsewhere(solver);
		scene.m_world->removeConstraint(scene.m_joints[0].get());
		scene.deleteWorld();
		// The bodies find another world, of which the joint does not know.
		for (auto& body : scene.m_bodies)
			elsewhere.m_world->addRigidBody(body.get());
		EXPECT_FALSE(scene.m_action->repair(scene.m_joints[1].get()));
		EXPECT_TRUE(scene.m_joints[1]->isBroken());
		EXPECT_TRUE(scene.m_action->repair(*elsewhere.m_world, scene.m_joints[1].get()));
		EXPECT_FALSE(scene.m_joints[1]->isBroken());
		EXPECT_EQ(2, elsewhere.m_world->getNumConstraints());
		elsewhere.m_world->removeConstraint(scene.m_joints[1].get());
		for (auto& body : scene.m_bodies)
			elsewhere.m_world->removeRigidBody(body.get());
	}
}

TEST(Lifetimes, RepairAfterABodyHasBeenAway)
{
	for (Solver solver : SOLVERS)
	{
		Torn scene(solver);
		btRigidBody &stays = *scene.m_bodies[1], &leaves = *scene.m_bodies[2];
		btElasticPlasticJoint* const joint = scene.m_joints[1].get();
		scene.m_world->removeRigidBody(&leaves);
		EXPECT_FALSE(scene.m_action->repair(joint));
		scene.m_world->addRigidBody(&leaves);
		EXPECT_TRUE(scene.m_action->repair(joint));
		EXPECT_EQ(2, scene.m_world->getNumConstraints());
		EXPECT_TRUE(scene.m_action->breakJoint(*scene.m_world, joint));
		scene.m_world->removeConstraint(scene.m_joints[0].get());
		for (btRigidBody* body : {&stays, &leaves})
		{
			scene.m_world->removeRigidBody(body);
			scene.m_world->addRigidBody(body);
		}
		EXPECT_FALSE(scene.m_action->repair(joint));
		EXPECT_TRUE(scene.m_action->repair(*scene.m_world, joint));
		EXPECT_EQ(1, scene.m_world->getNumConstraints());
		scene.step(3);
		EXPECT_EQ(6, joint->getNumCommittedRows());
	}
}

TEST(Lifetimes, WhatIsInNoWorldStaysOutOfIt)
{
	for (Solver solver : SOLVERS)
	{
		// An action of two worlds, too, puts no joint into the one that it has never been in.
		Torn scene(solver), other(solver);
		const btElasticPlasticState broken = scene.m_joints[1]->getState(), whole = other.m_joints[0]->getState();
		other.m_world->addAction(scene.m_action.get());
		btElasticPlasticJoint* const joint = scene.m_joints[0].get();
		EXPECT_TRUE(joint->setState(broken));
		other.step();
		EXPECT_TRUE(scene.m_action->repair(joint));
		EXPECT_EQ(1, other.m_world->getNumConstraints());
		EXPECT_EQ(1, scene.m_world->getNumConstraints());
		scene.m_world->removeConstraint(scene.m_joints[0].get());
		EXPECT_TRUE(joint->setState(broken));
		scene.step();
		EXPECT_TRUE(joint->setState(whole));
		EXPECT_EQ(0, scene.m_world->getNumConstraints());
		other.m_world->removeAction(scene.m_action.get());
	}
}

TEST(Lifetimes, AnActionWithoutJointsIsDrawnInANewWorld)
{
	for (Solver solver : SOLVERS)
	{
		Parts scene(solver), other(solver);
		scene.row(1, btScalar(1.5), strong());
		scene.step();
		scene.deleteJoints();
		scene.deleteWorld();
		other.m_world->addAction(scene.m_action.get());
		Canvas canvas;
		other.m_world->setDebugDrawer(&canvas);
		other.m_world->debugDrawWorld();
		other.m_world->setDebugDrawer(nullptr);
		other.m_world->removeAction(scene.m_action.get());
	}
}

TEST(Lifetimes, AJointWhoseBodyIsDeletedIsNotRead)
{
	for (Solver solver : SOLVERS)
		for (int stepped = 0; stepped < 2; ++stepped)
		{
			Parts scene(solver);
			scene.row(3, 1, strong());
			btElasticPlasticStepControl control;
			if (stepped)
				control.step(*scene.m_world, *scene.m_action, FRAME);
			scene.m_world->removeConstraint(scene.m_joints[2].get());
			scene.m_world->removeRigidBody(scene.m_bodies[3].get());
			scene.m_bodies.pop_back();
			btAlignedObjectArray<btElasticPlasticJoint*> joints;
			scene.m_action->getJointsInWorld(*scene.m_world, joints);
			ASSERT_EQ(2, joints.size());
			EXPECT_EQ(static_cast<btElasticPlasticJoint*>(scene.m_joints[0].get()), joints[0]);
			EXPECT_EQ(static_cast<btElasticPlasticJoint*>(scene.m_joints[1].get()), joints[1]);
			Canvas canvas;
			scene.m_world->setDebugDrawer(&canvas);
			scene.m_world->debugDrawWorld();
			scene.m_world->setDebugDrawer(nullptr);
			const btElasticPlasticStepper stepper(*scene.m_world, *scene.m_action, nullptr, 0.01, FRAME);
			const std::string text = stepper.getText();
			EXPECT_EQ(0u, text.find("2 joints between 2 bodies")) << text;
			control.step(*scene.m_world, *scene.m_action, FRAME);
			EXPECT_TRUE(isFinite(*scene.m_bodies[2]));
			scene.m_joints.pop_back();
		}
}

TEST(Lifetimes, AListenerMayDeleteTheAction)
{
	for (Solver solver : SOLVERS)
		for (btScalar distance : {btScalar(0.5), btScalar(1.5)})
		{
			Diary diary;
			Parts scene(solver);
			diary.m_atBreak = [&scene] { scene.deleteAction(); };
			scene.m_action->setListener(&diary);
			scene.row(4, distance, weak());
			testing::internal::CaptureStderr();
			scene.step(20);
			// Joints that were whole have no action any more, which is printed.
			testing::internal::GetCapturedStderr();
			EXPECT_EQ(1u, diary.m_broken.size());
			EXPECT_FALSE(scene.m_action);
			for (const auto& body : scene.m_bodies)
				EXPECT_TRUE(isFinite(*body));
		}
}

TEST(Lifetimes, AListenerMayDeleteTheActionWhileAStepControlSteps)
{
	for (Solver solver : SOLVERS)
	{
		Diary diary;
		Parts scene(solver);
		diary.m_atBreak = [&scene] { scene.deleteAction(); };
		scene.m_action->setListener(&diary);
		scene.row(4, btScalar(0.5), weak());
		btElasticPlasticStepControl control;
		const btScalar erp = scene.m_world->getSolverInfo().m_erp2;
		testing::internal::CaptureStderr();
		for (int i = 0; i < 20 && scene.m_action; ++i)
			EXPECT_GT(control.step(*scene.m_world, *scene.m_action, FRAME), 0);
		testing::internal::GetCapturedStderr();
		EXPECT_EQ(1u, diary.m_broken.size());
		EXPECT_FALSE(scene.m_action);
		// What is scaled for substeps is given back.
		EXPECT_EQ(erp, scene.m_world->getSolverInfo().m_erp2);
		for (const auto& body : scene.m_bodies)
			EXPECT_TRUE(isFinite(*body));
	}
}

/// Deletes the action when it is told of a bad step.
struct Offended : btElasticPlasticListener
{
	Parts& m_scene;
	int m_numTold = 0;

	explicit Offended(Parts& scene) : m_scene(scene) {}
	void onBadStep(btScalar, const char*) override
	{
		++m_numTold;
		m_scene.deleteAction();
	}
};

TEST(Lifetimes, AListenerMayDeleteTheActionAtABadStep)
{
	for (Solver solver : SOLVERS)
	{
		Parts scene(solver);
		Offended first(scene), second(scene);
		scene.m_action->addListener(&first);
		scene.m_action->addListener(&second);
		scene.row(4, btScalar(1.5), weak());
		testing::internal::CaptureStderr();
		scene.m_world->stepSimulation(-1, 0);
		scene.step(3);
		testing::internal::GetCapturedStderr();
		EXPECT_EQ(1, first.m_numTold);
		EXPECT_EQ(0, second.m_numTold);
		EXPECT_FALSE(scene.m_action);
	}
}

TEST(Lifetimes, AListenerMayDeleteJoints)
{
	for (Solver solver : SOLVERS)
		for (btScalar distance : {btScalar(0.5), btScalar(1.5)})
		{
			Diary diary;
			Parts scene(solver);
			diary.m_atBreak = [&scene] { scene.deleteJoints(); };
			scene.m_action->setListener(&diary);
			scene.row(4, distance, weak());
			scene.step(20);
			EXPECT_EQ(1u, diary.m_broken.size());
			EXPECT_EQ(0, scene.m_action->getNumJoints());
			EXPECT_EQ(0, scene.m_world->getNumConstraints());
		}
}

TEST(Lifetimes, AListenerMayStepTheWorld)
{
	for (Solver solver : SOLVERS)
		for (btScalar distance : {btScalar(0.5), btScalar(1.5)})
		{
			Diary diary;
			Parts scene(solver);
			int depth = 0;
			diary.m_atBreak = [&scene, &depth]
			{
				if (depth == 3)
					return;
				++depth;
				scene.step();
				--depth;
			};
			scene.m_action->setListener(&diary);
			scene.row(10, distance, weak());
			scene.step(20);
			// Each break is told once.
			int broken = 0;
			for (const auto& joint : scene.m_joints)
				if (joint->isBroken())
				{
					++broken;
					EXPECT_EQ(1, std::count(diary.m_broken.begin(), diary.m_broken.end(), joint.get()));
				}
			EXPECT_GT(broken, 0);
			EXPECT_EQ(broken, int(diary.m_broken.size()));
			EXPECT_EQ(broken, scene.m_action->getNumBroken());
			for (const auto& body : scene.m_bodies)
				EXPECT_TRUE(isFinite(*body));
		}
}

TEST(Lifetimes, ABodyMayLeaveTheWorldForAWhile)
{
	for (Solver solver : SOLVERS)
	{
		Diary diary;
		Parts scene(solver);
		scene.m_action->setListener(&diary);
		scene.row(3, btScalar(1.5), strong());
		scene.step(10);
		EXPECT_NE(0, scene.m_joints[1]->getNumCommittedRows());
		scene.m_world->removeRigidBody(scene.m_bodies[2].get());
		scene.step(10);
		// Both of its joints are out of the simulation, and each is told of once. Bullet looks for a constraint's island at body A:
		// the joint of which the missing body is B is asked for rows; the other one is not asked at all.
		EXPECT_EQ(2u, diary.m_refused.size()) << int(solver);
		for (const std::string& text : diary.m_refused)
			EXPECT_NE(std::string::npos, text.find("addRigidBody")) << text;
		EXPECT_EQ(0, scene.m_joints[1]->getNumCommittedRows());
		EXPECT_EQ(0, scene.m_joints[2]->getNumCommittedRows());
		EXPECT_EQ(6, scene.m_joints[0]->getNumCommittedRows());
		// What hung on it falls by itself: 10 steps of 1/60 s at 10 m/s^2; damping is Bullet's default, none.
		EXPECT_LT(scene.m_bodies[3]->getLinearVelocity().y(), -1);
		// Put back where what hangs on it has fallen, at rest there.
		for (int i = 2; i < 4; ++i)
		{
			scene.m_bodies[i]->setCenterOfMassTransform(at(btScalar(1.5 * i), 5, 0));
			scene.m_bodies[i]->setLinearVelocity(btVector3(0, 0, 0));
			scene.m_bodies[i]->setAngularVelocity(btVector3(0, 0, 0));
		}
		scene.m_world->addRigidBody(scene.m_bodies[2].get());
		scene.step(10);
		EXPECT_EQ(2u, diary.m_refused.size());
		for (const auto& joint : scene.m_joints)
			EXPECT_EQ(6, joint->getNumCommittedRows());
		for (const auto& body : scene.m_bodies)
			EXPECT_TRUE(isFinite(*body));
		// In free fall the last body would have 1.6 m/s by now.
		EXPECT_GT(scene.m_bodies[3]->getLinearVelocity().y(), -1);
	}
}

TEST(Lifetimes, ABodyMayLeaveTheWorldBeforeItsFirstStep)
{
	for (Solver solver : SOLVERS)
		for (int first = 1; first < 4; ++first)
			for (int last = first; last < 4 && last < first + 2; ++last)
			{
				Diary diary;
				Parts scene(solver);
				scene.m_action->setListener(&diary);
				scene.row(3, btScalar(1.5), strong());
				for (int i = first; i <= last; ++i)
					scene.m_world->removeRigidBody(scene.m_bodies[i].get());
				scene.step(10);
				// Joint i is before body i + 1.
				const auto isThere = [&](int i) { return i < first || i > last; };
				int numLeftOut = 0;
				for (int i = 0; i < 3; ++i)
				{
					const bool holds = isThere(i) && isThere(i + 1);
					numLeftOut += !holds;
					EXPECT_EQ(holds ? 6 : 0, scene.m_joints[i]->getNumCommittedRows()) << first << last << i;
				}
				EXPECT_EQ(numLeftOut, int(diary.m_refused.size())) << int(solver) << first << last;
				for (const std::string& text : diary.m_refused)
					EXPECT_NE(std::string::npos, text.find("addRigidBody")) << text;
				for (int i = first; i <= last; ++i)
					scene.m_world->addRigidBody(scene.m_bodies[i].get());
				scene.step(1);
				EXPECT_EQ(numLeftOut, int(diary.m_refused.size()));
				for (const auto& joint : scene.m_joints)
					EXPECT_EQ(6, joint->getNumCommittedRows());
			}
}

/// Does something after the bodies have been moved, before the joints end their step.
struct Within : btActionInterface
{
	std::function<void()> m_what;

	void updateAction(btCollisionWorld*, btScalar) override
	{
		if (m_what)
			m_what();
		m_what = nullptr;
	}
	void debugDraw(btIDebugDraw*) override {}
};

struct WithinAStep : Parts
{
	Within m_within;

	explicit WithinAStep(Solver solver) : Parts(solver)
	{
		m_world->removeAction(m_action.get());
		m_world->addAction(&m_within);
		m_world->addAction(m_action.get());
		row(4, btScalar(1.5), strong());
		step(10);
	}

	void doWithinAStep(std::function<void()> what)
	{
		m_within.m_what = what;
		step(1);
		EXPECT_FALSE(m_within.m_what);
	}

	/// What hung on the second body falls, and the first one holds.
	void expectParted()
	{
		step(10);
		EXPECT_EQ(6, m_joints[0]->getNumCommittedRows());
		EXPECT_EQ(0, m_joints[1]->getNumCommittedRows());
		EXPECT_EQ(0, m_joints[2]->getNumCommittedRows());
		EXPECT_EQ(6, m_joints[3]->getNumCommittedRows());
		EXPECT_LT(m_bodies[4]->getLinearVelocity().y(), -1);
		for (const auto& body : m_bodies)
		{
			EXPECT_TRUE(!body || isFinite(*body));
		}
	}
};

TEST(Lifetimes, ABodyMayLeaveTheWorldWithinAStep)
{
	for (Solver solver : SOLVERS)
	{
		WithinAStep scene(solver);
		scene.doWithinAStep([&] { scene.m_world->removeRigidBody(scene.m_bodies[2].get()); });
		scene.expectParted();
	}
}

TEST(Lifetimes, ABodyMayBeDeletedWithinAStep)
{
	for (Solver solver : SOLVERS)
	{
		WithinAStep scene(solver);
		scene.doWithinAStep(
			[&]
			{
				for (int i : {1, 2})
					scene.m_world->removeConstraint(scene.m_joints[i].get());
				scene.m_world->removeRigidBody(scene.m_bodies[2].get());
				scene.m_bodies[2].reset();
			});
		scene.expectParted();
		// They are out of the world already: Bullet would look for them in the deleted body once more.
		scene.m_joints.erase(scene.m_joints.begin() + 1, scene.m_joints.begin() + 3);
		scene.m_bodies.erase(scene.m_bodies.begin() + 2);
	}
}

TEST(Lifetimes, NothingIsToldOfFibresWhoseBodyIsDeletedWithinAStep)
{
	// Inner steps crack fibres before the joints' own action ends the step.
	Diary diary;
	WithinAStep scene(Solver::Direct);
	scene.m_action->setListener(&diary);
	btElasticPlasticMaterial concrete = btElasticPlasticMaterial::steel(btScalar(30e6));
	concrete.m_tensileShare = btScalar(0.1);
	concrete.m_ultimatePlasticStrain = btScalar(1e-5);
	btElasticPlastic6DofSpring2Constraint& last = *scene.m_joints[3];
	ASSERT_TRUE(last.setCapacity(btElasticPlasticCapacity::fromMember(
		concrete, btElasticPlasticSection::rectangle(btScalar(0.3), btScalar(0.3)).withFibres(9), btScalar(0.75),
		btScalar(0.75))));
	scene.m_bodies[4]->setLinearVelocity(btVector3(20, 0, 0));
	int cracked = 0;
	scene.doWithinAStep(
		[&]
		{
			for (int i = 0; i < last.getState().m_fibres.size(); ++i)
				cracked += last.getState().m_fibres[i].m_isCracked;
			scene.m_world->removeConstraint(&last);
			scene.m_world->removeRigidBody(scene.m_bodies[4].get());
			scene.m_bodies.pop_back();
		});
	EXPECT_GT(cracked, 0);
	EXPECT_EQ(0, diary.m_cracks);
	scene.m_joints.pop_back();
}

TEST(Lifetimes, NothingIsToldOfAStepThatNobodyHasEndedOnceABodyIsDeleted)
{
	Diary diary;
	Parts scene(Solver::Direct);
	scene.m_action->setListener(&diary);
	scene.row(2, btScalar(1.5), strong());
	scene.step(2);
	btElasticPlastic6DofSpring2Constraint& last = *scene.m_joints[1];
	scene.m_world->removeAction(scene.m_action.get());
	// Inner steps make it flow, and the next step begins before anybody has heard of that.
	scene.m_bodies[2]->setLinearVelocity(btVector3(60, 0, 0));
	scene.step(2);
	ASSERT_TRUE(last.hasYielded());
	last.setReferenceToCurrentPose();
	scene.m_world->addAction(scene.m_action.get());
	scene.m_world->removeConstraint(&last);
	scene.m_world->removeRigidBody(scene.m_bodies[2].get());
	scene.m_bodies.pop_back();
	scene.step(2);
	EXPECT_EQ(0u, diary.m_broken.size());
	scene.m_joints.pop_back();
}

TEST(Lifetimes, WhatIsJoinedMayStandStillInOneIsland)
{
	for (Solver solver : SOLVERS)
	{
		Parts scene(solver);
		scene.m_world->getSimulationIslandManager()->setSplitIslands(false);
		scene.row(3, btScalar(1.5), strong());
		scene.step(3);
		for (int i = 1; i < 3; ++i)
			scene.m_bodies[i]->setMassProps(0, btVector3(0, 0, 0));
		scene.step(3);
		scene.m_bodies[3]->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
		scene.step(3);
		for (const auto& body : scene.m_bodies)
			EXPECT_TRUE(isFinite(*body));
	}
}

TEST(Lifetimes, AJointWaitsForItsBody)
{
	for (Solver solver : SOLVERS)
	{
		Diary diary;
		Parts scene(solver);
		scene.m_action->setListener(&diary);
		btRigidBody *a = scene.body(100, btVector3(0, 5, 0)), *b = scene.body(100, btVector3(btScalar(1.5), 5, 0));
		scene.m_world->addRigidBody(a);
		btElasticPlastic6DofSpring2Constraint* joint = scene.joint(*a, *b, strong());
		scene.m_world->addConstraint(joint, true);
		EXPECT_FALSE(scene.m_action->addJoint(joint));
		ASSERT_EQ(1u, diary.m_refused.size());
		EXPECT_NE(std::string::npos, diary.m_refused[0].find("addRigidBody")) << diary.m_refused[0];
		testing::internal::CaptureStderr();
		scene.step(10);
		EXPECT_EQ("", testing::internal::GetCapturedStderr());
		EXPECT_EQ(1u, diary.m_refused.size());
		// Free fall.
		EXPECT_NEAR(-10. / 6, a->getLinearVelocity().y(), 1e-5);
		EXPECT_EQ(0, b->getLinearVelocity().y());
		scene.m_world->addRigidBody(b);
		b->setCenterOfMassTransform(at(btScalar(1.5), a->getCenterOfMassPosition().y(), 0));
		EXPECT_TRUE(scene.m_action->addJoint(joint));
		EXPECT_FALSE(joint->fault());
		scene.step(1);
		// Now both fall as one: the joint has shared out the first one's velocity.
		EXPECT_EQ(6, joint->getNumCommittedRows());
		EXPECT_LT(b->getLinearVelocity().y(), -10. / 60 - 0.1);
		EXPECT_TRUE(isFinite(*a) && isFinite(*b));
	}
}

TEST(Lifetimes, ABodyIsNotJoinedToItself)
{
	for (Solver solver : SOLVERS)
	{
		Diary diary;
		Parts scene(solver);
		scene.m_action->setListener(&diary);
		btRigidBody* body = scene.body(100, btVector3(0, 5, 0));
		scene.m_world->addRigidBody(body);
		scene.m_joints.emplace_back(
			new btElasticPlastic6DofSpring2Constraint(*body, *body, at(btScalar(0.2)), at(btScalar(-0.2))));
		EXPECT_FALSE(scene.m_joints[0]->setCapacity(strong()));
		scene.m_world->addConstraint(scene.m_joints[0].get(), true);
		EXPECT_FALSE(scene.m_action->addJoint(scene.m_joints[0].get()));
		EXPECT_EQ(0, scene.m_action->getNumJoints());
		ASSERT_EQ(1u, diary.m_refused.size());
		EXPECT_NE(std::string::npos, diary.m_refused[0].find("joined to itself")) << diary.m_refused[0];
		scene.step(10);
		EXPECT_NEAR(-10. / 6, body->getLinearVelocity().y(), 1e-5);
		EXPECT_EQ(0, body->getAngularVelocity().length());
	}
}

TEST(Lifetimes, AJointThatTheUserHasPutBackIsRepairedWhereItIs)
{
	for (Solver solver : SOLVERS)
		for (const bool byState : {false, true})
		{
			Torn scene(solver);
			const btElasticPlasticState whole = scene.m_joints[0]->getState();
			btElasticPlasticJoint* const joint = scene.m_joints[1].get();
			const int others = scene.m_world->getNumConstraints();
			scene.m_world->addConstraint(scene.m_joints[1].get(), true);
			if (byState)
				EXPECT_TRUE(joint->setState(whole));
			else
				EXPECT_TRUE(scene.m_action->repair(joint));
			// It was there twice, and once it had been removed and deleted the world had it still.
			EXPECT_EQ(others + 1, scene.m_world->getNumConstraints());
			scene.m_world->removeConstraint(scene.m_joints[1].get());
			scene.m_joints.pop_back();
			scene.step(3);
			EXPECT_EQ(others, scene.m_world->getNumConstraints());
		}
}

TEST(Lifetimes, AnActionThatGoesToAnotherWorldLeavesNoSpringsBehind)
{
	for (Solver solver : SOLVERS)
	{
		Diary diary;
		Parts scene(solver), elsewhere(solver);
		scene.m_action->setListener(&diary);
		scene.row(2, 1, strong());
		scene.m_world->setGravity(btVector3(0, 0, 0));
		scene.step(5);
		scene.m_world->removeAction(scene.m_action.get());
		elsewhere.m_world->addAction(scene.m_action.get());
		for (int i = 0; i < 10; ++i)
		{
			scene.step();
			elsewhere.step();
		}
		// The substeps in which nobody has committed the joints are three at most.
		EXPECT_EQ(2u, diary.m_refused.size()) << "solver " << int(solver);
		EXPECT_EQ(0, scene.m_joints[0]->getNumCommittedRows());
		elsewhere.m_world->removeAction(scene.m_action.get());
	}
}
}  // namespace testLifetimes
