// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_COMMON_H
#define BT_ELASTIC_PLASTIC_COMMON_H

/// All of the interface but for multibody worlds, as btBulletDynamicsCommon.h is all that a game of rigid bodies needs of Bullet.

#include "BulletDynamics/ConstraintSolver/btElasticPlastic6DofSpring2Constraint.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlastic6DofSpringConstraint.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticAction.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticBonding.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticBulletFile.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticConversion.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticEnergyAudit.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticMaterials.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticSnapshot.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticStepper.h"

#endif  // BT_ELASTIC_PLASTIC_COMMON_H
