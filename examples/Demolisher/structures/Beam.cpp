// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "structures/Beam.h"

namespace ep
{
btElasticPlasticMaterial Materials::mixed(btScalar steelShare) const
{
	btElasticPlasticMaterial m = btElasticPlasticMaterial::reinforcedConcrete(steelShare, yieldStress);
	m.m_density = concreteDensity * (1 - steelShare) + steelDensity * steelShare;
	m.m_ultimatePlasticStrain = ductility;
	return m;
}

Beam::Beam(World& world, const std::string& name, const BeamSettings& settings, const btTransform& start)
	: m_name(name), m_settings(settings), m_start(start), m_nodes(settings.blocks + 1)
{
	const BeamSettings& s = m_settings;
	btCollisionShape* const shape = world.box(btVector3(blockLength(), s.height, s.width));
	for (int i = 0; i < s.blocks; ++i)
	{
		btRigidBody* const block = world.body(blockMass(), shape, along((i + btScalar(.5)) * blockLength()));
		block->setFriction(s.friction);
		block->setDamping(damping(), damping());
		m_blocks.push_back(block);
		if (i > 0)
			join(world, *m_blocks[i - 1], *block, i, false);
	}
}

btElasticPlasticJoint* Beam::joinStart(World& world, btRigidBody& support)
{
	return join(world, support, *m_blocks.front(), 0, true);
}

btElasticPlasticJoint* Beam::joinEnd(World& world, btRigidBody& support)
{
	return join(world, *m_blocks.back(), support, m_settings.blocks, true);
}

btElasticPlasticJoint* Beam::join(World& world, btRigidBody& a, btRigidBody& b, int node, bool atSupport)
{
	const BeamSettings& s = m_settings;
	const btScalar before = atSupport && node == 0 ? 0 : blockLength(),
				   after = atSupport && node > 0 ? 0 : blockLength();
	const btScalar hinge = atSupport && s.endHingeLength > 0 ? s.endHingeLength : s.hingeLength;
	const btElasticPlasticCapacity capacity =
		btElasticPlasticCapacity::fromMember(s.material, s.section, before, after, hinge);
	btElasticPlasticJoint* const joint = world.joint(a, b, along(node * blockLength()), capacity);
	joint->setName((m_name + " " + std::to_string(node)).c_str());
	m_nodes[node] = joint;
	return joint;
}

btTransform Beam::along(btScalar x) const
{
	return m_start * btTransform(btQuaternion(0, 0, 0, 1), btVector3(x, 0, 0));
}

std::vector<btElasticPlasticJoint*> Beam::joints() const
{
	std::vector<btElasticPlasticJoint*> joints;
	for (btElasticPlasticJoint* joint : m_nodes)
		if (joint)
			joints.push_back(joint);
	return joints;
}

btVector3 Beam::startPoint() const
{
	return m_blocks.front()->getCenterOfMassTransform() * btVector3(-blockLength() / 2, 0, 0);
}

btVector3 Beam::endPoint() const
{
	return m_blocks.back()->getCenterOfMassTransform() * btVector3(blockLength() / 2, 0, 0);
}

btScalar Beam::blockMass() const
{
	// The box around a round bar is larger than the bar.
	const btScalar area = m_settings.isRound ? m_settings.section.m_area : m_settings.height * m_settings.width;
	return m_settings.material.m_density * blockLength() * area;
}

btScalar Beam::bendingStiffness() const
{
	const btElasticPlasticMaterial& m = m_settings.material;
	return m.m_youngsModulus * m.m_loadBearingShare * m_settings.section.m_secondMoment[1];
}

btScalar Beam::shearStiffness() const
{
	const btElasticPlasticMaterial& m = m_settings.material;
	return m.shearModulus() * m.m_loadBearingShare * m_settings.section.m_shearArea[0];
}

/// Bullet's damping takes the share d of the velocity in a second, v' = ln(1 - d) v: 2 zeta omega = -ln(1 - d).
btScalar Beam::damping() const
{
	const BeamSettings& s = m_settings;
	const btScalar massPerLength = blockMass() / blockLength();
	const btScalar omega = s.mode / (s.length * s.length) * btSqrt(bendingStiffness() / massPerLength);
	return 1 - btExp(-2 * s.dampingRatio * omega);
}
}  // namespace ep
