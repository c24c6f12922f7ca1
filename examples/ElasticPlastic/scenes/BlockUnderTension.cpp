// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/BlockUnderTension.h"

namespace ep
{
BlockUnderTension::BlockUnderTension(const Settings& s, std::unique_ptr<btConstraintSolver> solver)
	: m_world(s.method, quatRotate(s.turn, btVector3(0, -s.gravity, 0)), std::move(solver)),
	  m_down(quatRotate(s.turn, btVector3(0, -1, 0)))
{
	const btTransform turn(s.turn);
	const btQuaternion body = s.turn * s.bodyTurn,
					   along(btVector3(0, 0, 1), s.blockFirst ? SIMD_HALF_PI : -SIMD_HALF_PI);
	m_top = btTransform(s.turn * along, turn * btVector3(0, btScalar(1.5), 0));
	if (s.ground)
		m_world.body(0, m_world.box(btVector3(20, 6, 20)), btTransform(s.turn, turn * btVector3(0, -6, 0)));
	m_support = m_world.body(0, m_world.box(btVector3(1, 1, 1)), btTransform(body, turn * btVector3(0, 2, 0)), false);
	m_block = m_world.body(s.mass, m_world.box(btVector3(1, 3, 1)), btTransform(body), s.ground);
	if (!s.held)
		return;
	const btScalar support = 0, block = 3;
	btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(
		btElasticPlasticMaterial::reinforcedConcrete(s.steelShare), btElasticPlasticSection::rectangle(1, 1),
		s.blockFirst ? block : support, s.blockFirst ? support : block);
	capacity.m_damping = 0;  // as in the paper
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		capacity.m_ductility[i] = i == BT_EP_AXIAL ? s.ductility : btElasticPlasticCapacity::unlimited();
	m_joint = s.blockFirst ? m_world.joint(*m_block, *m_support, m_top, capacity)
						   : m_world.joint(*m_support, *m_block, m_top, capacity);
}

btScalar BlockUnderTension::sunk() const { return m_block->getCenterOfMassPosition().dot(m_down); }

void BlockUnderTension::pull(btScalar force) { m_block->applyCentralForce(m_down * force); }
}  // namespace ep
