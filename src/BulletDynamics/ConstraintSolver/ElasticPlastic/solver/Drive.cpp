// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Drive.h"

#include "../joint/JointWorks.h"
#include "BulletDynamics/ConstraintSolver/btConeTwistConstraint.h"
#include "BulletDynamics/ConstraintSolver/btGeneric6DofConstraint.h"
#include "BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h"
#include "BulletDynamics/ConstraintSolver/btHingeConstraint.h"
#include "BulletDynamics/ConstraintSolver/btSliderConstraint.h"

namespace btElasticPlastic
{
namespace
{
/// Springs of btGeneric6DofSpringConstraint are motors.
bool drivesSixDofs(btGeneric6DofConstraint& constraint)
{
	for (int i = 0; i < 3; ++i)
		if (constraint.getTranslationalLimitMotor()->m_enableMotor[i] ||
			constraint.getRotationalLimitMotor(i)->m_enableMotor)
			return true;
	return false;
}

bool drivesSixDofs(btGeneric6DofSpring2Constraint& constraint)
{
	const btTranslationalLimitMotor2& linear = *constraint.getTranslationalLimitMotor();
	for (int i = 0; i < 3; ++i)
	{
		const btRotationalLimitMotor2& angular = *constraint.getRotationalLimitMotor(i);
		if (linear.m_enableMotor[i] || linear.m_enableSpring[i] || angular.m_enableMotor || angular.m_enableSpring)
			return true;
	}
	return false;
}
bool hasDrive(btTypedConstraint& constraint)
{
	switch (constraint.getConstraintType())
	{
		case HINGE_CONSTRAINT_TYPE:
			return static_cast<btHingeConstraint&>(constraint).getEnableAngularMotor();
		case CONETWIST_CONSTRAINT_TYPE:
			return static_cast<btConeTwistConstraint&>(constraint).isMotorEnabled();
		case SLIDER_CONSTRAINT_TYPE:
		{
			auto& slider = static_cast<btSliderConstraint&>(constraint);
			return slider.getPoweredLinMotor() || slider.getPoweredAngMotor();
		}
		case D6_CONSTRAINT_TYPE:
		case D6_SPRING_CONSTRAINT_TYPE:
			return drivesSixDofs(static_cast<btGeneric6DofConstraint&>(constraint));
		case D6_SPRING_2_CONSTRAINT_TYPE:
			return drivesSixDofs(static_cast<btGeneric6DofSpring2Constraint&>(constraint));
		default:
			return false;
	}
}
}  // namespace

bool isDrive(btTypedConstraint& constraint, const JointWorks* joint)
{
	return constraint.isEnabled() && (!joint || joint->hasBaseRows()) && hasDrive(constraint);
}
}  // namespace btElasticPlastic
