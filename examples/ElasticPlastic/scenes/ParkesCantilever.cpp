// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/ParkesCantilever.h"

#include <math.h>

namespace ep
{
namespace
{
void makeRigidPlastic(btElasticPlasticJoint& joint)
{
	btElasticPlasticCapacity capacity = joint.getCapacity();
	capacity.setRigidPlastic(BT_EP_BENDING_Z, capacity.m_yield[BT_EP_BENDING_Z]);
	joint.setCapacity(capacity);
}
}  // namespace

ParkesCantilever::Settings::Settings()
{
	member.parts = 20;
	member.width = member.height = btScalar(0.02);
	member.material.m_yieldStress = btScalar(250e6);
}

ParkesCantilever::ParkesCantilever(const Settings& s)
	: m_world(s.method, btVector3(0, 0, 0)),
	  m_support(m_world.body(0, m_world.box(btVector3(1, 1, 1)), at(btScalar(-0.5)), false)),
	  m_member(m_world, s.member, btTransform::getIdentity(), s.length),
	  m_root(m_member.joinStart(m_world, *m_support)),
	  m_mass(m_world.body(s.tipMass, m_world.box(btVector3(btScalar(0.05), btScalar(0.05), btScalar(0.05))),
						  at(s.length), false)),
	  m_settings(s)
{
	if (s.rigidPlastic)
		for (btElasticPlasticJoint* joint : m_member.joints())
			makeRigidPlastic(*joint);
	// The mass is fixed to the tip: nothing yields there.
	btElasticPlasticCapacity tip = m_member.capacity(m_member.m_partLength, 0);
	tip.scaleYield(100);
	m_world.joint(m_member.last(), *m_mass, at(s.length), tip);
	m_mass->setLinearVelocity(btVector3(0, -s.velocity, 0));
}

double ParkesCantilever::rootRotation() const
{
	const btVector3 x = m_member.first().getCenterOfMassTransform().getBasis().getColumn(0);
	return atan2(double(-x.y()), double(x.x()));
}

double ParkesCantilever::massPerLength() const
{
	const Member::Settings& s = m_settings.member;
	return double(s.material.m_density * s.width * s.height);
}

double ParkesCantilever::exactTip() const
{
	const double G = m_settings.tipMass, v = m_settings.velocity, m = massPerLength();
	const double beta = m * double(m_settings.length) / (2 * G);
	return G * G * v * v / (3 * m * plasticMoment()) * (beta / (1 + beta) + 2 * log(1 + beta));
}

double ParkesCantilever::exactRootRotation() const
{
	const double G = m_settings.tipMass, v = m_settings.velocity, mL = massPerLength() * double(m_settings.length);
	const double beta = mL / (2 * G);
	return (G + mL / 3) * v * v / (2 * plasticMoment() * (1 + beta) * (1 + beta));
}

double ParkesCantilever::exactDuration() const
{
	return double(m_settings.tipMass * m_settings.velocity * m_settings.length) / plasticMoment();
}

double ParkesCantilever::energyRatio() const
{
	const Member::Settings& s = m_settings.member;
	const double bending =
		double(s.material.m_youngsModulus * btElasticPlasticSection::rectangle(s.width, s.height).m_secondMoment[1]);
	const double kinetic = 0.5 * double(m_settings.tipMass * m_settings.velocity * m_settings.velocity);
	return kinetic / (plasticMoment() * plasticMoment() * double(m_settings.length) / (2 * bending));
}
}  // namespace ep
