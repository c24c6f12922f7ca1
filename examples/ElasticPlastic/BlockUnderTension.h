#ifndef EP_BLOCK_UNDER_TENSION_H
#define EP_BLOCK_UNDER_TENSION_H

#include "World.h"

namespace ep
{
/// The paper's first example (section 3.1): a block of reinforced concrete, 1 x 3 x 1 m, hangs by its top on a joint.
/// Released at rest it sinks, yields, and swings.
struct BlockUnderTension
{
	struct Settings
	{
		Solver solver = Solver::Iterative;
		JointClass jointClass = JointClass::Spring2;
		btElasticPlasticScheme scheme = BT_EP_SCHEME_IMPLICIT;
		btScalar mass = 6000;  ///< [kg]
		btScalar steelShare = btScalar(0.0004);
		btScalar ductility = btElasticPlasticCapacity::unlimited();  ///< of the axial degree of freedom [m]
		btScalar gravity = 10;                                       ///< [m/s^2]
		bool blockFirst = false;  ///< the block is body A and the support body B, instead of the other way round
		btQuaternion turn = btQuaternion(0, 0, 0, 1);      ///< of the whole scene about the block's centre
		btQuaternion bodyTurn = btQuaternion(0, 0, 0, 1);  ///< of the bodies' own frames against the scene
	};

	explicit BlockUnderTension(const Settings& settings);

	/// How far the block has sunk [m].
	btScalar sunk() const;

	/// Pulls the block down with a force during the next step [N].
	void pull(btScalar force);

	World m_world;
	btVector3 m_down;  ///< unit vector, world coordinates
	btRigidBody* m_support;
	btRigidBody* m_block;
	btElasticPlasticJoint* m_joint;
};
}  // namespace ep

#endif  // EP_BLOCK_UNDER_TENSION_H
