// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PORTAL_FRAME_H
#define EP_PORTAL_FRAME_H

#include "scenes/Member.h"

namespace ep
{
/// Two clamped columns and a beam of steel, without weight, under a load V at mid beam and H at its level.
/// Collapses as a beam (V L = 8 Mp), sideways (H h = 4 Mp), or both (H h + V L / 2 = 6 Mp), whichever comes first.
struct PortalFrame
{
	struct Settings
	{
		Method method = Solver::Direct;
		btScalar span = 4;    ///< L [m]
		btScalar height = 3;  ///< h [m]
		/// 6 parts in each member, 0.4 x 0.4 m, 25 MPa: stocky and weak, for limit analysis knows no sway before collapse. The
		/// load's moment over that sway takes a share from the collapse load that goes with yield stress * L / (E * thickness).
		Member::Settings member;

		Settings();
	};

	explicit PortalFrame(const Settings& settings);

	/// Mp [N m]
	double plasticMoment() const { return m_middle->getCapacity().m_yield[BT_EP_BENDING_Z]; }

	/// Factor on the loads V and H at which it collapses by the first of its three mechanisms.
	double collapseFactor(double vertical, double horizontal) const;

	/// Puts the loads on, downwards at mid beam and to the right at the left corner, for the next step [N].
	void load(double vertical, double horizontal);

	/// How far mid beam has sunk and the left corner has moved to the right [m].
	btScalar sag() const { return m_settings.height - m_middle->getPosition().y(); }
	btScalar sway() const { return m_leftCorner->getPosition().x(); }

	World m_world;
	btRigidBody* m_ground;
	Member m_leftColumn;   ///< from the ground up
	Member m_beam;         ///< from left to right
	Member m_rightColumn;  ///< from the beam down
	btElasticPlasticJoint* m_leftCorner;
	btElasticPlasticJoint* m_rightCorner;
	btElasticPlasticJoint* m_middle;

private:
	Settings m_settings;
};
}  // namespace ep

#endif  // EP_PORTAL_FRAME_H
