// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_HANGING_CHAIN_H
#define EP_HANGING_CHAIN_H

#include "scenes/Member.h"

namespace ep
{
/// Steel blocks that hang one from the other, the last one much heavier than the others: iteration does not hold it.
struct HangingChain
{
	struct Settings
	{
		Method method = Solver::Direct;
		btScalar length = 3;         ///< [m]
		btScalar gravity = 10;       ///< [m/s^2]
		btScalar lastFactor = 1000;  ///< the last block's mass over the others'
		Member::Settings member;     ///< default: 6 blocks, 0.1 x 0.1 m, 400 MPa

		Settings();
	};

	explicit HangingChain(const Settings& settings);

	/// By how much it is longer than unloaded [m].
	btScalar stretch() const;

	/// What stretch() is at rest, exactly [m].
	double staticStretch() const;

	World m_world;
	btRigidBody* m_support;
	Member m_member;
	btElasticPlasticJoint* m_top;

private:
	Settings m_settings;
};
}  // namespace ep

#endif  // EP_HANGING_CHAIN_H
