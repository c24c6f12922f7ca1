// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Names all that a program begins with. Without BT_USE_DOUBLE_PRECISION it must not link with the library in double.
#include "BulletDynamics/ConstraintSolver/btElasticPlasticAction.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticConstraintSolver.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticStepper.h"

bool begin(btDynamicsWorld& world, btTypedConstraint& constraint)
{
	const btElasticPlasticMaterial material = btElasticPlasticMaterial::steel();
	const btElasticPlasticSection section = btElasticPlasticSection::rectangle(1, 1);
	const btElasticPlasticCapacity capacity;
	btElasticPlasticAction action;
	btElasticPlasticConstraintSolver solver;
	btElasticPlasticStepControl control(0.01);
	btElasticPlasticStepper stepper(world, action, &solver, 0.01, 1);
	return btElasticPlasticJoint::from(&constraint) && material.m_density > section.m_area;
}

int main() { return 0; }
