// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/Member.h"

namespace ep
{
namespace
{
/// E A / l, G A_s / l, G J / l, E I / l. (btElasticPlasticCapacity::fromMember also counts how the parts themselves bend
/// under shear, and how that turns them; the reference values are without.)
btElasticPlasticCapacity lumped(const Member::Settings& s, btScalar lengthA, btScalar lengthB)
{
	const btElasticPlasticSection section = btElasticPlasticSection::rectangle(s.width, s.height);
	btElasticPlasticCapacity c = btElasticPlasticCapacity::fromMember(s.material, section, lengthA, lengthB);
	for (int i = 0; i < 2; ++i)
		c.m_stiffness[BT_EP_SHEAR_Y + i] =
			s.material.shearModulus() * section.m_shearArea[i] / ((lengthA + lengthB) / 2);
	c.m_coupling[0] = c.m_coupling[1] = c.m_length = 0;
	for (btScalar& ductility : c.m_ductility)
		ductility = btElasticPlasticCapacity::unlimited();
	return c;
}
}  // namespace

Member::Member(World& world, const Settings& s, const btTransform& start, btScalar length)
	: m_jointAt(s.parts + 1), m_partLength(length / s.parts), m_settings(s), m_start(start)
{
	const btScalar l = m_partLength;
	btCollisionShape* shape = world.box(btVector3(l * s.shapeShare, s.height, s.width));
	const btScalar mass = s.partMass > 0 ? s.partMass : s.material.m_density * l * s.height * s.width;
	for (int i = 0; i < s.parts; ++i)
	{
		m_parts.push_back(world.body(mass, shape, start * at(l * (i + btScalar(0.5))), s.collides));
		if (i > 0)
			join(world, *m_parts[i - 1], *m_parts[i], i, l, l);
	}
}

btElasticPlasticJoint* Member::joinStart(World& world, btRigidBody& support)
{
	return join(world, support, first(), 0, 0, m_partLength);
}

btElasticPlasticJoint* Member::joinEnd(World& world, btRigidBody& support)
{
	return join(world, last(), support, m_settings.parts, m_partLength, 0);
}

btElasticPlasticJoint* Member::join(World& world, btRigidBody& a, btRigidBody& b, int i, btScalar lengthA,
									btScalar lengthB)
{
	m_jointAt[i] = world.joint(a, b, node(i), capacity(lengthA, lengthB));
	if (!m_settings.name.empty())
		m_jointAt[i]->setName((m_settings.name + " " + std::to_string(i)).c_str());
	return m_jointAt[i];
}

btElasticPlasticCapacity Member::capacity(btScalar lengthA, btScalar lengthB) const
{
	return m_settings.capacityOf ? m_settings.capacityOf(lengthA, lengthB) : lumped(m_settings, lengthA, lengthB);
}

std::vector<btElasticPlasticJoint*> Member::joints() const
{
	std::vector<btElasticPlasticJoint*> joints;
	for (btElasticPlasticJoint* joint : m_jointAt)
		if (joint)
			joints.push_back(joint);
	return joints;
}

void loadJoint(btElasticPlasticJoint& joint, const btVector3& force)
{
	btRigidBody* const bodies[] = {&joint.getConstraint().getRigidBodyA(), &joint.getConstraint().getRigidBodyB()};
	for (btRigidBody* body : bodies)
		body->applyForce(force / 2, joint.getPosition() - body->getCenterOfMassPosition());
}
}  // namespace ep
