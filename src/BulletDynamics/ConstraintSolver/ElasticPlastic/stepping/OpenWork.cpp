// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "OpenWork.h"

#include <math.h>

#include "../../btElasticPlasticJoint.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"

namespace btElasticPlastic
{
void OpenWork::measure(const btDynamicsWorld& world, const btAlignedObjectArray<btElasticPlasticJoint*>& joints,
					   double length, double ahead)
{
	m_length = length;
	m_ahead = ahead;
	addBodies(world);
	addJoints(joints);
	m_share = m_mendableShare = 0;
	for (int i = 0; i < m_islands.size(); ++i)
	{
		Island& island = m_islands[i];
		if (island.m_openWork == 0)
			continue;
		// Joints cannot dissipate the motion of an island as a whole if nothing holds it.
		for (int k = 0; k < 3 && !island.m_isHeld; ++k)
			island.m_carried += 0.5 * island.m_momentum[k] * island.m_momentum[k] / island.m_mass;
		island.m_energy -= island.m_carried;
		const double energy = btMax(island.m_energy, island.m_openWork);
		m_share = btMax(m_share, island.m_openWork / energy);
		m_mendableShare = btMax(m_mendableShare, (island.m_openWork - island.m_roundedWork) / energy);
	}
}

void OpenWork::addBodies(const btDynamicsWorld& world)
{
	const btCollisionObjectArray& objects = world.getCollisionObjectArray();
	const Island none = {0, 0, 0, 0, {0, 0, 0}, 0, false};
	m_islands.resize(0);
	m_islands.resize(objects.size(), none);
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

void OpenWork::addJoints(const btAlignedObjectArray<btElasticPlasticJoint*>& joints)
{
	for (int i = joints.size() - 1; i >= 0; --i)
	{
		const btElasticPlasticJoint& joint = *joints[i];
		const btRigidBody &a = joint.getConstraint().getRigidBodyA(), &b = joint.getConstraint().getRigidBodyB();
		const bool isHeld = a.isStaticOrKinematicObject() || b.isStaticOrKinematicObject();
		const int tag = (a.isStaticOrKinematicObject() ? b : a).getIslandTag();
		if (tag < 0 || tag >= m_islands.size())
			continue;
		Island& island = m_islands[tag];
		if (isHeld)
			addSupport(island, a.isStaticOrKinematicObject() ? a : b, joint.getPosition());
		const double place = double(joint.getPosition().length()) + 1;
		for (int r = 0; r < joint.getNumCommittedRows(); ++r)
			addRow(island, joint, r, place);
	}
}

/// An island that moves with its support has so much less kinetic energy that joints can dissipate. Of several supports the one
/// counts that leaves the least.
void OpenWork::addSupport(Island& island, const btRigidBody& support, const btVector3& place)
{
	const btVector3 v = support.getVelocityInLocalPoint(place - support.getCenterOfMassPosition());
	double carried = 0;
	for (int k = 0; k < 3; ++k)
		carried += double(v[k]) * (island.m_momentum[k] - 0.5 * island.m_mass * double(v[k]));
	island.m_carried = island.m_isHeld ? btMax(island.m_carried, carried) : carried;
	island.m_isHeld = true;
}

void OpenWork::addRow(Island& island, const btElasticPlasticJoint& joint, int r, double place) const
{
	int dof;
	btScalar before, after;
	joint.getCommittedRow(r, dof, before, after);
	const btElasticPlasticCapacity& capacity = joint.getCapacity();
	const double yield = capacity.m_yield[dof], change = fabs(double(after - before));
	// A rigid-plastic row that has not flowed leaves nothing open, and has no energy with which to compare the solver's rounding.
	if (capacity.isRigidPlastic(dof) && joint.getPlasticPath(dof) == 0)
		return;
	if (!capacity.isRigidPlastic(dof))
	{
		const double stiffness = capacity.m_stiffness[dof];
		// The force that may be reached within a step: a row whose force stays below half of its yield value is not near yield.
		// A coupled row is stiffer while its partner keeps still.
		const double coupling = double(capacity.couplingCompliance(dof));
		const double own =
			coupling == 0
				? stiffness
				: 1 / (1 / stiffness - coupling * coupling * double(capacity.m_stiffness[capacity.coupledWith(dof)]));
		const double ahead = fabs(double(joint.getForce(dof))) +
							 own * m_ahead * (fabs(double(after)) + change * m_ahead / (2 * m_length));
		if (joint.getPlasticPath(dof) == 0 && ahead < yield / 2)
			return;
		island.m_energy += 0.5 * yield * yield / stiffness;
	}
	island.m_energy += yield * fabs(double(joint.getPlasticDeformation(dof)));
	island.m_openWork += yield * m_length * change;
	const double rounding = 4 * double(SIMD_EPSILON) * (dof < 3 ? place : 1.);
	island.m_roundedWork += yield * btMin(m_length * change, rounding);
}
}  // namespace btElasticPlastic
