// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_OPEN_WORK_H
#define BT_ELASTIC_PLASTIC_OPEN_WORK_H

#include "../joint/OpenShare.h"
#include "LinearMath/btAlignedObjectArray.h"

class btDynamicsWorld;
class btElasticPlasticJoint;

namespace btElasticPlastic
{
/// What a world's substep has left open: the estimate T of each of its islands, see OpenShare.
class OpenWork
{
public:
	/// Measures what a substep has left open, after it. A joint that has gone through it in several inner steps counts by the last of
	/// them.
	/// \param joints  of the world
	/// \param ahead   how far ahead yield is looked for, the length of the step [s]
	void measure(const btDynamicsWorld& world, const btAlignedObjectArray<btElasticPlasticJoint*>& joints,
				 double ahead);

	/// T, the largest of all islands.
	double getShare() const { return m_share; }

	/// T without what may be the rounding of positions, which shorter substeps do not reduce, and without what moves elastically where springs or motors
	/// of Bullet's act: what these give and take in half a substep, whenever it changes, would add up.
	double getMendableShare() const { return m_mendableShare; }

private:
	void addBodies(const btDynamicsWorld& world);
	void addDrives(const btDynamicsWorld& world);
	void addJoints(const btAlignedObjectArray<btElasticPlasticJoint*>& joints, double ahead);

	double m_share = 0, m_mendableShare = 0;
	struct Island
	{
		OpenShare m_open;
		bool m_isDriven = false, m_flows = false;
	};
	btAlignedObjectArray<Island> m_islands;  ///< by Bullet's island tag
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_OPEN_WORK_H
