// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_DIRECT_SOLVER_H
#define EP_TEST_DIRECT_SOLVER_H

#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "world/World.h"

/// The solver of a world made with ep::Solver::Direct or Iterative.
inline btElasticPlasticConstraintSolver& solverOf(ep::World& world)
{
	return static_cast<btElasticPlasticConstraintSolver&>(*world.bullet().getConstraintSolver());
}

/// The direct form in steps that are all as long as the world's: what is studied over the step, or by what one solution takes.
inline ep::Method withoutInnerSteps() { return ep::Method(ep::Solver::Direct).alsoWithout(ep::parts::InnerSteps); }

inline const btElasticPlasticStatistics& statisticsOf(ep::World& world) { return solverOf(world).getStatistics(); }

#endif  // EP_TEST_DIRECT_SOLVER_H
