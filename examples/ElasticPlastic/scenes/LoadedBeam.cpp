// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/LoadedBeam.h"

namespace ep
{
LoadedBeam::Settings::Settings() { member.material.m_yieldStress = btScalar(250e6); }

btRigidBody* LoadedBeam::support(btScalar x) { return m_world.body(0, m_world.box(btVector3(1, 1, 1)), at(x), false); }

LoadedBeam::LoadedBeam(const Settings& s)
	: m_world(s.method, btVector3(0, 0, 0)),
	  m_left(support(btScalar(-0.5))),
	  m_right(support(s.length + btScalar(0.5))),
	  m_member(m_world, s.member, btTransform::getIdentity(), s.length),
	  m_leftEnd(m_member.joinStart(m_world, *m_left)),
	  m_rightEnd(m_member.joinEnd(m_world, *m_right)),
	  m_middle(m_member.m_jointAt[s.member.parts / 2]),
	  m_settings(s)
{
	m_world.release(*m_rightEnd, BT_EP_AXIAL);
	if (s.supports != Supports::Fixed)
		m_world.release(*m_rightEnd, BT_EP_BENDING_Z);
	if (s.supports == Supports::Simple)
		m_world.release(*m_leftEnd, BT_EP_BENDING_Z);
}

double LoadedBeam::collapseLoad() const
{
	const int hinges = m_settings.supports == Supports::Fixed ? 8 : m_settings.supports == Supports::Propped ? 6 : 4;
	return hinges * plasticMoment() / double(m_settings.length);
}

double LoadedBeam::uniformCollapseLoad() const
{
	const double factor = m_settings.supports == Supports::Fixed     ? 16
						  : m_settings.supports == Supports::Propped ? 6 + 4 * sqrt(2.)
																	 : 8;
	return factor * plasticMoment() / double(m_settings.length * m_settings.length);
}

void LoadedBeam::loadUniformly(double forcePerLength)
{
	for (btRigidBody* part : m_member.m_parts)
		part->applyCentralForce(btVector3(0, btScalar(-forcePerLength) * m_member.m_partLength, 0));
}
}  // namespace ep
