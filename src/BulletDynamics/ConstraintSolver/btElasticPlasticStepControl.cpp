// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticStepControl.h"

#include <math.h>

#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "ElasticPlastic/stepping/Flights.h"
#include "ElasticPlastic/stepping/StepInput.h"

void btElasticPlasticStepControl::setError(double error)
{
	m_error = error == error ? btMax(1e-6, btMin(1., error)) : 0.01;
	expectBlow();
}

void btElasticPlasticStepControl::expectBlow()
{
	// What a blow does in its first moment is not known before, and a substep that was too long cannot be taken back.
	refine(MAX_LEVEL);
	m_isSearching = true;
}

void btElasticPlasticStepControl::setMaxSubsteps(int most)
{
	m_maxLevel = MAX_LEVEL;
	while (m_maxLevel > 0 && 1 << m_maxLevel > most)
		--m_maxLevel;
}

void btElasticPlasticStepControl::begin(btScalar dt)
{
	m_dt = dt;
	m_left = dt > 0 && btElasticPlasticIsFinite(dt) ? 1 << MAX_LEVEL : 0;
	m_level = btMin(m_level, m_maxLevel);
}

int btElasticPlasticStepControl::getResolvedLevel() const { return 2 + int(ceil(0.5 * log2(1 / m_error))); }

void btElasticPlasticStepControl::lookAhead(btDynamicsWorld& world)
{
	const btElasticPlastic::Approach approach = btElasticPlastic::lookAhead(world, m_joined, m_dt);
	if (approach.m_isBlow)
		refine(getResolvedLevel());
	while (m_level < m_maxLevel && approach.m_rate * double(m_dt) > double(1 << m_level))
		++m_level;
}

/// Gives the world its error reduction back.
void btElasticPlasticStepControl::restore(btDynamicsWorld& world)
{
	if (!m_isUnderWay)
		return;
	world.getSolverInfo().m_erp = m_erp;
	world.getSolverInfo().m_erp2 = m_erp2;
	m_isUnderWay = false;
}

btScalar btElasticPlasticStepControl::next(btDynamicsWorld& world)
{
	if (m_left <= 0)
		return 0;
	lookAhead(world);
	m_parts = 1 << (MAX_LEVEL - m_level);
	const btScalar share = 1 / btScalar(1 << m_level);
	restore(world);
	btContactSolverInfo& info = world.getSolverInfo();
	m_erp = info.m_erp;
	m_erp2 = info.m_erp2;
	m_isUnderWay = true;
	info.m_erp *= share;
	info.m_erp2 *= share;
	const btScalar length = m_dt * share;
	if (m_length > 0 && m_length != length)
		btElasticPlastic::keepFreeFlight(world, (m_length - length) / 2);
	return m_length = length;
}

void btElasticPlasticStepControl::addBodies(const btDynamicsWorld& world)
{
	const btCollisionObjectArray& objects = world.getCollisionObjectArray();
	const Island none = {0, 0, 0, 0, {0, 0, 0}, 0, false};
	m_islands.resize(0);
	m_islands.resize(objects.size(), none);
	m_joined.clear(objects.size());
	for (int i = 0; i < objects.size(); ++i)
	{
		const btRigidBody* const body = btRigidBody::upcast(objects[i]);
		if (!body || body->getInvMass() == 0 || !body->isActive())
			continue;
		const int tag = body->getIslandTag();
		if (tag < 0 || tag >= m_islands.size())
			continue;
		Island& island = m_islands[tag];
		const double mass = 1 / double(body->getInvMass());
		const btVector3& v = body->getLinearVelocity();
		const btVector3 spin = body->getAngularVelocity() * body->getCenterOfMassTransform().getBasis();
		island.m_mass += mass;
		for (int k = 0; k < 3; ++k)
		{
			island.m_momentum[k] += mass * double(v[k]);
			island.m_energy += 0.5 * mass * double(v[k]) * double(v[k]);
			if (body->getInvInertiaDiagLocal()[k] > 0)
				island.m_energy += 0.5 * double(spin[k]) * double(spin[k]) / double(body->getInvInertiaDiagLocal()[k]);
		}
	}
}

void btElasticPlasticStepControl::addJoints(btElasticPlasticAction& action, double length)
{
	for (int i = action.getNumJoints() - action.getNumBroken() - 1; i >= 0; --i)
	{
		const btElasticPlasticJoint& joint = *action.getJoint(i);
		const btRigidBody &a = joint.getConstraint().getRigidBodyA(), &b = joint.getConstraint().getRigidBodyB();
		for (const btRigidBody* body : {&a, &b})
			if (!body->isStaticOrKinematicObject())
				m_joined.mark(*body);
		const bool isHeld = a.isStaticOrKinematicObject() || b.isStaticOrKinematicObject();
		const int tag = (a.isStaticOrKinematicObject() ? b : a).getIslandTag();
		if (tag < 0 || tag >= m_islands.size())
			continue;
		Island& island = m_islands[tag];
		if (isHeld)
			addSupport(island, a.isStaticOrKinematicObject() ? a : b, joint.getPosition());
		const double place = double(joint.getPosition().length()) + 1;
		for (int r = 0; r < joint.getNumCommittedRows(); ++r)
			addRow(island, joint, r, length, place);
	}
}

