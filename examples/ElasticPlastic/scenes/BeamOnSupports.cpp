// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/BeamOnSupports.h"

namespace ep
{
BeamOnSupports::Settings::Settings()
{
	member.material.m_youngsModulus = btScalar(30e9);
	member.material.m_density = 2500;
	member.material.m_yieldStress = btScalar(25e6);
	member.width = btScalar(0.5);
	member.height = btScalar(0.4);
	member.parts = 20;
	member.shapeShare = btScalar(0.98);
	member.collides = true;
}

BeamOnSupports::BeamOnSupports(const Settings& s)
	: m_world(s.method, btVector3(0, -s.gravity, 0)),
	  m_member(m_world, s.member, at(0, s.member.height / 2), s.length),
	  m_settings(s)
{
	// Contacts without the energy of positional correction.
	m_world.bullet().getSolverInfo().m_splitImpulsePenetrationThreshold = 0;
	btCollisionShape* block = m_world.box(btVector3(btScalar(0.6), 1, 1));
	for (btScalar x : {btScalar(0.2), s.length - btScalar(0.2)})
		m_world.body(0, block, at(x, btScalar(-0.5)));
	m_world.body(0, m_world.box(btVector3(4 * s.length, 1, s.length)), at(s.length / 2, -4));
	for (btRigidBody* part : m_member.m_parts)
		part->setFriction(btScalar(0.6));
	for (btElasticPlasticJoint* joint : m_member.joints())
	{
		btElasticPlasticCapacity capacity = joint->getCapacity();
		// Plain concrete with a light reinforcement: a quarter of the section's plastic moment.
		for (int dof : {BT_EP_BENDING_Y, BT_EP_BENDING_Z})
			capacity.m_yield[dof] /= 4;
		for (btScalar& yield : capacity.m_yield)
			yield = s.elastic ? btElasticPlasticCapacity::unlimited() : yield;
		joint->setCapacity(capacity);
	}
	if (s.mass > 0)
	{
		// Off the middle by a tenth of a part: it hits both, one harder.
		const btScalar side = btScalar(0.8);
		m_box = m_world.body(s.mass, m_world.box(btVector3(side, side, side)),
							 at(s.length / 2 + btScalar(0.05), s.member.height + s.drop + side / 2));
	}
}

btScalar BeamOnSupports::sag() const
{
	const int middle = m_settings.member.parts / 2;
	return m_settings.member.height / 2 - (m_member.m_parts[middle - 1]->getCenterOfMassPosition().y() +
										   m_member.m_parts[middle]->getCenterOfMassPosition().y()) /
											  2;
}
}  // namespace ep
