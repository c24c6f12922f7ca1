// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_OPEN_SHARE_H
#define BT_ELASTIC_PLASTIC_OPEN_SHARE_H

#include "../../btElasticPlasticCapacity.h"
#include "LinearMath/btVector3.h"

class btRigidBody;

namespace btElasticPlastic
{
/// The estimate by which steps are chosen, of one island: how much of the energy at play a step has left open.
///
/// A step of length h takes the rate of deformation v as constant. What this leaves out is the second difference of the
/// deformation, h |v1 - v0|, which falls as h^2. Multiplied by the yield value it is work that the step leaves undecided, the
/// open work. Its share in the energy at play,
///
///     T = sum of open work / (kinetic energy + energy of the springs at yield + yield values times plastic deformation),
///
/// is of the size of the error in how much flows, or above it, for single degrees of freedom as for beams under blows, down
/// to errors of a per cent (docs/performance.md). The plastic deformation is the present one, not the path of all flow to and
/// fro, so that each swing counts by itself.
///
/// A flow that slows down leaves as much open in each of its v / |v1 - v0| steps until it stands, half of that in the mean: the force
/// comes on half a step late, and all that follows is by so much too fast. Where a step can be taken again it counts for all of them. A step control begins with short
/// steps, and so has seen the force come on in one.
///
/// Only those degrees of freedom count that have flowed, or whose force may reach half of the yield value within a step, by its
/// rate and the change of its rate; where a step that turns out to be too long can be taken again, only the latter.
class OpenShare
{
public:
	explicit OpenShare(bool canGoBack = false) : m_canGoBack(canGoBack) {}

	/// What a row has done in a step.
	struct Row
	{
		int m_dof;
		btScalar m_before, m_after;  ///< rate of deformation, before and after the step [m/s], [rad/s]
		btScalar m_force;            ///< [N], [N m]
		btScalar m_plastic, m_path;  ///< plastic deformation, and the path of all flow [m], [rad]
		bool m_flows = false;        ///< in a step that can be taken again: whether it does in it
	};

	/// What all degrees of freedom of a joint have done, as Row says, with rates of either sign; force and rate before the step are 0 where it has
	/// no row.
	struct Motion
	{
		btScalar m_before[BT_EP_DOF_COUNT], m_after[BT_EP_DOF_COUNT], m_force[BT_EP_DOF_COUNT];
		const btScalar* m_path;
	};

	/// Whether nothing of a joint has flowed or comes near yield: then its rows would add nothing. It costs a fraction of asking them.
	static bool isClear(const btElasticPlasticCapacity& capacity, const Motion& motion, btScalar length,
						btScalar ahead);

	/// A body that moves, with the velocities after the step.
	void addBody(const btRigidBody& body);

	/// A body that does not move freely, and holds the island at a place.
	void addSupport(const btRigidBody& support, const btVector3& place);

	/// \param length  of the step [s]
	/// \param ahead   how far ahead yield is looked for [s]
	/// \param place   the size of the joint's coordinates [m]
	void addRow(const btElasticPlasticCapacity& capacity, const Row& row, double length, double ahead, double place);

	/// Whether a row's force reaches a good part of its yield value within the step itself. Where none does, an oscillation that steps
	/// of this length resolve stays clear of yield, however fast it is: it is only the look ahead that takes its rate for lasting.
	bool isLoaded() const { return m_isLoaded; }

	bool hasOpenWork() const { return m_openWork > 0; }

	/// Yield values times rates of deformation, of the rows that count: how fast joints move [W].
	double getPower() const { return m_power; }

	/// What the springs of these rows hold at yield [J].
	double getYieldEnergy() const { return m_yieldEnergy; }

	/// T
	double getShare() const { return m_openWork > 0 ? m_openWork / getEnergy() : 0; }

	/// T without what may be the rounding of positions, which shorter steps do not reduce.
	double getMendableShare() const { return m_openWork > 0 ? (m_openWork - m_roundedWork) / getEnergy() : 0; }

private:
	double getEnergy() const;
	static double stepsLikeThis(const Row& row);

	const bool m_canGoBack;
	bool m_isLoaded = false;
	double m_openWork = 0, m_power = 0, m_yieldEnergy = 0;
	double m_roundedWork = 0;  ///< the part of it that may be the rounding of positions
	double m_energy = 0, m_mass = 0, m_momentum[3] = {};
	double m_carried = 0;   ///< the part of the kinetic energy that is motion of the support
	bool m_isHeld = false;  ///< by a static or kinematic body
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_OPEN_SHARE_H
