// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "SceneSurvey.h"

#include <math.h>

#include <vector>

#include "../../btElasticPlasticJoint.h"
#include "BulletCollision/CollisionShapes/btCollisionShape.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "LinearMath/btHashMap.h"

namespace btElasticPlastic
{
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

/// The number of joints between the supports and the body that is farthest from them.
int depthOf(const btAlignedObjectArray<btElasticPlasticJoint*>& joints)
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
	for (int i = joints.size() - 1; i >= 0; --i)
	{
		const btTypedConstraint& constraint = joints[i]->getConstraint();
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

SceneSurvey surveyScene(const btAlignedObjectArray<btElasticPlasticJoint*>& joints, double step)
{
	SceneSurvey survey;
	btHashMap<btHashPtr, int> seen;
	for (int i = joints.size() - 1; i >= 0; --i)
	{
		const btElasticPlasticJoint& joint = *joints[i];
		++survey.m_joints;
		const btRigidBody* const bodies[] = {&joint.getConstraint().getRigidBodyA(),
											 &joint.getConstraint().getRigidBodyB()};
		for (const btRigidBody* body : bodies)
		{
			if (body->getInvMass() == 0 || seen.find(btHashPtr(body)))
				continue;
			seen.insert(btHashPtr(body), 1);
			++survey.m_bodies;
			btVector3 low, high;
			body->getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
			const btVector3 size = high - low;
			survey.m_slenderness =
				btMax(survey.m_slenderness, double(size[size.maxAxis()] / btMax(size[size.minAxis()], SIMD_EPSILON)));
			survey.m_colliding += body->getBroadphaseProxy() && body->getBroadphaseProxy()->m_collisionFilterMask != 0;
		}
		const double inverse[] = {double(bodies[0]->getInvMass()), double(bodies[1]->getInvMass())};
		if (inverse[0] > 0 && inverse[1] > 0)
			survey.m_massRatio =
				btMax(survey.m_massRatio, btMax(inverse[0], inverse[1]) / btMin(inverse[0], inverse[1]));
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		{
			const btElasticPlasticCapacity& capacity = joint.getCapacity();
			if (!capacity.isElasticPlastic(dof))
				continue;
			survey.m_endless += capacity.m_yield[dof] >= btElasticPlasticCapacity::unlimited();
			if (capacity.isRigidPlastic(dof))
				continue;
			++survey.m_springs;
			const double period = 2 * SIMD_PI / sqrt(double(capacity.m_stiffness[dof]) * mobility(joint, dof));
			survey.m_stiff += period < 2 * step;
			survey.m_shortest = btMin(survey.m_shortest, period);
			survey.m_longest = btMax(survey.m_longest, period);
		}
	}
	survey.m_depth = depthOf(joints);
	return survey;
}
}  // namespace btElasticPlastic
