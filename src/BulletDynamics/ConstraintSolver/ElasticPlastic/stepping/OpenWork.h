// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_OPEN_WORK_H
#define BT_ELASTIC_PLASTIC_OPEN_WORK_H

#include "LinearMath/btAlignedObjectArray.h"
#include "LinearMath/btVector3.h"

class btDynamicsWorld;
class btElasticPlasticAction;
class btElasticPlasticJoint;
class btRigidBody;

namespace btElasticPlastic
{
/// The estimate that the choice of substeps rests on: how much of the energy at play a substep has left open.
///
/// A substep of length h takes the rate of deformation v as constant. What that leaves out is the second difference of the
/// deformation, h |v1 - v0|, which falls as h^2. Times the yield value it is work that may have gone one way or the other, the
/// open work. Set against the energy that is at play,
///
///     T = sum of open work / (kinetic energy + energy of the springs at yield + yield values times plastic deformation),
///
/// of an island, it is of the size of the error in how much flows or above it, for single degrees of freedom as for beams under
/// blows, down to errors of a per cent (docs/performance.md). Plastic deformation is the one that there is, not the path of all
/// that has gone to and fro: each swing counts by itself.
///
/// Only degrees of freedom count that have flowed or may reach half of their yield value within a step, by their force's rate
/// and its change.
class OpenWork
{
public:
	/// Looks at the world after a substep.
	/// \param length  of the substep [s]
	/// \param ahead   how far ahead yield counts: the step [s]
	void measure(const btDynamicsWorld& world, btElasticPlasticAction& action, double length, double ahead);

	/// T, the largest of all islands.
	double getShare() const { return m_share; }

	/// The same without what may be the rounding of places: shorter substeps do not mend that.
	double getMendableShare() const { return m_mendableShare; }

private:
	struct Island
	{
		double m_openWork;
		double m_roundedWork;  ///< of it, what may be the rounding of places
		double m_energy, m_mass, m_momentum[3];
		double m_carried;  ///< of the kinetic energy, what the motion of the whole is
		bool m_isHeld;     ///< by something that does not move with it
	};

	void addBodies(const btDynamicsWorld& world);
	void addJoints(btElasticPlasticAction& action);
	void addRow(Island& island, const btElasticPlasticJoint& joint, int r, double place) const;
	static void addSupport(Island& island, const btRigidBody& support, const btVector3& place);

	double m_length = 0, m_ahead = 0;
	double m_share = 0, m_mendableShare = 0;
	btAlignedObjectArray<Island> m_islands;  ///< by Bullet's tag
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_OPEN_WORK_H
