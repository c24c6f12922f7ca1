// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticStepper.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include <vector>

#include "BulletCollision/CollisionShapes/btCollisionShape.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "LinearMath/btHashMap.h"

/// A world as far as it matters to what can be left out.
struct btElasticPlasticStepper::Sight
{
	int m_joints = 0;
	int m_bodies = 0;     ///< that are joined and move
	int m_depth = 0;      ///< joints from a support to the body farthest from it; without supports: 0
	int m_stiff = 0;      ///< degrees of freedom whose period is shorter than two steps
	int m_springs = 0;    ///< degrees of freedom that spring
	int m_endless = 0;    ///< degrees of freedom that never yield
	int m_colliding = 0;  ///< joined bodies that may touch others
	double m_shortest = SIMD_INFINITY, m_longest = 0;  ///< periods of single degrees of freedom [s]
	double m_massRatio = 1;                            ///< the largest between neighbours
	double m_slenderness = 0;  ///< length of a body along its joint over its least edge, the largest
};

namespace
{
/// A = J M^-1 J^T of one degree of freedom by itself.
double mobility(const btElasticPlasticJoint& joint, int dof)
{
	const btTransform frame = joint.getFrameA();
	const btVector3 axis = frame.getBasis().getColumn(dof % 3);
	const btRigidBody* const bodies[] = {&joint.getConstraint().getRigidBodyA(),
										 &joint.getConstraint().getRigidBodyB()};
	double sum = 0;
	for (const btRigidBody* body : bodies)
	{
		const btVector3 turn = dof < 3 ? (joint.getPosition() - body->getCenterOfMassPosition()).cross(axis) : axis;
		sum += double(turn.dot(body->getInvInertiaTensorWorld() * turn)) + (dof < 3 ? double(body->getInvMass()) : 0.);
	}
	return sum;
}

/// How many joints lie between the supports and the body that is farthest from them.
int depthOf(btElasticPlasticAction& action)
{
	btHashMap<btHashPtr, int> index;
	std::vector<std::vector<int>> neighbours;
	std::vector<int> depth, queue;
	const auto nodeOf = [&](const btRigidBody& body)
	{
		if (const int* const known = index.find(btHashPtr(&body)))
			return *known;
		const int node = int(neighbours.size());
		index.insert(btHashPtr(&body), node);
		neighbours.emplace_back();
		depth.push_back(body.getInvMass() == 0 ? 0 : -1);
		if (depth.back() == 0)
			queue.push_back(node);
		return node;
	};
	for (int i = action.getNumJoints() - action.getNumBroken() - 1; i >= 0; --i)
	{
		const btTypedConstraint& constraint = action.getJoint(i)->getConstraint();
		const int a = nodeOf(constraint.getRigidBodyA()), b = nodeOf(constraint.getRigidBodyB());
		neighbours[a].push_back(b);
		neighbours[b].push_back(a);
	}
	int deepest = 0;
	for (size_t head = 0; head < queue.size(); ++head)
		for (const int next : neighbours[queue[head]])
			if (depth[next] < 0)
			{
				deepest = depth[next] = depth[queue[head]] + 1;
				queue.push_back(next);
			}
	return deepest;
}
}  // namespace

btElasticPlasticStepper::Sight btElasticPlasticStepper::look() const
{
	Sight sight;
	btHashMap<btHashPtr, int> seen;
	for (int i = m_action.getNumJoints() - m_action.getNumBroken() - 1; i >= 0; --i)
	{
		const btElasticPlasticJoint& joint = *m_action.getJoint(i);
		++sight.m_joints;
		const btRigidBody* const bodies[] = {&joint.getConstraint().getRigidBodyA(),
											 &joint.getConstraint().getRigidBodyB()};
		for (const btRigidBody* body : bodies)
		{
			if (body->getInvMass() == 0 || seen.find(btHashPtr(body)))
				continue;
			seen.insert(btHashPtr(body), 1);
			++sight.m_bodies;
			btVector3 low, high;
			body->getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
			const btVector3 size = high - low;
			sight.m_slenderness =
				btMax(sight.m_slenderness, double(size[size.maxAxis()] / btMax(size[size.minAxis()], SIMD_EPSILON)));
			sight.m_colliding += body->getBroadphaseProxy() && body->getBroadphaseProxy()->m_collisionFilterMask != 0;
		}
		const double inverse[] = {double(bodies[0]->getInvMass()), double(bodies[1]->getInvMass())};
		if (inverse[0] > 0 && inverse[1] > 0)
			sight.m_massRatio = btMax(sight.m_massRatio, btMax(inverse[0], inverse[1]) / btMin(inverse[0], inverse[1]));
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		{
			const btElasticPlasticCapacity& capacity = joint.getCapacity();
			if (!capacity.isElasticPlastic(dof))
				continue;
			sight.m_endless += capacity.m_yield[dof] >= btElasticPlasticCapacity::unlimited();
			if (capacity.isRigidPlastic(dof))
				continue;
			++sight.m_springs;
			const double period = 2 * SIMD_PI / sqrt(double(capacity.m_stiffness[dof]) * mobility(joint, dof));
			sight.m_stiff += period < 2 * double(m_step);
			sight.m_shortest = btMin(sight.m_shortest, period);
			sight.m_longest = btMax(sight.m_longest, period);
		}
	}
	sight.m_depth = depthOf(m_action);
	return sight;
}

