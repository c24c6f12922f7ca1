// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SOLVER_POOLS_H
#define BT_ELASTIC_PLASTIC_SOLVER_POOLS_H

#include "BulletDynamics/ConstraintSolver/btSolverBody.h"
#include "BulletDynamics/ConstraintSolver/btSolverConstraint.h"

namespace btElasticPlastic
{
/// References to the solver bodies and rows of the island that Bullet's sequential impulse solver is solving.
struct SolverPools
{
	btAlignedObjectArray<btSolverBody>& m_bodies;
	btConstraintArray& m_constraints;  ///< rows of joints and other constraints
	btConstraintArray& m_contacts;
	btConstraintArray& m_friction;
	btConstraintArray& m_rollingFriction;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SOLVER_POOLS_H
