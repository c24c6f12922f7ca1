// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "StepParameters.h"

#include "../joint/JointWorks.h"
#include "BulletDynamics/ConstraintSolver/btConeTwistConstraint.h"
#include "BulletDynamics/ConstraintSolver/btGeneric6DofConstraint.h"
#include "BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h"
#include "BulletDynamics/ConstraintSolver/btHingeConstraint.h"
#include "BulletDynamics/ConstraintSolver/btPoint2PointConstraint.h"
#include "BulletDynamics/ConstraintSolver/btSliderConstraint.h"

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

// ---- each factor of error reduction that a constraint has of its own becomes change(factor)

template <class Change>
void changeParameter(btTypedConstraint& constraint, int number, int axis, const Change& change)
{
	constraint.setParam(number, change(constraint.getParam(number, axis)), axis);
}

template <class Change>
void changeFactors(btHingeConstraint& hinge, const Change& change)
{
	if (hinge.getFlags() & BT_HINGE_FLAGS_ERP_STOP)
		changeParameter(hinge, BT_CONSTRAINT_STOP_ERP, 5, change);
	if (hinge.getFlags() & BT_HINGE_FLAGS_ERP_NORM)
		changeParameter(hinge, BT_CONSTRAINT_ERP, -1, change);
}

template <class Change>
void changeFactors(btConeTwistConstraint& cone, const Change& change)
{
	if (cone.getFlags() & BT_CONETWIST_FLAGS_LIN_ERP)
		changeParameter(cone, BT_CONSTRAINT_ERP, 0, change);
	cone.setLimit(cone.getSwingSpan1(), cone.getSwingSpan2(), cone.getTwistSpan(), cone.getLimitSoftness(),
				  change(cone.getBiasFactor()), cone.getRelaxationFactor());
}

template <class Change>
void changeFactors(btSliderConstraint& slider, const Change& change)
{
	const int flags = slider.getFlags();
	if (flags & BT_SLIDER_FLAGS_ERP_DIRLIN)
		slider.setSoftnessDirLin(change(slider.getSoftnessDirLin()));
	if (flags & BT_SLIDER_FLAGS_ERP_DIRANG)
		slider.setSoftnessDirAng(change(slider.getSoftnessDirAng()));
	if (flags & BT_SLIDER_FLAGS_ERP_ORTLIN)
		slider.setSoftnessOrthoLin(change(slider.getSoftnessOrthoLin()));
	if (flags & BT_SLIDER_FLAGS_ERP_ORTANG)
		slider.setSoftnessOrthoAng(change(slider.getSoftnessOrthoAng()));
	if (flags & BT_SLIDER_FLAGS_ERP_LIMLIN)
		slider.setSoftnessLimLin(change(slider.getSoftnessLimLin()));
	if (flags & BT_SLIDER_FLAGS_ERP_LIMANG)
		slider.setSoftnessLimAng(change(slider.getSoftnessLimAng()));
}

template <class SixDofs, class Change>
void changeFactorsOfSixDofs(SixDofs& constraint, const Change& change)
{
	for (int i = 0; i < 3; ++i)
	{
		btScalar& linear = constraint.getTranslationalLimitMotor()->m_stopERP[i];
		btScalar& angular = constraint.getRotationalLimitMotor(i)->m_stopERP;
		linear = change(linear);
		angular = change(angular);
	}
}

template <class Change>
void changeFactors(btTypedConstraint& constraint, const Change& change)
{
	switch (constraint.getConstraintType())
	{
		case HINGE_CONSTRAINT_TYPE:
			return changeFactors(static_cast<btHingeConstraint&>(constraint), change);
		case CONETWIST_CONSTRAINT_TYPE:
			return changeFactors(static_cast<btConeTwistConstraint&>(constraint), change);
		case SLIDER_CONSTRAINT_TYPE:
			return changeFactors(static_cast<btSliderConstraint&>(constraint), change);
		case D6_CONSTRAINT_TYPE:
		case D6_SPRING_CONSTRAINT_TYPE:
			return changeFactorsOfSixDofs(static_cast<btGeneric6DofConstraint&>(constraint), change);
		case D6_SPRING_2_CONSTRAINT_TYPE:
			return changeFactorsOfSixDofs(static_cast<btGeneric6DofSpring2Constraint&>(constraint), change);
		case POINT2POINT_CONSTRAINT_TYPE:
			if (static_cast<btPoint2PointConstraint&>(constraint).getFlags() & BT_P2P_FLAGS_ERP)
				changeParameter(constraint, BT_CONSTRAINT_ERP, -1, change);
			return;
		default:
			return;
	}
}
}  // namespace

void StepParameters::scale(const SolverGroup& island, btScalar share)
{
	m_bounds.resize(0);
	m_withFactors.resize(0);
	m_factors.resize(0);
	for (int i = 0; i < island.m_numConstraints; ++i)
	{
		btTypedConstraint& constraint = *island.m_constraints[i];
		if (!island.m_joints[i] || island.m_joints[i]->hasBaseRows())
		{
			m_withFactors.push_back(&constraint);
			changeFactors(constraint,
						  [&](btScalar factor)
						  {
							  m_factors.push_back(factor);
							  return factor * share * share;
						  });
		}
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

void StepParameters::restore()
{
	for (int i = 0; i < m_bounds.size(); ++i)
	{
		m_bounds[i].m_constraint->setBreakingImpulseThreshold(m_bounds[i].m_threshold);
		setImpulse(*m_bounds[i].m_constraint, m_bounds[i].m_impulse);
	}
	m_bounds.resize(0);
	int next = 0;
	for (int i = 0; i < m_withFactors.size(); ++i)
		changeFactors(*m_withFactors[i], [&](btScalar) { return m_factors[next++]; });
	m_withFactors.resize(0);
}
}  // namespace btElasticPlastic
