// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/PortalFrame.h"

#include <algorithm>

namespace ep
{
namespace
{
/// Pose with x along the member, turned about z.
btTransform pose(btScalar angle, btScalar x, btScalar y)
{
	return btTransform(btQuaternion(btVector3(0, 0, 1), angle), btVector3(x, y, 0));
}
}  // namespace

PortalFrame::Settings::Settings()
{
	member.parts = 6;
	member.width = member.height = btScalar(0.4);
	member.material.m_yieldStress = btScalar(25e6);
}

PortalFrame::PortalFrame(const Settings& s)
	: m_world(s.method, btVector3(0, 0, 0)),
	  m_ground(m_world.body(0, m_world.box(btVector3(2 * s.span, 1, 2)), pose(0, s.span / 2, btScalar(-0.5)), false)),
	  m_leftColumn(m_world, s.member, pose(SIMD_HALF_PI, 0, 0), s.height),
	  m_beam(m_world, s.member, pose(0, 0, s.height), s.span),
	  m_rightColumn(m_world, s.member, pose(-SIMD_HALF_PI, s.span, s.height), s.height),
	  m_middle(m_beam.m_jointAt[s.member.parts / 2]),
	  m_settings(s)
{
	m_leftColumn.joinStart(m_world, *m_ground);
	m_rightColumn.joinEnd(m_world, *m_ground);
	// The frame of a corner is the beam's: which of the two members yields there makes no difference to Mp.
	const btElasticPlasticCapacity corner = m_beam.capacity(m_leftColumn.m_partLength, m_beam.m_partLength);
	m_leftCorner = m_world.joint(m_leftColumn.last(), m_beam.first(), m_beam.node(0), corner);
	m_rightCorner = m_world.joint(m_beam.last(), m_rightColumn.first(), m_beam.node(s.member.parts), corner);
}

double PortalFrame::collapseFactor(double vertical, double horizontal) const
{
	const double v = vertical * double(m_settings.span), h = horizontal * double(m_settings.height);
	return plasticMoment() / std::max(v / 8, std::max(h / 4, (h + v / 2) / 6));
}

void PortalFrame::load(double vertical, double horizontal)
{
	loadJoint(*m_middle, btVector3(0, btScalar(-vertical), 0));
	loadJoint(*m_leftCorner, btVector3(btScalar(horizontal), 0, 0));
}
}  // namespace ep
