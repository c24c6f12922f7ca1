// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BLOCK_UNDER_TENSION_H
#define EP_BLOCK_UNDER_TENSION_H

#include "world/World.h"

namespace ep
{
/// The paper's first example (section 3.1): a block of reinforced concrete, 1 x 3 x 1 m, 1.5 m above rigid ground.
/// It falls (Tables V and VI), is held by a fixed joint (Table VII) or by an elastic-plastic one (Tables IX and X, Figure 6).
/// Released at rest on the latter it sinks, yields, and swings.
struct BlockUnderTension
{
	struct Settings
	{
		Method method = Solver::Iterative;
		btScalar mass = 6000;  ///< [kg]; the paper's text rounds exactMass() to this
		btScalar steelShare = btScalar(0.0004);
		btScalar ductility = btElasticPlasticCapacity::unlimited();  ///< of the axial degree of freedom [m]
		btScalar gravity = 10;                                       ///< [m/s^2]
		bool held = true;                                            ///< by the elastic-plastic joint
		bool ground = false;
		bool blockFirst = false;  ///< the block is body A and the support body B, instead of the other way round
		btQuaternion turn = btQuaternion(0, 0, 0, 1);  ///< of the whole scene about the block's centre
		btQuaternion bodyTurn =
			btQuaternion(0, 0, 0, 1);  ///< of the bodies' own frames against the scene, without ground

		/// Steel in concrete by volume: 6006.96 kg.
		btScalar exactMass() const { return 3 * (steelShare * 7800 + (1 - steelShare) * 2000); }
	};

	/// \param solver  in place of the one in the settings, null: that one
	explicit BlockUnderTension(const Settings& settings, std::unique_ptr<btConstraintSolver> solver = nullptr);

	/// How far the block has sunk [m].
	btScalar sunk() const;

	/// Pulls the block down with a force during the next step [N].
	void pull(btScalar force);

	/// Frame of the joint at the top of the block, world coordinates; x points from body A to body B.
	btTransform m_top;

	World m_world;
	btVector3 m_down;  ///< unit vector, world coordinates
	btRigidBody* m_support;
	btRigidBody* m_block;
	btElasticPlasticJoint* m_joint = nullptr;
};
}  // namespace ep

#endif  // EP_BLOCK_UNDER_TENSION_H
