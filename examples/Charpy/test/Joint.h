// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_JOINT_H
#define EP_CHARPY_JOINT_H

#include <cmath>

#include "test/Energy.h"

namespace ep::charpy
{
/// What a joint has to bear, and where it is.
struct JointPlace
{
	btRigidBody *a, *b;
	btTransform frame;   ///< world, x along the specimen, y along the blow
	double height;       ///< of the section [m]
	double pieceLength;  ///< [m]
};

/// The joint between two pieces, in one of the ways of modelling. Energies are in Bullet's unit of length.
class Joint
{
public:
	Joint(World& world, Energy& energy, const Settings& settings, const JointPlace& place);

	/// That it can be computed with [s].
	double longestStep() const { return m_bullets ? m_bullets->longestStep() : HUGE_VAL; }
	bool isBroken() const { return m_bullets ? m_bullets->isBroken() : m_joint->isBroken(); }
	double plasticWork() const;
	double elasticEnergy() const { return m_bullets ? m_bullets->elasticEnergy() : m_joint->getElasticEnergy(); }
	double numericalEnergy() const;

private:
	/// From the bodies, in all, by one of Bullet's.
	double taken() const { return -m_energy.work(m_number); }

	Energy& m_energy;
	const btElasticPlasticJoint* m_joint;
	const BulletJoint* m_bullets;  // in its place, or null
	int m_number = 0;              // of the constraint in m_energy
};
}  // namespace ep::charpy

#endif  // EP_CHARPY_JOINT_H
