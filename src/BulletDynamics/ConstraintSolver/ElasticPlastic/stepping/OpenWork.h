// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_OPEN_WORK_H
#define BT_ELASTIC_PLASTIC_OPEN_WORK_H

#include "LinearMath/btAlignedObjectArray.h"
#include "LinearMath/btVector3.h"

class btDynamicsWorld;
class btElasticPlasticJoint;
class btRigidBody;

namespace btElasticPlastic
{
/// The estimate by which substeps are chosen: how much of the energy at play a substep has left open.
///
/// A substep of length h takes the rate of deformation v as constant. What this leaves out is the second difference of the
/// deformation, h |v1 - v0|, which falls as h^2. Multiplied by the yield value it is work that the substep leaves undecided, the
/// open work. Its share in the energy at play of an island,
///
///     T = sum of open work / (kinetic energy + energy of the springs at yield + yield values times plastic deformation),
///
/// is of the size of the error in how much flows, or above it, for single degrees of freedom as for beams under blows, down
/// to errors of a per cent (docs/performance.md). The plastic deformation is the present one, not the path of all flow to and
/// fro, so that each swing counts by itself.
///
/// Only those degrees of freedom count that have flowed, or whose force may reach half of the yield value within a step, by its
/// rate and the change of its rate.
class OpenWork
{
public:
	/// Measures what a substep has left open, after it.
	/// \param joints  of the world
	/// \param length  of the substep [s]
	/// \param ahead   how far ahead yield is looked for, the length of the step [s]
	void measure(const btDynamicsWorld& world, const btAlignedObjectArray<btElasticPlasticJoint*>& joints,
				 double length, double ahead);

	/// T, the largest of all islands.
	double getShare() const { return m_share; }

	/// T without what may be the rounding of positions, which shorter substeps do not reduce.
	double getMendableShare() const { return m_mendableShare; }

private:
	struct Island
	{
		double m_openWork;
		double m_roundedWork;  ///< the part of it that may be the rounding of positions
		double m_energy, m_mass, m_momentum[3];
		double m_carried;  ///< the part of the kinetic energy that is motion of the whole
		bool m_isHeld;     ///< by a static or kinematic body
	};

	void addBodies(const btDynamicsWorld& world);
	void addJoints(const btAlignedObjectArray<btElasticPlasticJoint*>& joints);
	void addRow(Island& island, const btElasticPlasticJoint& joint, int r, double place) const;
	static void addSupport(Island& island, const btRigidBody& support, const btVector3& place);

	double m_length = 0, m_ahead = 0;
	double m_share = 0, m_mendableShare = 0;
	btAlignedObjectArray<Island> m_islands;  ///< by Bullet's island tag
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_OPEN_WORK_H
