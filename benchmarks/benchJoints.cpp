// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// What a joint costs in a step: set-up, 10 iterations and finish of the solver, without and with our commit; chains and walls
// of blocks.
// All kinds of joints take turns in one benchmark, so that ratios hold on a noisy machine.

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "StiffStructure.h"
#include "world/World.h"

namespace benchJoints
{
using namespace ep;

enum class Kind
{
	Fixed,           // btFixedConstraint
	Spring2,         // btGeneric6DofSpring2Constraint, six springs
	ElasticPlastic,  // first class, Bullet's own solver
	ElasticPlastic2,
	ElasticPlastic2Ours,  // second class, our solver
	HalfBroken,           // second class, every other joint broken
	AllBroken,            // what bodies cost without any joint
	Count
};
const char* const NAMES[] = {"fixed", "spring2", "ep", "ep2", "ep2_ours", "half_broken", "all_broken"};

/// Blocks of concrete side by side in a row, or in a wall of running joints, and what holds them.
class Structure
{
public:
	Structure(Kind kind, bool wall, int joints)
		: m_kind(kind), m_world(kind == Kind::ElasticPlastic2Ours ? Solver::Iterative : Solver::Stock)
	{
		const int height = wall ? std::max(2, int(sqrt(joints / 2.))) : 1, width = wall ? height : joints;
		btCollisionShape* block = m_world.box(btVector3(1, 1, 1));
		btRigidBody* ground = m_world.body(0, block, btTransform::getIdentity(), false);
		std::vector<btRigidBody*> bodies(width * height);
		const btQuaternion along(0, 0, 0, 1), up(btVector3(0, 0, 1), SIMD_HALF_PI);
		for (int y = 0; y < height; ++y)
			for (int x = 0; x < width; ++x)
			{
				const btVector3 place(btScalar(x + 1), btScalar(y), 0), half(btScalar(0.5), 0, 0);
				btRigidBody*& body = bodies[y * width + x];
				body = m_world.body(2000, block, btTransform(along, place), false);
				if (x > 0 || !wall)
					join(x > 0 ? *bodies[y * width + x - 1] : *ground, *body, btTransform(along, place - half));
				if (wall)
					join(y > 0 ? *bodies[(y - 1) * width + x] : *ground, *body,
						 btTransform(up, place - btVector3(0, btScalar(0.5), 0)));
			}
		// To be in the middle of things, half of the joints broken where they are to be. All bodies move differently, in all
		// directions: where nothing happens, numbers die out into denormal ones, which cost ten times as much.
		unsigned random = 1;
		const auto next = [&random]
		{
			return btScalar(1e-3) *
				   (btScalar((random = random * 1664525u + 1013904223u) >> 8) / btScalar(1 << 24) - btScalar(0.5));
		};
		for (int i = 0; i < 10; ++i)
		{
			m_velocities.clear();
			for (const auto& body : m_world.bodies())
			{
				m_velocities.push_back({btVector3(next(), next(), next()), btVector3(next(), next(), next())});
				body->setLinearVelocity(m_velocities.back().first);
				body->setAngularVelocity(m_velocities.back().second);
			}
			m_world.step(btScalar(1) / 60);
		}
		for (const auto& body : m_world.bodies())
			m_bodies.push_back(body.get());
		for (int i = 0; i < m_world.bullet().getNumConstraints(); ++i)
			m_constraints.push_back(m_world.bullet().getConstraint(i));
		// All ten iterations, whether or not there is anything left to do.
		m_world.bullet().getSolverInfo().m_leastSquaresResidualThreshold = -1;
	}

	int joints() const { return m_joints; }

	struct Times
	{
		double m_solver, m_all;  ///< [s]
	};

