// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "structures/Rod.h"

namespace ep
{
Rod::Rod(World& world, const Materials& materials, const RodSettings& s, const btVector3& origin)
{
	BeamSettings rod;
	rod.blocks = s.blocks;
	rod.length = s.height;
	rod.height = rod.width = 2 * s.radius;
	rod.section = btElasticPlasticSection::circle(s.radius);
	rod.isRound = true;
	rod.material = materials.mixed(1);
	rod.hingeLength = s.hingeLength;
	rod.friction = btScalar(.3);
	// Along y; its y axis is against the vehicle's way, its z axis across.
	const btMatrix3x3 turn(0, -1, 0, 1, 0, 0, 0, 0, 1);
	m_beams.emplace_back(world, "rod", rod, btTransform(turn, origin));
	const btScalar depth = 1;
	btRigidBody* const root = world.body(0, world.box(btVector3(1, depth, 1)),
										 btTransform(btQuaternion(0, 0, 0, 1), origin - btVector3(0, depth / 2, 0)));
	m_beams.front().joinStart(world, *root);
}
}  // namespace ep
