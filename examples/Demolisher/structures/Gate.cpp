// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "structures/Gate.h"

namespace ep
{
Gate::Gate(World& world, const Materials& materials, const GateSettings& s, const btVector3& origin) : m_settings(s)
{
	BeamSettings boom;
	boom.blocks = s.blocks;
	boom.length = s.length;
	boom.height = boom.width = s.thickness;
	boom.section = btElasticPlasticSection::rectangle(s.thickness, s.thickness);
	boom.material = materials.mixed(1);
	boom.hingeLength = s.hingeLength;
	boom.friction = btScalar(.3);
	// Along z; its y axis is the vehicle's way, so that a hinge about its z axis lets it swing open.
	const btMatrix3x3 turn(0, 1, 0, 0, 0, 1, 1, 0, 0);
	m_beams.emplace_back(world, "gate", boom, btTransform(turn, origin + btVector3(0, s.height, -s.length / 2)));
	m_beams.front().joinStart(world, *addBox(world, materials, origin, -1));
	if (s.twoSupports)
		m_beams.front().joinEnd(world, *addBox(world, materials, origin, 1));
}

btRigidBody* Gate::addBox(World& world, const Materials& materials, const btVector3& origin, btScalar side)
{
	const btScalar edge = m_settings.box;
	const btVector3 centre = origin + btVector3(0, edge / 2, side * (m_settings.length + edge) / 2);
	btRigidBody* const box =
		world.body(materials.concreteDensity * edge * edge * edge, world.box(btVector3(edge, edge, edge)),
				   btTransform(btQuaternion(0, 0, 0, 1), centre));
	box->setFriction(btScalar(.8));
	m_boxes.push_back(box);
	return box;
}

btScalar Gate::sag() const
{
	const std::vector<btRigidBody*>& blocks = boom().m_parts;
	if (!m_settings.twoSupports)
		return m_settings.height - boom().endPoint().y();
	const size_t n = blocks.size();
	const btScalar middle =
		(blocks[(n - 1) / 2]->getCenterOfMassPosition().y() + blocks[n / 2]->getCenterOfMassPosition().y()) / 2;
	return m_settings.height - middle;
}

btScalar Gate::beamSag(btScalar gravity) const
{
	const btScalar load = boom().blockMass() / boom().m_partLength * gravity,
				   l2 = m_settings.length * m_settings.length;
	const btScalar bending = boom().bendingStiffness(), shear = boom().shearStiffness();
	if (m_settings.twoSupports)
		return load * l2 * l2 / (384 * bending) + load * l2 / (8 * shear);
	return load * l2 * l2 / (8 * bending) + load * l2 / (2 * shear);
}
}  // namespace ep