	Times step()
	{
		for (size_t i = 0; i < m_velocities.size(); ++i)
		{
			btRigidBody& body = *m_world.bodies()[i];
			body.setLinearVelocity(m_velocities[i].first);
			body.setAngularVelocity(m_velocities[i].second);
			body.setInterpolationLinearVelocity(m_velocities[i].first);
			body.setInterpolationAngularVelocity(m_velocities[i].second);
			body.applyGravity();
		}
		btDiscreteDynamicsWorld& world = m_world.bullet();
		world.getSolverInfo().m_timeStep = btScalar(1) / 60;
		const auto begin = std::chrono::steady_clock::now();
		world.getConstraintSolver()->solveGroup(m_bodies.data(), int(m_bodies.size()), nullptr, 0, m_constraints.data(),
												int(m_constraints.size()), world.getSolverInfo(), nullptr,
												world.getDispatcher());
		const auto solved = std::chrono::steady_clock::now();
		if (m_kind != Kind::Fixed && m_kind != Kind::Spring2)
			m_world.action().updateAction(&world, btScalar(1) / 60);
		const auto end = std::chrono::steady_clock::now();
		world.clearForces();
		return {std::chrono::duration<double>(solved - begin).count(),
				std::chrono::duration<double>(end - begin).count()};
	}

private:
	void join(btRigidBody& a, btRigidBody& b, const btTransform& frame)
	{
		const int index = m_joints++;
		btElasticPlasticCapacity capacity =
			btElasticPlasticCapacity::fromMember(btElasticPlasticMaterial::reinforcedConcrete(btScalar(0.01)),
												 btElasticPlasticSection::rectangle(1, 1), 1, 1);
		for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
			capacity.m_ductility[i] = btElasticPlasticCapacity::unlimited();
		if (m_kind == Kind::Fixed || m_kind == Kind::Spring2)
		{
			const JointKind kind = m_kind == Kind::Fixed ? kinds::Rigid : kinds::Spring2;
			m_world.add(makeBulletsOwn(kind, a, b, frame, capacity));
			return;
		}
		if (m_kind == Kind::AllBroken || (m_kind == Kind::HalfBroken && index % 2))
		{
			capacity.scaleYield(btScalar(1e-6));
			for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
				capacity.m_ductility[i] = btScalar(1e-9);
		}
		m_world.joint(a, b, frame, capacity, m_kind == Kind::ElasticPlastic ? JointClass::Spring : JointClass::Spring2);
	}

	Kind m_kind;
	World m_world;
	int m_joints = 0;
	std::vector<btCollisionObject*> m_bodies;
	std::vector<btTypedConstraint*> m_constraints;
	std::vector<std::pair<btVector3, btVector3>> m_velocities;
};

void Joints(benchmark::State& state, bool wall)
{
	std::vector<std::unique_ptr<Structure>> structures;
	for (int kind = 0; kind < int(Kind::Count); ++kind)
		structures.emplace_back(new Structure(Kind(kind), wall, int(state.range(0))));
	std::vector<double> solver[int(Kind::Count)], all[int(Kind::Count)];
	for (auto _ : state)
	{
		double round = 0;
		for (int kind = 0; kind < int(Kind::Count); ++kind)
		{
			// From a warm state: a game's joints are of one kind, its code and data were there in the last step.
			structures[kind]->step();
			const Structure::Times times = structures[kind]->step();
			solver[kind].push_back(times.m_solver);
			all[kind].push_back(times.m_all);
			round += times.m_all;
		}
		state.SetIterationTime(round);
	}
	const auto whole = [&](Kind kind) { return medianOf(all[int(kind)]); };
	const double joints = structures[0]->joints();
	const double spring2 = medianOf(solver[int(Kind::Spring2)]), spring2Whole = whole(Kind::Spring2);
	for (int kind = 0; kind < int(Kind::Count); ++kind)
		state.counters[std::string("ns_") + NAMES[kind]] = 1e9 * whole(Kind(kind)) / joints;
	for (Kind kind : {Kind::ElasticPlastic, Kind::ElasticPlastic2, Kind::ElasticPlastic2Ours})
	{
		const std::string name = NAMES[int(kind)];
		state.counters[name + "/spring2"] = medianOf(solver[int(kind)]) / spring2;
		state.counters[name + "+commit/spring2"] = whole(kind) / spring2Whole;
	}
	state.counters["all_broken/whole"] = whole(Kind::AllBroken) / whole(Kind::ElasticPlastic2);
	state.counters["half_broken/whole"] = whole(Kind::HalfBroken) / whole(Kind::ElasticPlastic2);
	state.counters["bytes_spring2"] = sizeof(btGeneric6DofSpring2Constraint);
	state.counters["bytes_ep"] = sizeof(btElasticPlastic6DofSpringConstraint);
	state.counters["bytes_ep2"] = sizeof(btElasticPlastic6DofSpring2Constraint);
}

BENCHMARK_CAPTURE(Joints, chain, false)
	->Arg(100)
	->Arg(1000)
	->Arg(10000)
	->UseManualTime()
	->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Joints, wall, true)->Arg(100)->Arg(1000)->Arg(10000)->UseManualTime()->Unit(benchmark::kMillisecond);
}  // namespace benchJoints
