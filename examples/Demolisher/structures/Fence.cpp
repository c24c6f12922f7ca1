// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "structures/Fence.h"

namespace ep
{
Fence::Fence(World& world, const Materials& materials, const FenceSettings& s, const btVector3& origin)
{
	for (int i = 0; i < s.posts; ++i)
		addPost(world, materials, s, origin + btVector3(0, 0, (i - (s.posts - 1) / btScalar(2)) * s.spacing), i);
	for (int i = 0; i + 1 < s.posts; ++i)
		addRails(world, materials, s, i);
}

void Fence::addPost(World& world, const Materials& materials, const FenceSettings& s, const btVector3& foot, int index)
{
	BeamSettings post;
	post.blocks = s.postBlocks;
	post.length = s.height;
	post.height = post.width = s.postThickness;
	post.section = btElasticPlasticSection::rectangle(s.postThickness, s.postThickness);
	post.material = materials.mixed(s.steelShare);
	post.hingeLength = s.postHinge;
	// Along y; its y axis is against the vehicle's way, its z axis across.
	const btMatrix3x3 turn(0, -1, 0, 1, 0, 0, 0, 0, 1);
	m_beams.emplace_back(world, "post " + std::to_string(index), post, btTransform(turn, foot));
	// What it is rooted in stands for the ground.
	const btScalar depth = 1;
	btRigidBody* const root = world.body(0, world.box(btVector3(s.postThickness, depth, s.postThickness)),
										 btTransform(btQuaternion(0, 0, 0, 1), foot - btVector3(0, depth / 2, 0)));
	m_beams.back().joinStart(world, *root);
}

void Fence::addRails(World& world, const Materials& materials, const FenceSettings& s, int bay)
{
	BeamSettings rail;
	rail.blocks = s.railBlocks;
	rail.length = s.spacing - s.postThickness;
	rail.height = rail.width = s.railThickness;
	rail.section = btElasticPlasticSection::rectangle(s.railThickness, s.railThickness);
	rail.material = materials.mixed(1);
	rail.hingeLength = s.railHinge;
	const btMatrix3x3 turn(0, 1, 0, 0, 0, 1, 1, 0, 0);  // along z
	for (int i = 0; i < s.rails; ++i)
	{
		btRigidBody& left = *m_beams[bay].m_parts[s.postBlocks - 1 - i];
		btRigidBody& right = *m_beams[bay + 1].m_parts[s.postBlocks - 1 - i];
		m_beams.emplace_back(world, "rail " + std::to_string(bay) + "/" + std::to_string(i), rail,
							 btTransform(turn, left.getCenterOfMassPosition() + btVector3(0, 0, s.postThickness / 2)));
		m_beams.back().joinStart(world, left);
		m_beams.back().joinEnd(world, right);
	}
}
}  // namespace ep