/// What moves with its support has that much less to be dissipated; of several supports the one that leaves least.
void btElasticPlasticStepControl::addSupport(Island& island, const btRigidBody& support, const btVector3& place)
{
	const btVector3 v = support.getVelocityInLocalPoint(place - support.getCenterOfMassPosition());
	double carried = 0;
	for (int k = 0; k < 3; ++k)
		carried += double(v[k]) * (island.m_momentum[k] - 0.5 * island.m_mass * double(v[k]));
	island.m_carried = island.m_isHeld ? btMax(island.m_carried, carried) : carried;
	island.m_isHeld = true;
}

void btElasticPlasticStepControl::addRow(Island& island, const btElasticPlasticJoint& joint, int r, double length,
										 double place) const
{
	int dof;
	btScalar before, after;
	joint.getCommittedRow(r, dof, before, after);
	const btElasticPlasticCapacity& capacity = joint.getCapacity();
	const double yield = capacity.m_yield[dof], change = fabs(double(after - before));
	// Rigid up to yield: what has not flowed has nothing to leave open, and no energy to set the solver's rounding against.
	if (capacity.isRigidPlastic(dof) && joint.getPlasticPath(dof) == 0)
		return;
	if (!capacity.isRigidPlastic(dof))
	{
		const double stiffness = capacity.m_stiffness[dof];
		// Where the force gets to within a step: nothing is near yield that stays below half of it.
		const double ahead = fabs(double(joint.getForce(dof))) +
							 stiffness * double(m_dt) * (fabs(double(after)) + change * double(m_dt) / (2 * length));
		if (joint.getPlasticPath(dof) == 0 && ahead < yield / 2)
			return;
		island.m_energy += 0.5 * yield * yield / stiffness;
	}
	island.m_energy += yield * fabs(double(joint.getPlasticDeformation(dof)));
	island.m_openWork += yield * length * change;
	const double rounding = 4 * double(SIMD_EPSILON) * (dof < 3 ? place : 1.);
	island.m_roundedWork += yield * btMin(length * change, rounding);
}

void btElasticPlasticStepControl::observe(btDynamicsWorld& world, btElasticPlasticAction& action)
{
	restore(world);
	m_left -= m_parts;
	addBodies(world);
	addJoints(action, double(m_length));
	m_openShare = 0;
	double mendable = 0;
	for (int i = 0; i < m_islands.size(); ++i)
	{
		Island& island = m_islands[i];
		if (island.m_openWork == 0)
			continue;
		// Of what is not held, the motion of the whole will not be dissipated.
		for (int k = 0; k < 3 && !island.m_isHeld; ++k)
			island.m_carried += 0.5 * island.m_momentum[k] * island.m_momentum[k] / island.m_mass;
		island.m_energy -= island.m_carried;
		const double energy = btMax(island.m_energy, island.m_openWork);
		m_openShare = btMax(m_openShare, island.m_openWork / energy);
		mendable = btMax(mendable, (island.m_openWork - island.m_roundedWork) / energy);
	}
	if (mendable > m_error)
		refine(m_level + int(ceil(0.5 * log2(mendable / m_error))));
	m_calm = m_openShare > m_error / 8 ? btScalar(0) : m_calm + m_length;
	// A swing has moments at which it leaves little open, and every change of the step takes energy out of it: calm is what
	// has lasted, or what leaves next to nothing. Substeps begin at multiples of their length, so that the step ends with a
	// whole one.
	// Twice the substep has four times the T.
	m_isSearching &= m_openShare <= m_error / 4 && m_level > getResolvedLevel();
	const bool fitsTwice = m_level > 0 && m_left % (2 << (MAX_LEVEL - m_level)) == 0;
	if (fitsTwice && (m_calm >= CALM_STEPS * m_dt || m_openShare < m_error / 1000 || m_isSearching))
	{
		--m_level;
		m_calm = 0;
	}
}

int btElasticPlasticStepControl::step(btDynamicsWorld& world, btElasticPlasticAction& action, btScalar dt)
{
	begin(dt);
	if (m_left == 0)
		return 0;
	btElasticPlastic::StepInput input(world, dt);
	int substeps = 0;
	for (btScalar length; (length = next(world)) > 0; ++substeps)
	{
		input.apply(1 - btScalar(m_left - m_parts) / btScalar(1 << MAX_LEVEL));
		world.stepSimulation(length, 0);
		observe(world, action);
	}
	return substeps;
}