btElasticPlasticStepper::btElasticPlasticStepper(btDynamicsWorld& world, btElasticPlasticAction& action,
												 btElasticPlasticConstraintSolver* solver, double error, btScalar step)
	: m_world(world), m_action(action), m_control(error), m_step(step)
{
	const Sight sight = look();
	tell(
		"%d joints between %d bodies; up to %d joints from a support; neighbours' masses up to %.3g : 1; bodies up to "
		"%.3g times longer than thick\n",
		sight.m_joints, sight.m_bodies, sight.m_depth, sight.m_massRatio, sight.m_slenderness);
	tellMistakes(sight, solver);
	tellSolver(sight, solver);
	tellRest(sight);
}

void btElasticPlasticStepper::tell(const char* format, ...)
{
	char line[512];
	va_list values;
	va_start(values, format);
	vsnprintf(line, sizeof line, format, values);
	va_end(values);
	m_text += line;
}

void btElasticPlasticStepper::tellMistakes(const Sight& sight, const btElasticPlasticConstraintSolver* solver)
{
	if (!(m_step > 0) || !btElasticPlasticIsFinite(m_step))
		tell("mistake: the step is %g s; it must be finite and > 0, or step() does nothing\n", double(m_step));
	if (solver && solver != m_world.getConstraintSolver())
		tell("mistake: the solver is not the world's; give the one that the world was made with, or null\n");
	if (sight.m_joints == 0)
		tell("mistake: the action has no joints; call btElasticPlasticAction::addJoint before\n");
}

void btElasticPlasticStepper::tellSolver(const Sight& sight, btElasticPlasticConstraintSolver* solver)
{
	if (!solver || solver != m_world.getConstraintSolver())
	{
		tell("direct solve: left as the world's solver does it; Bullet's own reaches %d joints in a step\n",
			 m_world.getSolverInfo().m_numIterations);
		return;
	}
	solver->setForm(BT_EP_DIRECT);
	// Gauss-Seidel on a chain of n springs takes n^2 iterations and more.
	if (sight.m_depth > 1)
		tell("direct solve: kept; to carry a force through %d joints takes iterations about %.0f\n", sight.m_depth,
			 double(sight.m_depth) * sight.m_depth);
	else
		tell("direct solve: kept; for joints by themselves it takes as long as 10 iterations\n");
	if (sight.m_colliding > 0)
		tell(
			"contacts in the direct solve: kept; %d joined bodies may be touched, and contacts solved apart do not see "
			"the structure behind them\n",
			sight.m_colliding);
	else
		tell("contacts in the direct solve: none; no joined body collides\n");
}

void btElasticPlasticStepper::tellRest(const Sight& sight)
{
	tell(
		"substeps: left out; back when something may flow that a step of %.3g ms would get wrong by more than %.3g %%, "
		"or when a joined body is about to be hit\n",
		1e3 * double(m_step), 100 * m_control.getError());
	if (sight.m_springs > 0)
		tell("elastic part: kept; of %d springs with periods from %.3g to %.3g ms the step damps %d, at no cost\n",
			 sight.m_springs, 1e3 * sight.m_shortest, 1e3 * sight.m_longest, sight.m_stiff);
	else if (sight.m_joints > 0)
		tell("elastic part: none; all joints are rigid-plastic\n");
	tell("shear and torsion: kept; a degree of freedom left out is free, and half of them cost a tenth of a step\n");
	if (sight.m_endless > 0)
		tell("yield: left out of %d degrees of freedom, which have no limit\n", sight.m_endless);
	tell("energies and events: kept; they cost less than a hundredth of a step\n");
	tell("continuous collision detection: left out; substeps come before a joined body is hit\n");
}
