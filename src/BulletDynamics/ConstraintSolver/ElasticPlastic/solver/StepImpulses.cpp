// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "StepImpulses.h"

#include "BulletDynamics/ConstraintSolver/btConeTwistConstraint.h"
#include "BulletDynamics/ConstraintSolver/btHingeConstraint.h"
#include "BulletDynamics/ConstraintSolver/btPoint2PointConstraint.h"

namespace btElasticPlastic
{
namespace
{
/// The impulse by which a constraint is bounded in a step, -1: none.
btScalar impulseOf(btTypedConstraint& constraint)
{
	switch (constraint.getConstraintType())
	{
		case HINGE_CONSTRAINT_TYPE:
			return static_cast<btHingeConstraint&>(constraint).getMaxMotorImpulse();
		case CONETWIST_CONSTRAINT_TYPE:
			return static_cast<btConeTwistConstraint&>(constraint).getMaxMotorImpulse();
		case POINT2POINT_CONSTRAINT_TYPE:
			return static_cast<btPoint2PointConstraint&>(constraint).m_setting.m_impulseClamp;
		default:
			return -1;
	}
}

void setImpulse(btTypedConstraint& constraint, btScalar impulse)
{
	switch (constraint.getConstraintType())
	{
		case HINGE_CONSTRAINT_TYPE:
			static_cast<btHingeConstraint&>(constraint).setMaxMotorImpulse(impulse);
			break;
		case CONETWIST_CONSTRAINT_TYPE:
		{
			btConeTwistConstraint& cone = static_cast<btConeTwistConstraint&>(constraint);
			cone.isMaxMotorImpulseNormalized() ? cone.setMaxMotorImpulseNormalized(impulse)
											   : cone.setMaxMotorImpulse(impulse);
			break;
		}
		case POINT2POINT_CONSTRAINT_TYPE:
			static_cast<btPoint2PointConstraint&>(constraint).m_setting.m_impulseClamp = impulse;
			break;
		default:
			break;
	}
}
}  // namespace

void StepImpulses::scale(const SolverGroup& island, btScalar share)
{
	m_bounds.resize(0);
	for (int i = 0; i < island.m_numConstraints; ++i)
	{
		btTypedConstraint& constraint = *island.m_constraints[i];
		const Bound bound = {&constraint, constraint.getBreakingImpulseThreshold(), impulseOf(constraint)};
		if (bound.m_threshold >= SIMD_INFINITY && !(bound.m_impulse > 0))
			continue;
		m_bounds.push_back(bound);
		if (bound.m_threshold < SIMD_INFINITY)
			constraint.setBreakingImpulseThreshold(bound.m_threshold * share);
		if (bound.m_impulse > 0)
			setImpulse(constraint, bound.m_impulse * share);
	}
}

void StepImpulses::restore()
{
	for (int i = 0; i < m_bounds.size(); ++i)
	{
		m_bounds[i].m_constraint->setBreakingImpulseThreshold(m_bounds[i].m_threshold);
		setImpulse(*m_bounds[i].m_constraint, m_bounds[i].m_impulse);
	}
	m_bounds.resize(0);
}
}  // namespace btElasticPlastic
