// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "MultiBodyGroup.h"

#include <algorithm>

#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"

namespace btElasticPlastic
{
namespace
{
bool isLink(const btCollisionObject& object)
{
	return object.getInternalType() == btCollisionObject::CO_FEATHERSTONE_LINK;
}

/// Gyroscopic torque, which a solver applies to bodies by these flags.
const int GYROSCOPIC = BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT | BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD |
					   BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY;
}  // namespace

bool MultiBodyGroup::split(SolverWorks& works, const SolverGroup& group, bool hasMultiBodyConstraints,
						   const btContactSolverInfo& info, btDispatcher* dispatcher)
{
	m_links.clear();
	m_solids.clear();
	for (int i = 0; i < group.m_numManifolds; ++i)
	{
		const btPersistentManifold& manifold = *group.m_manifolds[i];
		const bool isOfLink = isLink(*manifold.getBody0()) || isLink(*manifold.getBody1());
		(isOfLink ? m_links : m_solids).push_back(group.m_manifolds[i]);
	}
	SolverGroup solids = group;
	solids.m_manifolds = m_solids.data();
	solids.m_numManifolds = int(m_solids.size());
	if (!works.split(solids, info, dispatcher))
		return false;
	m_others = works.getOthers();

	m_members.clear();
	for (int i = 0; i < works.getNumIslands(); ++i)
	{
		const SolverGroup island = works.getIsland(i);
		m_members.insert(m_members.end(), island.m_bodies, island.m_bodies + island.m_numBodies);
	}
	m_guests.clear();
	if (hasMultiBodyConstraints)
		for (btCollisionObject* body : m_members)
			invite(*body);
	else
	{
		std::sort(m_members.begin(), m_members.end());
		for (btPersistentManifold* manifold : m_links)
			for (const btCollisionObject* body : {manifold->getBody0(), manifold->getBody1()})
			{
				const auto place = std::lower_bound(m_members.begin(), m_members.end(), body);
				if (manifold->getNumContacts() > 0 && place != m_members.end() && *place == body)
					invite(**place);
			}
	}
	return true;
}

void MultiBodyGroup::invite(btCollisionObject& object)
{
	btRigidBody* const body = btRigidBody::upcast(&object);
	for (const Guest& guest : m_guests)
		if (guest.m_body == body)
			return;
	if (body && body->getInvMass() > 0)
		m_guests.push_back({body, body->getFlags()});
}

SolverGroup MultiBodyGroup::beginRest(btScalar dt)
{
	m_restBodies.assign(m_others.m_bodies, m_others.m_bodies + m_others.m_numBodies);
	m_restManifolds.assign(m_others.m_manifolds, m_others.m_manifolds + m_others.m_numManifolds);
	m_restManifolds.insert(m_restManifolds.end(), m_links.begin(), m_links.end());
	for (const Guest& guest : m_guests)
	{
		btRigidBody& body = *guest.m_body;
		m_restBodies.push_back(&body);
		// A solver adds what loads give in the step, and the island's solver will: here they have to come out as nothing.
		body.setLinearVelocity(body.getLinearVelocity() - body.getTotalForce() * (body.getInvMass() * dt));
		body.setAngularVelocity(body.getAngularVelocity() -
								body.getInvInertiaTensorWorld() * body.getTotalTorque() * dt);
		body.setFlags(guest.m_flags & ~GYROSCOPIC);
	}
	SolverGroup rest = m_others;
	rest.m_bodies = m_restBodies.data();
	rest.m_numBodies = int(m_restBodies.size());
	rest.m_manifolds = m_restManifolds.data();
	rest.m_numManifolds = int(m_restManifolds.size());
	return rest;
}

void MultiBodyGroup::finishRest()
{
	for (const Guest& guest : m_guests)
		guest.m_body->setFlags(guest.m_flags);
}
}  // namespace btElasticPlastic
