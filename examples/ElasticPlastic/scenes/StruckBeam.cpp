// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/StruckBeam.h"

#include "world/Place.h"

namespace ep
{
namespace
{
/// Bears across the beam, and next to nothing else: what has no yield value at all is Bullet's to lock.
btElasticPlasticCapacity roller(const btElasticPlasticCapacity& held)
{
	btElasticPlasticCapacity c;
	c.set(BT_EP_SHEAR_Y, held.m_stiffness[BT_EP_SHEAR_Y], held.m_yield[BT_EP_SHEAR_Y], 1);
	c.set(BT_EP_AXIAL, 1, 1, 1);
	c.set(BT_EP_BENDING_Z, 1, 1, 1);
	return c;
}

/// What it bears does not end.
btElasticPlasticMaterial lasting(btElasticPlasticMaterial material)
{
	material.m_ultimatePlasticStrain = btScalar(1e6);
	material.m_dampingRatio = 0;
	return material;
}
}  // namespace

StruckBeam::Settings StruckBeam::ofSteel(const Method& method, const btElasticPlasticSection& section, double speed)
{
	Settings s;
	s.method = method;
	s.height = s.width = 0.02;
	s.density = 7850;
	s.mass = 50;
	s.speed = speed;
	const btElasticPlasticMaterial steel = lasting(btElasticPlasticMaterial::steel(btScalar(250e6)));
	s.capacity = [=](btScalar lengthA, btScalar lengthB)
	{ return btElasticPlasticCapacity::fromMember(steel, section, lengthA, lengthB); };
	return s;
}

StruckBeam::Settings StruckBeam::ofConcrete(const Method& method, const btElasticPlasticSection& concrete, bool isHeld,
											double tensileShare)
{
	Settings s;
	s.method = method;
	s.halfParts = 6;
	s.length = 6;
	s.height = 0.5;
	s.width = 0.3;
	s.density = 2500;
	s.mass = 2000;
	s.speed = 6;
	s.isHeld = isHeld;
	btElasticPlasticMaterial material;
	material.m_youngsModulus = btScalar(30e9);
	material.m_yieldStress = btScalar(30e6);
	material.m_tensileShare = btScalar(tensileShare);
	material = lasting(material);
	btElasticPlasticSection section = concrete;
	for (const double y : {-0.21, 0.21})
		for (const double z : {-0.11, 0.11})
			section.addBar(btScalar(y), btScalar(z), btScalar(314.16e-6),
						   lasting(btElasticPlasticMaterial::steel(btScalar(500e6))));
	s.capacity = [=](btScalar lengthA, btScalar lengthB)
	{
		btElasticPlasticCapacity c = btElasticPlasticCapacity::fromMember(material, section, lengthA, lengthB);
		c.m_yield[BT_EP_SHEAR_Y] = btScalar(400e3);
		return c;
	};
	return s;
}

StruckBeam::StruckBeam(const Settings& settings) : m_world(settings.method, btVector3(0, 0, 0))
{
	const int half = settings.halfParts;
	const btScalar part = btScalar(settings.length / (2 * half)), height = btScalar(settings.height),
				   width = btScalar(settings.width);
	btCollisionShape* const piece = m_world.box(btVector3(part, height, width));
	btCollisionShape* const cube = m_world.box(btVector3(2 * height, 2 * height, 2 * width));
	btRigidBody* before = m_world.body(0, cube, at(0), false);
	btScalar place = 0, lengthBefore = 0;
	for (int i = 0; i <= 2 * half + 1; ++i)
	{
		const bool isStriker = i == half, isEnd = i == 2 * half + 1;
		const btScalar length = isStriker || isEnd ? btScalar(0) : part;
		btRigidBody* body;
		if (length > 0)
			body = m_world.body(btScalar(settings.density) * part * width * height, piece, at(place + part / 2), false);
		else
			body = m_world.body(isStriker ? btScalar(settings.mass) : btScalar(0), cube, at(place), false);
		if (isStriker)
		{
			m_striker = body;
			body->setMassProps(btScalar(settings.mass), btVector3(btScalar(1e6), btScalar(1e6), btScalar(1e6)));
			body->updateInertiaTensor();
			body->setLinearVelocity(btVector3(0, btScalar(-settings.speed), 0));
		}
		const btElasticPlasticCapacity c = settings.capacity(lengthBefore, length);
		btElasticPlasticJoint* const joint =
			m_world.joint(*before, *body, at(place), isEnd && !settings.isHeld ? roller(c) : c);
		if (i == 0)
			m_atSupport = joint;
		before = body;
		lengthBefore = length;
		place += length;
	}
}
}  // namespace ep
