// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "SteadyPushes.h"

#include "../joint/BodyEnergy.h"
#include "../joint/BodyLoad.h"
#include "../joint/RigidMotion.h"

namespace btElasticPlastic
{
namespace
{
/// A change of velocity is none below so many roundings of it.
const btScalar ROUNDINGS = 16;
/// What grows from step to step by no more than this factor comes on as a load does. Of what grows by more, the rest is a blow.
const btScalar GROWTH = btScalar(2.5);
/// What a load changes by in a step is no more than so many times what it has changed by lately.
const btScalar SWAY = btScalar(1.5);

/// The velocities that a body has now if nobody has changed them since it was moved: Bullet damps them as a step begins.
void findVelocitiesLeft(btRigidBody& body, btScalar dt, btVector3& linear, btVector3& angular)
{
	const btVector3 v = body.getLinearVelocity(), w = body.getAngularVelocity();
	body.setLinearVelocity(body.getInterpolationLinearVelocity());
	body.setAngularVelocity(body.getInterpolationAngularVelocity());
	body.applyDamping(dt);
	linear = body.getLinearVelocity();
	angular = body.getAngularVelocity();
	body.setLinearVelocity(v);
	body.setAngularVelocity(w);
}

/// By its length [1/s]; nothing of rounding, and of what is beyond all numbers.
btVector3 rateOf(const btVector3& now, const btVector3& left, btScalar dt)
{
	const btVector3 rate = (now - left) / dt;
	const btScalar rounding = ROUNDINGS * SIMD_EPSILON / dt;
	const bool isOne = rate.length2() > rounding * rounding * now.length2() && rate.length2() < BT_LARGE_FLOAT;
	return isOne ? rate : btVector3(0, 0, 0);
}

/// By component what of it has come before.
/// \param sway  a change by no more is one of the load that it is, through nothing, too
btVector3 steadyOf(const btVector3& now, const btScalar* last, btScalar sway)
{
	btVector3 steady(0, 0, 0);
	for (int k = 0; k < 3; ++k)
	{
		const bool grows = now[k] * last[k] > 0;
		if (btFabs(now[k] - last[k]) <= sway || (grows && btFabs(now[k]) <= GROWTH * btFabs(last[k])))
			steady[k] = now[k];
		else if (grows)
			steady[k] = last[k];
	}
	return steady;
}

void setGreater(btVector3& of, const btVector3& other)
{
	if (other.length2() > of.length2())
		of = other;
}
}  // namespace

void SteadyPushes::clear(btScalar dt)
{
	m_dt = dt;
	m_bodies.resizeNoInitialize(0);
}

int SteadyPushes::addBody(btRigidBody& body, const LoadHistory* loads)
{
	const btVector3 &v = body.getLinearVelocity(), &w = body.getAngularVelocity();
	if (v == body.getInterpolationLinearVelocity() && w == body.getInterpolationAngularVelocity())
		return -1;
	btVector3 linear, angular;
	findVelocitiesLeft(body, m_dt, linear, angular);
	const btVector3 givenLinear = rateOf(v, linear, m_dt), givenAngular = rateOf(w, angular, m_dt);
	if (givenLinear.isZero() && givenAngular.isZero())
		return -1;
	const btVector3 none(0, 0, 0);
	btScalar swayLinear = 0, swayAngular = 0;
	if (loads)
	{
		const btVector3& inverse = body.getInvInertiaDiagLocal();
		swayLinear = SWAY * loads->m_force.m_greatest * body.getInvMass();
		swayAngular = SWAY * loads->m_torque.m_greatest * btMax(btMax(inverse.x(), inverse.y()), inverse.z());
	}
	m_bodies.push_back(
		{&body, givenLinear, givenAngular, swayLinear, swayAngular, none, none, none, none, none, none, 0});
	return m_bodies.size() - 1;
}

void SteadyPushes::addJoint(btElasticPlasticState& state, const int given[2])
{
	if (given[0] < 0 && given[1] < 0 && !state.m_isGiven)
		return;
	state.m_isGiven = given[0] >= 0 || given[1] >= 0;
	for (int side = 0; side < 2; ++side)
	{
		btScalar* const last = state.m_given[side];
		btVector3 linear(0, 0, 0), angular(0, 0, 0);
		if (given[side] >= 0)
		{
			Body& body = m_bodies[given[side]];
			linear = body.m_linear;
			angular = body.m_angular;
			// A joint that is new remembers nothing.
			setGreater(body.m_steadyLinear, steadyOf(linear, last, body.m_swayLinear));
			setGreater(body.m_steadyAngular, steadyOf(angular, last + 3, body.m_swayAngular));
		}
		for (int k = 0; k < 3; ++k)
		{
			last[k] = linear[k];
			last[3 + k] = angular[k];
		}
	}
}

bool SteadyPushes::isAny() const
{
	for (int i = 0; i < m_bodies.size(); ++i)
		if (!m_bodies[i].m_steadyLinear.isZero() || !m_bodies[i].m_steadyAngular.isZero())
			return true;
	return false;
}

void SteadyPushes::begin()
{
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		Body& given = m_bodies[i];
		btRigidBody& body = *given.m_body;
		const btVector3 v = body.getLinearVelocity(), w = body.getAngularVelocity(),
						&linearFactor = body.getLinearFactor(), &angularFactor = body.getAngularFactor();
		given.m_force = beforeFactor(body.getTotalForce(), linearFactor);
		given.m_torque = beforeFactor(body.getTotalTorque(), angularFactor);
		const RigidMotion::Part part = {&body, body.getCenterOfMassTransform(), v, w};
		const btVector3 forceBefore = body.getTotalForce(), torqueBefore = body.getTotalTorque();
		body.applyCentralForce(beforeFactor(given.m_steadyLinear / body.getInvMass(), linearFactor));
		body.applyTorque(beforeFactor(part.angularMomentum(given.m_steadyAngular), angularFactor));
		given.m_pushForce = body.getTotalForce() - forceBefore;
		given.m_pushTorque = body.getTotalTorque() - torqueBefore;
		body.setLinearVelocity(v - given.m_pushForce * (body.getInvMass() * m_dt));
		body.setAngularVelocity(w - body.getInvInertiaTensorWorld() * given.m_pushTorque * m_dt);
		const btMatrix3x3& basis = part.m_pose.getBasis();
		given.m_energy = kineticEnergy(body, basis, body.getLinearVelocity(), body.getAngularVelocity()) -
						 kineticEnergy(body, basis, v, w);
	}
}

void SteadyPushes::end()
{
	for (int i = 0; i < m_bodies.size(); ++i)
	{
		btRigidBody& body = *m_bodies[i].m_body;
		body.clearForces();
		body.applyCentralForce(m_bodies[i].m_force);
		body.applyTorque(m_bodies[i].m_torque);
	}
}

double SteadyPushes::getWork(int given, const btVector3& way, const btVector3& turn) const
{
	return given < 0 ? 0
					 : double(m_bodies[given].m_pushForce.dot(way)) + double(m_bodies[given].m_pushTorque.dot(turn));
}
}  // namespace btElasticPlastic
