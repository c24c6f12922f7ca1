// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/Cantilever.h"

namespace ep
{
Cantilever::Settings::Settings() { member.material.m_density = 7850; }

Cantilever::Settings Cantilever::Settings::twentyBlocks()
{
	Settings settings;
	settings.length = 10;
	settings.gravity = 10;
	settings.member.parts = 20;
	settings.member.material = Member::undampedSteel();
	settings.member.material.m_yieldStress = btScalar(400e6);
	return settings;
}

Cantilever::Cantilever(const Settings& s)
	: m_world(s.method, quatRotate(s.turn, btVector3(0, -s.gravity, 0))),
	  m_support(m_world.body(0, m_world.box(btVector3(1, 1, 1)),
							 btTransform(s.turn, quatRotate(s.turn, btVector3(btScalar(-0.5), 0, 0))), false)),
	  m_member(m_world, s.member, btTransform(s.turn), s.length),
	  m_root(m_member.joinStart(m_world, *m_support)),
	  m_settings(s)
{
}

btScalar Cantilever::sag() const
{
	const btVector3 tip = m_member.last().getCenterOfMassTransform() * btVector3(m_member.m_partLength / 2, 0, 0);
	return -quatRotate(m_settings.turn.inverse(), tip).y();
}

double Cantilever::staticSag() const
{
	// Every joint turns and slides by what hangs beyond it, and carries the rest of the length round with it.
	const Member::Settings& s = m_settings.member;
	const double load = double(s.material.m_density * s.width * s.height * m_settings.gravity);
	double sag = 0;
	for (int i = 0; i < s.parts; ++i)
	{
		const btElasticPlasticCapacity& joint = m_world.nominal(*m_member.m_jointAt[i]);
		const double beyond = double(m_settings.length) - i * double(m_member.m_partLength);
		sag += load * beyond * beyond / 2 / double(joint.m_stiffness[BT_EP_BENDING_Z]) * beyond +
			   load * beyond / double(joint.m_stiffness[BT_EP_SHEAR_Y]);
	}
	return sag;
}

double Cantilever::beamSag() const
{
	const Member::Settings& s = m_settings.member;
	const btElasticPlasticSection section = btElasticPlasticSection::rectangle(s.width, s.height);
	const double load = double(s.material.m_density * section.m_area * m_settings.gravity), l = m_settings.length;
	return load * l * l *
		   (l * l / (8 * double(s.material.m_youngsModulus * section.m_secondMoment[1])) +
			1 / (2 * double(s.material.shearModulus() * section.m_shearArea[0])));
}
}  // namespace ep
