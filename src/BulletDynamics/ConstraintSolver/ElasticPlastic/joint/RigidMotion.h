// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_RIGID_MOTION_H
#define BT_ELASTIC_PLASTIC_RIGID_MOTION_H

#include "LinearMath/btTransform.h"

class btRigidBody;

namespace btElasticPlastic
{
/// The velocities of bodies that move as one.
struct RigidMotion
{
	btVector3 m_centre = btVector3(0, 0, 0);    ///< [m]
	btVector3 m_velocity = btVector3(0, 0, 0);  ///< there [m/s]
	btVector3 m_spin = btVector3(0, 0, 0);      ///< [rad/s]

	btVector3 at(const btVector3& place) const { return m_velocity + m_spin.cross(place - m_centre); }

	/// That of a body.
	static RigidMotion of(const btRigidBody& body);
	/// That of one that stands or goes its way: a static one stands, whatever velocity it has been given.
	static RigidMotion ofHeld(const btRigidBody& body);

	/// A body that moves: where it is, and how fast.
	struct Part
	{
		const btRigidBody* m_body;
		btTransform m_pose;
		btVector3 m_velocity, m_spin;

		/// I w [kg m^2/s]; nothing about axes about which the body cannot be turned.
		btVector3 angularMomentum(const btVector3& spin) const;
	};

	/// That in which bodies have the momentum and the angular momentum that they have by themselves.
	static RigidMotion of(const Part* parts, int numParts);
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_RIGID_MOTION_H
