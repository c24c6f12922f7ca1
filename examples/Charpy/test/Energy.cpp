// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "test/Energy.h"

namespace ep::charpy
{
namespace
{
void clear(btJointFeedback& feedback)
{
	feedback.m_appliedForceBodyA = feedback.m_appliedTorqueBodyA = btVector3(0, 0, 0);
	feedback.m_appliedForceBodyB = feedback.m_appliedTorqueBodyB = btVector3(0, 0, 0);
}
}  // namespace

int Energy::watch(btTypedConstraint& constraint)
{
	m_constraints.push_back({&constraint, btJointFeedback(), 0});
	constraint.setJointFeedback(&m_constraints.back().feedback);
	return int(m_constraints.size()) - 1;
}

void Energy::reset()
{
	m_contact = m_friction = m_integration = 0;
	for (Constraint& c : m_constraints)
		c.work = 0;
}

double Energy::potential(const btRigidBody& body)
{
	if (body.getInvMass() == 0)
		return 0;
	return -double(body.getGravity().y()) / double(body.getInvMass()) *
		   double(body.getWorldTransform().getOrigin().y());
}

void Energy::beforeStep()
{
	m_before.resize(m_world.bodies().size());
	for (size_t i = 0; i < m_before.size(); ++i)
	{
		btRigidBody& body = *m_world.bodies()[i];
		body.setUserIndex(int(i));
		const btTransform& pose = body.getWorldTransform();
		m_before[i] = {body.getLinearVelocity(), body.getAngularVelocity(), pose.getOrigin(), pose.getBasis()};
	}
	// A constraint that is not in the step leaves its feedback as it was.
	for (Constraint& c : m_constraints)
		clear(c.feedback);
}

btVector3 Energy::meanVelocity(const btRigidBody* body, const btVector3& point) const
{
	if (!body || body->getInvMass() == 0)
		return btVector3(0, 0, 0);
	const Before& b = m_before[size_t(body->getUserIndex())];
	return (b.linear + body->getLinearVelocity() + (b.angular + body->getAngularVelocity()).cross(point - b.centre)) /
		   2;
}

double Energy::workOn(const btRigidBody& body, const btVector3& force, const btVector3& torque, btScalar dt) const
{
	if (body.getInvMass() == 0)
		return 0;
	const Before& b = m_before[size_t(body.getUserIndex())];
	return double(dt) / 2 *
		   (double(force.dot(b.linear + body.getLinearVelocity())) +
			double(torque.dot(b.angular + body.getAngularVelocity())));
}

void Energy::addContacts()
{
	btDispatcher& dispatcher = *m_world.bullet().getDispatcher();
	const bool both = (m_world.bullet().getSolverInfo().m_solverMode & SOLVER_USE_2_FRICTION_DIRECTIONS) != 0;
	for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
	{
		const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
		const btRigidBody *a = btRigidBody::upcast(manifold.getBody0()), *b = btRigidBody::upcast(manifold.getBody1());
		for (int p = 0; p < manifold.getNumContacts(); ++p)
		{
			const btManifoldPoint& point = manifold.getContactPoint(p);
			// One that is not in the step leaves its impulse as it was.
			if (point.getDistance() > manifold.getContactProcessingThreshold())
				continue;
			const btVector3 v =
				meanVelocity(a, point.getPositionWorldOnA()) - meanVelocity(b, point.getPositionWorldOnB());
			m_contact += double(point.m_appliedImpulse * v.dot(point.m_normalWorldOnB));
			m_friction += double(point.m_appliedImpulseLateral1 * v.dot(point.m_lateralFrictionDir1));
			if (both)
				m_friction += double(point.m_appliedImpulseLateral2 * v.dot(point.m_lateralFrictionDir2));
		}
	}
}

void Energy::afterStep(btScalar dt)
{
	addContacts();
	for (Constraint& c : m_constraints)
		c.work +=
			workOn(c.constraint->getRigidBodyA(), c.feedback.m_appliedForceBodyA, c.feedback.m_appliedTorqueBodyA, dt) +
			workOn(c.constraint->getRigidBodyB(), c.feedback.m_appliedForceBodyB, c.feedback.m_appliedTorqueBodyB, dt);
	for (size_t i = 0; i < m_before.size(); ++i)
	{
		const btRigidBody& body = *m_world.bodies()[i];
		if (body.getInvMass() == 0)
			continue;
		const Before& b = m_before[i];
		const btVector3 moved = body.getWorldTransform().getOrigin() - b.centre,
						mean = (b.linear + body.getLinearVelocity()) * (dt / 2);
		m_integration += kinetic(body) - kineticEnergy(body, b.basis) -
						 double(body.getGravity().dot(moved - mean)) / double(body.getInvMass());
	}
}
}  // namespace ep::charpy
