// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CANTILEVER_H
#define EP_CANTILEVER_H

#include "scenes/Member.h"

namespace ep
{
/// A steel cantilever of rigid boxes under its own weight: the structure that iterative solvers let sag by metres.
/// The root joint stands for half a box's length only and is twice as stiff. Stepped with 1/60 s from rest it settles within
/// a second if it is short and stiff, and swings on if it is the long one.
struct Cantilever
{
	struct Settings
	{
		Method method = Solver::Direct;
		btScalar length = 2;                           ///< [m]
		btScalar gravity = btScalar(9.81);             ///< [m/s^2]
		Member::Settings member;                       ///< default: 10 parts, 0.1 x 0.1 m
		btQuaternion turn = btQuaternion(0, 0, 0, 1);  ///< of the whole scene about the root

		Settings();

		/// 10 m in 20 blocks, 400 MPa, g = 10: swings slowly and wide.
		static Settings twentyBlocks();
	};

	explicit Cantilever(const Settings& settings);

	/// How far the tip hangs below the root [m].
	btScalar sag() const;

	/// What sag() is at rest for these rigid boxes on these joints, exactly (small deflections) [m].
	double staticSag() const;

	/// The same for a beam that bends and shears everywhere [m].
	double beamSag() const;

	World m_world;
	btRigidBody* m_support;
	Member m_member;
	btElasticPlasticJoint* m_root;

private:
	Settings m_settings;
};
}  // namespace ep

#endif  // EP_CANTILEVER_H
