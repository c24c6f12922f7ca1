// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_JOINT_READING_H
#define EP_JOINT_READING_H

#include "world/World.h"

namespace ep
{
/// What a joint of a scene tells, whichever kind stands in its place. Of one of Bullet's, utilisation is its load over what the
/// elastic-plastic one would yield at: more than 1 is what it should not have borne.
struct JointReading
{
	bool isThere = false;  ///< not of kind none
	bool hasYielded = false, isBroken = false;
	double utilisation = 0;
	int limitingDof = 0;
	double damage = 0;  ///< share of the ductility that is spent
	double elasticEnergy = 0, plasticEnergy = 0, dampingEnergy = 0, numericalEnergy = 0;  ///< [J]
	double force[BT_EP_DOF_COUNT] = {};        ///< by the joint's axes [N], [N m]
	double deformation[BT_EP_DOF_COUNT] = {};  ///< elastic and plastic [m], [rad]
};

JointReading readJoint(const World& world, const btElasticPlasticJoint& joint);
}  // namespace ep

#endif  // EP_JOINT_READING_H
