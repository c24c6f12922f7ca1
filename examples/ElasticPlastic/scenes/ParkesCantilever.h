// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PARKES_CANTILEVER_H
#define EP_PARKES_CANTILEVER_H

#include "scenes/Member.h"

namespace ep
{
/// Parkes (The permanent deformation of a cantilever struck transversely at its tip, 1955): a cantilever with a mass at its
/// tip that is given a velocity; a plastic hinge runs from the tip to the root and stays there until all stops.
struct ParkesCantilever
{
	struct Settings
	{
		Method method = Solver::Direct;
		btScalar length = 1;               ///< L [m]
		btScalar tipMass = btScalar(1.5);  ///< G [kg]
		btScalar velocity = 25;            ///< V0, downwards [m/s]
		bool rigidPlastic = false;         ///< no elasticity in bending, as in Parkes' theory
		Member::Settings member;           ///< default: 20 parts, 0.02 x 0.02 m, 250 MPa

		Settings();
	};

	explicit ParkesCantilever(const Settings& settings);

	/// How far the tip mass has gone [m].
	double tip() const { return -double(m_mass->getCenterOfMassPosition().y()); }

	/// Rotation of the first part [rad].
	double rootRotation() const;

	/// Parkes' results for small deflections.
	double exactTip() const;           ///< [m]
	double exactRootRotation() const;  ///< [rad]
	double exactDuration() const;      ///< [s]

	/// The blow's energy over what the cantilever can store elastically: Parkes wants it large.
	double energyRatio() const;

	World m_world;
	btRigidBody* m_support;
	Member m_member;
	btElasticPlasticJoint* m_root;
	btRigidBody* m_mass;

private:
	double plasticMoment() const { return m_root->getCapacity().m_yield[BT_EP_BENDING_Z]; }
	double massPerLength() const;

	Settings m_settings;
};
}  // namespace ep

#endif  // EP_PARKES_CANTILEVER_H
