// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/HangingChain.h"

namespace ep
{
namespace
{
/// x down
btTransform downwards() { return btTransform(btQuaternion(btVector3(0, 0, 1), -SIMD_HALF_PI)); }
}  // namespace

HangingChain::Settings::Settings()
{
	member.parts = 6;
	member.material.m_yieldStress = btScalar(400e6);
}

HangingChain::HangingChain(const Settings& s)
	: m_world(s.method, btVector3(0, -s.gravity, 0)),
	  m_support(m_world.body(0, m_world.box(btVector3(1, 1, 1)),
							 btTransform(btQuaternion(0, 0, 0, 1), btVector3(0, btScalar(0.5), 0)), false)),
	  m_member(m_world, s.member, downwards(), s.length),
	  m_top(m_member.joinStart(m_world, *m_support)),
	  m_settings(s)
{
	btRigidBody& last = m_member.last();
	const btScalar mass = s.lastFactor / last.getInvMass();
	btVector3 inertia;
	last.getCollisionShape()->calculateLocalInertia(mass, inertia);
	last.setMassProps(mass, inertia);
	last.updateInertiaTensor();
	last.setGravity(m_world.bullet().getGravity());
}

btScalar HangingChain::stretch() const
{
	return -m_member.last().getCenterOfMassPosition().y() - (m_settings.length - m_member.m_partLength / 2);
}

double HangingChain::staticStretch() const
{
	double weight = 0, stretch = 0;
	for (int i = m_settings.member.parts - 1; i >= 0; --i)
	{
		weight += double(m_settings.gravity) / double(m_member.m_parts[i]->getInvMass());
		stretch += weight / double(m_world.nominal(*m_member.m_jointAt[i]).m_stiffness[BT_EP_AXIAL]);
	}
	return stretch;
}
}  // namespace ep
