// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BEAM_ON_SUPPORTS_H
#define EP_BEAM_ON_SUPPORTS_H

#include "scenes/Member.h"

namespace ep
{
/// A concrete beam that lies on two blocks, held by contacts alone, and a box of 2 t dropped on its middle from half a metre:
/// joints and contacts in one island, each stiff, and coupled.
struct BeamOnSupports
{
	struct Settings
	{
		Method method = Solver::Direct;
		btScalar length = 10;  ///< [m]
		btScalar gravity = btScalar(9.81);
		btScalar mass = 2000;           ///< of the dropped box [kg]; 0: none
		btScalar drop = btScalar(0.5);  ///< from where to the beam [m]
		bool elastic = false;           ///< joints never yield
		Member::Settings member;        ///< default: 20 parts, 0.5 x 0.4 m

		Settings();
	};

	explicit BeamOnSupports(const Settings& settings);

	/// How far mid span has sunk [m].
	btScalar sag() const;

	World m_world;
	Member m_member;
	btRigidBody* m_box = nullptr;

private:
	Settings m_settings;
};
}  // namespace ep

#endif  // EP_BEAM_ON_SUPPORTS_H
