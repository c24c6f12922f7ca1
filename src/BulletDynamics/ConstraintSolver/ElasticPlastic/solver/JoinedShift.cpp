// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "JoinedShift.h"

#include "../joint/BodyLoad.h"
#include "../joint/JointWorks.h"

namespace btElasticPlastic
{
namespace
{
bool wasLonger(const JointWorks& joint, btScalar h) { return joint.m_model.m_state.m_lastStep > btScalar(1.01) * h; }

/// By component what two loads have in common.
btVector3 lesserOf(const btVector3& a, const btVector3& b)
{
	btVector3 lesser(0, 0, 0);
	for (int k = 0; k < 3; ++k)
		if (a[k] * b[k] > 0)
			lesser[k] = btFabs(a[k]) < btFabs(b[k]) ? a[k] : b[k];
	return lesser;
}
}  // namespace

bool JoinedShift::isWanted(const SolverGroup& island, btScalar h)
{
	for (int i = 0; i < island.m_numConstraints; ++i)
		if (island.m_joints[i] && wasLonger(*island.m_joints[i], h))
			return true;
	return false;
}

void JoinedShift::collect(const SolverGroup& island, int numBodies, btScalar h)
{
	m_bodies.assign(size_t(numBodies), Body());
	m_joints.clear();
	for (int i = 0; i < island.m_numConstraints; ++i)
	{
		btTypedConstraint& constraint = *island.m_constraints[i];
		if (!constraint.isEnabled())
			continue;
		int bodies[2];
		for (int side = 0; side < 2; ++side)
		{
			const btRigidBody& body = side == 0 ? constraint.getRigidBodyA() : constraint.getRigidBodyB();
			const bool isHere = !body.isStaticOrKinematicObject() && body.getCompanionId() < numBodies;
			bodies[side] = isHere ? body.getCompanionId() : -1;
		}
		JointWorks* const works = island.m_joints[i];
		if (works && wasLonger(*works, h) && !works->hasBaseRows())
			addJoint(*works, bodies, h);
		else
			for (const int body : bodies)
				if (body >= 0)
					leaveOut(body);
	}
}

void JoinedShift::addJoint(JointWorks& works, const int bodies[2], btScalar h)
{
	const btElasticPlasticState& state = works.m_model.m_state;
	const btScalar time = (state.m_lastStep - h) / 2, before = (state.m_lastStep + h) / 2;
	Joint joint = {&works, {bodies[0], bodies[1]}, Kinematics(), btVector3(0, 0, 0), btVector3(0, 0, 0)};
	works.m_model.measure(joint.m_kinematics);
	for (int k = 0; k < 3; ++k)
	{
		const btVector3& axis = joint.m_kinematics.m_axis[k];
		joint.m_impulse += axis * (time * (state.m_force[k] - before * state.m_forceRate[k]));
		joint.m_twist += axis * (time * (state.m_force[3 + k] - before * state.m_forceRate[3 + k]));
	}
	for (int side = 0; side < 2; ++side)
	{
		if (bodies[side] < 0)
			continue;
		Body& body = m_bodies[size_t(bodies[side])];
		const btScalar sign = side == 0 ? btScalar(1) : btScalar(-1);
		const btVector3& arm = side == 0 ? joint.m_kinematics.m_rA : joint.m_kinematics.m_rB;
		const btScalar* const load = state.m_load[side];
		body.m_time = time;
		body.m_impulse += joint.m_impulse * sign;
		body.m_twist += (arm.cross(joint.m_impulse) + joint.m_twist) * sign;
		body.m_force.setValue(load[0], load[1], load[2]);
		body.m_torque.setValue(load[3], load[4], load[5]);
	}
	m_joints.push_back(joint);
}

bool JoinedShift::isAnyLeftOut() const
{
	for (const Body& body : m_bodies)
		if (body.m_isLeftOut)
			return true;
	return false;
}

bool JoinedShift::hasSupport() const
{
	for (const Joint& joint : m_joints)
		if (joint.m_bodies[0] < 0 || joint.m_bodies[1] < 0)
			return true;
	return false;
}

double JoinedShift::apply(int number, btRigidBody& body)
{
	Body& share = m_bodies[size_t(number)];
	if (share.m_isLeftOut || share.m_time == 0)
		return 0;
	share.m_body = &body;
	const btVector3 load = (weightOf(body) + lesserOf(share.m_force, forceBesideWeight(body))) * share.m_time,
					turn = lesserOf(share.m_torque, body.getTotalTorque()) * share.m_time,
					linear = (share.m_impulse + load) * body.getInvMass() * body.getLinearFactor(),
					angular = body.getInvInertiaTensorWorld() * (share.m_twist + turn) * body.getAngularFactor();
	share.m_meanLinear = body.getLinearVelocity() + linear / 2;
	share.m_meanAngular = body.getAngularVelocity() + angular / 2;
	body.setLinearVelocity(body.getLinearVelocity() + linear);
	body.setAngularVelocity(body.getAngularVelocity() + angular);
	return double(load.dot(share.m_meanLinear)) + double(turn.dot(share.m_meanAngular));
}

void JoinedShift::bookWork()
{
	for (const Joint& joint : m_joints)
		for (int side = 0; side < 2; ++side)
		{
			const Body* const body = joint.m_bodies[side] >= 0 ? &m_bodies[size_t(joint.m_bodies[side])] : nullptr;
			if (!body || !body->m_body)
				continue;
			const btVector3& arm = side == 0 ? joint.m_kinematics.m_rA : joint.m_kinematics.m_rB;
			const btVector3 way = body->m_meanLinear + body->m_meanAngular.cross(arm);
			const double given = double(joint.m_impulse.dot(way)) + double(joint.m_twist.dot(body->m_meanAngular));
			joint.m_works->m_model.m_state.m_work -= side == 0 ? given : -given;
		}
}
}  // namespace btElasticPlastic
