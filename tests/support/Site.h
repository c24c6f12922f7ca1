// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_SITE_H
#define EP_TEST_SITE_H

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "BulletCollision/CollisionDispatch/btCollisionDispatcherMt.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlastic6DofSpring2Constraint.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticAction.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticMultiBodyConstraintSolver.h"
#include "BulletDynamics/Dynamics/btDiscreteDynamicsWorldMt.h"
#include "BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h"
#include "BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h"
#include "BulletSoftBody/btSoftRigidDynamicsWorld.h"
#include "LinearMath/btThreads.h"
#include "btBulletDynamicsCommon.h"
#include "support/Run.h"

namespace ep
{
const btScalar GRAVITY = 10;

enum class Kind
{
	Discrete,
	Multithreaded,
	SoftRigid,
	MultiBody
};

inline const char* nameOf(Kind kind)
{
	const char* const names[] = {"btDiscreteDynamicsWorld", "btDiscreteDynamicsWorldMt", "btSoftRigidDynamicsWorld",
								 "btMultiBodyDynamicsWorld"};
	return names[int(kind)];
}

/// One of Bullet's worlds with our solver, and what stands in it.
struct Site
{
	btSoftBodyRigidBodyCollisionConfiguration m_configuration;  // knows rigid bodies, too
	std::unique_ptr<btCollisionDispatcher> m_dispatcher{new btCollisionDispatcher(&m_configuration)};
	btDbvtBroadphase m_broadphase;
	std::unique_ptr<btConstraintSolver> m_solver;
	std::unique_ptr<btDiscreteDynamicsWorld> m_world;
	btElasticPlasticAction m_action;
	std::vector<std::unique_ptr<btCollisionShape>> m_shapes;
	std::vector<std::unique_ptr<btRigidBody>> m_bodies;
	std::vector<std::unique_ptr<btElasticPlastic6DofSpring2Constraint>> m_joints;

	explicit Site(Kind kind, const btVector3& gravity = btVector3(0, -GRAVITY, 0))
	{
		switch (kind)
		{
			case Kind::Discrete:
				m_solver.reset(new btElasticPlasticConstraintSolver);
				m_world.reset(
					new btDiscreteDynamicsWorld(m_dispatcher.get(), &m_broadphase, m_solver.get(), &m_configuration));
				break;
			case Kind::Multithreaded:
				setScheduler();
				setPool(makePool(2).release());
				break;
			case Kind::SoftRigid:
				m_solver.reset(new btElasticPlasticConstraintSolver);
				m_world.reset(
					new btSoftRigidDynamicsWorld(m_dispatcher.get(), &m_broadphase, m_solver.get(), &m_configuration));
				break;
			case Kind::MultiBody:
			{
				auto* const solver = new btElasticPlasticMultiBodyConstraintSolver;
				m_solver.reset(solver);
				m_world.reset(
					new btMultiBodyDynamicsWorld(m_dispatcher.get(), &m_broadphase, solver, &m_configuration));
				break;
			}
		}
		begin(gravity);
	}
	/// A world of Bullet's with threads, which takes its solvers from a pool.
	explicit Site(std::unique_ptr<btConstraintSolverPoolMt> pool)
	{
		setScheduler();
		m_dispatcher.reset(new btCollisionDispatcherMt(&m_configuration));
		setPool(pool.release());
		begin(btVector3(0, -GRAVITY, 0));
	}
	~Site()
	{
		for (auto& joint : m_joints)
			m_world->removeConstraint(joint.get());
		for (auto& body : m_bodies)
			m_world->removeRigidBody(body.get());
		m_world->removeAction(&m_action);
	}

	btRigidBody& body(btScalar mass, const btVector3& size, const btTransform& pose)
	{
		m_shapes.emplace_back(new btBoxShape(size / 2));
		btVector3 inertia(0, 0, 0);
		if (mass > 0)
			m_shapes.back()->calculateLocalInertia(mass, inertia);
		m_bodies.emplace_back(new btRigidBody(mass, nullptr, m_shapes.back().get(), inertia));
		m_bodies.back()->setCenterOfMassTransform(pose);
		m_bodies.back()->setInterpolationWorldTransform(pose);
		m_bodies.back()->setActivationState(DISABLE_DEACTIVATION);
		m_world->addRigidBody(m_bodies.back().get());
		return *m_bodies.back();
	}

	btElasticPlasticJoint& join(btRigidBody& a, btRigidBody& b, const btTransform& frame,
								const btElasticPlasticCapacity& capacity)
	{
		m_joints.emplace_back(new btElasticPlastic6DofSpring2Constraint(a, b, a.getWorldTransform().inverse() * frame,
																		b.getWorldTransform().inverse() * frame));
		EXPECT_TRUE(m_joints.back()->setCapacity(capacity));
		m_world->addConstraint(m_joints.back().get(), true);
		EXPECT_TRUE(m_action.addJoint(m_joints.back().get()));
		return *m_joints.back();
	}

	void run(int steps)
	{
		for (int i = 0; i < steps; ++i)
			m_world->stepSimulation(FRAME, 0);
	}

	/// A pool of so many of our solvers.
	template <class Pool = btConstraintSolverPoolMt>
	static std::unique_ptr<btConstraintSolverPoolMt> makePool(int count)
	{
		std::vector<btConstraintSolver*> solvers;  // which the pool deletes
		for (int i = 0; i < count; ++i)
			solvers.push_back(new btElasticPlasticConstraintSolver);
		return std::unique_ptr<btConstraintSolverPoolMt>(new Pool(solvers.data(), count));
	}

private:
	/// Bullet's worlds with threads have none of themselves.
	static void setScheduler()
	{
		if (!btGetTaskScheduler())
			btSetTaskScheduler(btGetSequentialTaskScheduler());
	}
	void setPool(btConstraintSolverPoolMt* pool)
	{
		m_solver.reset(pool);
		m_world.reset(
			new btDiscreteDynamicsWorldMt(m_dispatcher.get(), &m_broadphase, pool, nullptr, &m_configuration));
	}
	void begin(const btVector3& gravity)
	{
		m_world->setGravity(gravity);
		m_world->addAction(&m_action);
	}
};
}  // namespace ep

#endif  // EP_TEST_SITE_H
