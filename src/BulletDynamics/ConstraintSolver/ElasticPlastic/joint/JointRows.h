// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_JOINT_ROWS_H
#define BT_ELASTIC_PLASTIC_JOINT_ROWS_H

#include "Kinematics.h"
#include "Law.h"
#include "TensionDamping.h"

namespace btElasticPlastic
{
/// The least compliance that solvers give a row, as a share of its A: it changes the twelfth digit of the result.
const double HARD = 1e-12;

/// A joint's rows of one step, for a solver that adds compliance to the diagonal.
struct JointRows
{
	struct Row
	{
		int m_dof;
		btScalar m_diagonal;  ///< A = J M^-1 J^T
		SoftRow m_soft;
		signed char m_bound;  ///< where the row ended in the last direct solution (-1, 0, 1): a first guess
		int m_partner;        ///< the row with which it is coupled, -1: none
		btScalar m_coupling;  ///< compliance between the two
	};

	/// Along the axis at a place of the section, see btElasticPlasticFibre.
	struct Fibre
	{
		SoftRow m_soft;
		btScalar m_y, m_z;
		btScalar m_coupling[2];  ///< compliance between it and the two shears
		signed char m_bound;     ///< where it ended in the last solution
	};

	Kinematics m_kinematics;  ///< gives the Jacobians
	int m_numRows;            ///< without fibres
	Row m_row[BT_EP_DOF_COUNT];
	TensionDamping m_damping;
	int m_numFibres = 0;
	btAlignedObjectArray<Fibre> m_fibres;  ///< m_numFibres of them count: the memory serves joint after joint
	btScalar m_fibreDiagonal = 0;          ///< no fibre has a larger A
	int m_coupledShear[2] = {-1, -1};      ///< rows that are coupled with the fibres, -1: none
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_JOINT_ROWS_H
