// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SPRING_LANES_H
#define BT_ELASTIC_PLASTIC_SPRING_LANES_H

#include "Lanes.h"
#include "Law.h"
#include "MaterialDamping.h"

struct btElasticPlasticCapacity;
struct btElasticPlasticState;

namespace btElasticPlastic
{
/// The six springs of a joint side by side: what Law.h says of one row, by row, in loops over all of them that compilers make vector
/// instructions of. It is the same to the bit. Most joints are six springs, and most of them flow in few steps: a joint that is or does otherwise
/// asks each of its rows by itself.
class SpringLanes
{
public:
	/// Rows by degree of freedom, see SoftRow.
	struct Rows
	{
		Lanes m_compliance, m_velocity, m_lower, m_upper;
		btScalar m_coupling[2];  ///< compliance between the rows of a pair, see coupledWith(); 0: none
	};

	/// Whether all degrees of freedom have a spring.
	static bool areSprings(const btElasticPlasticCapacity& capacity);

	/// The springs at the start of a step.
	/// \param strain      measured, by degree of freedom
	/// \param yield       values in the step
	/// \param areCoupled  whether shears are coupled with bendings as the capacity says
	SpringLanes(const btElasticPlasticCapacity& capacity, const btElasticPlasticState& state,
				const MaterialDamping& damping, const btScalar strain[BT_EP_DOF_COUNT],
				const btScalar yield[BT_EP_DOF_COUNT], bool areCoupled);

	/// \param diagonal  A = J M^-1 J^T, by degree of freedom
	void makeRows(const Lanes& diagonal, btScalar dt, btScalar lastStep, Rows& rows) const;

	/// Maps the deformations that they would have if the whole step was elastic.
	/// \param force  gets the springs' forces at the end of the step
	/// \return false if one of them is beyond its yield value; then force means nothing
	bool mapElastic(const Lanes& trial, Lanes& force) const;

	/// Compliance by which a shear is coupled with its bending: of BT_EP_SHEAR_Y, of BT_EP_SHEAR_Z [1/N].
	btScalar getCoupling(int pair) const { return m_coupling[pair]; }

private:
	DofState at(int i) const;

	Lanes m_stiffness, m_yield, m_strain, m_force, m_forceRate, m_carried;
	btScalar m_stiffening;
	btScalar m_coupling[2];
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SPRING_LANES_H
