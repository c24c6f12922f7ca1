// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/Member.h"

namespace ep
{
Member::Member(World& world, const Settings& settings, const btTransform& start, btScalar length)
	: m_partLength(length / settings.parts), m_settings(settings), m_start(start)
{
	const btScalar l = m_partLength;
	btCollisionShape* shape = world.box(btVector3(l * settings.shapeShare, settings.height, settings.width));
	const btScalar mass = settings.material.m_density * l * settings.height * settings.width;
	for (int i = 0; i < settings.parts; ++i)
	{
		m_parts.push_back(world.body(mass, shape, start * along(l * (i + btScalar(0.5))), settings.collides));
		if (i > 0)
		{
			m_joints.push_back(world.joint(*m_parts[i - 1], *m_parts[i], node(i), capacity(l, l)));
		}
	}
}

btElasticPlasticJoint* Member::joinStart(World& world, btRigidBody& support)
{
	return world.joint(support, first(), node(0), capacity(0, m_partLength));
}

btElasticPlasticJoint* Member::joinEnd(World& world, btRigidBody& support)
{
	return world.joint(last(), support, node(m_settings.parts), capacity(m_partLength, 0));
}

btElasticPlasticCapacity Member::capacity(btScalar lengthA, btScalar lengthB) const
{
	const btElasticPlasticSection section = btElasticPlasticSection::rectangle(m_settings.width, m_settings.height);
	btElasticPlasticCapacity c = btElasticPlasticCapacity::fromMember(m_settings.material, section, lengthA, lengthB);
	for (int i = 0; i < 2; ++i)
	{
		c.m_stiffness[BT_EP_SHEAR_Y + i] =
			m_settings.material.shearModulus() * section.m_shearArea[i] / ((lengthA + lengthB) / 2);
	}
	for (btScalar& ductility : c.m_ductility)
		ductility = btElasticPlasticCapacity::unlimited();
	return c;
}

void loadJoint(btElasticPlasticJoint& joint, const btVector3& force)
{
	btRigidBody* const bodies[] = {&joint.getConstraint().getRigidBodyA(), &joint.getConstraint().getRigidBodyB()};
	for (btRigidBody* body : bodies)
		body->applyForce(force / 2, joint.getPosition() - body->getCenterOfMassPosition());
}
}  // namespace ep
