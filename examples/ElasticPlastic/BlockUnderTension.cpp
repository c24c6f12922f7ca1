#include "BlockUnderTension.h"

namespace ep
{
BlockUnderTension::BlockUnderTension(const Settings& s)
	: m_world(s.solver, quatRotate(s.turn, btVector3(0, -s.gravity, 0))),
	  m_down(quatRotate(s.turn, btVector3(0, -1, 0)))
{
	const btTransform turn(s.turn);
	const btQuaternion body = s.turn * s.bodyTurn;
	m_support = m_world.body(0, m_world.box(btVector3(1, 1, 1)), btTransform(body, turn * btVector3(0, 2, 0)), false);
	m_block = m_world.body(s.mass, m_world.box(btVector3(1, 3, 1)), btTransform(body), false);
	// The joint's x axis runs along the member and points from body A to body B.
	const btQuaternion axis(btVector3(0, 0, 1), s.blockFirst ? SIMD_HALF_PI : -SIMD_HALF_PI);
	const btTransform frame(s.turn * axis, turn * btVector3(0, btScalar(1.5), 0));
	btElasticPlasticCapacity capacity = btElasticPlasticCapacity::fromMember(
		btElasticPlasticMaterial::reinforcedConcrete(s.steelShare), btElasticPlasticSection::rectangle(1, 1), 0, 3);
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		capacity.m_ductility[i] = i == BT_EP_AXIAL ? s.ductility : btElasticPlasticCapacity::unlimited();
	m_joint = s.blockFirst ? m_world.joint(*m_block, *m_support, frame, capacity, s.jointClass)
						   : m_world.joint(*m_support, *m_block, frame, capacity, s.jointClass);
	m_joint->setScheme(s.scheme);
}

btScalar BlockUnderTension::sunk() const { return m_block->getCenterOfMassPosition().dot(m_down); }

void BlockUnderTension::pull(btScalar force) { m_block->applyCentralForce(m_down * force); }
}  // namespace ep
