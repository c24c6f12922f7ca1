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
#include "SpringLimits.h"

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

// ---- each factor of error reduction that a constraint has of its own becomes change(its place, factor)

template <class Change>
void changeParameter(btTypedConstraint& constraint, int number, int axis, int place, const Change& change)
{
	constraint.setParam(number, change(place, constraint.getParam(number, axis)), axis);
}

template <class Change>
void changeFactors(btHingeConstraint& hinge, const Change& change)
{
	if (hinge.getFlags() & BT_HINGE_FLAGS_ERP_STOP)
		changeParameter(hinge, BT_CONSTRAINT_STOP_ERP, 5, 0, change);
	if (hinge.getFlags() & BT_HINGE_FLAGS_ERP_NORM)
		changeParameter(hinge, BT_CONSTRAINT_ERP, -1, 1, change);
}

template <class Change>
void changeFactors(btConeTwistConstraint& cone, const Change& change)
{
	if (cone.getFlags() & BT_CONETWIST_FLAGS_LIN_ERP)
		changeParameter(cone, BT_CONSTRAINT_ERP, 0, 0, change);
	// A swing that is as good as locked is held by the relaxation factor. That of any other multiplies its axis.
	const bool isLocked = btMax(cone.getSwingSpan1(), cone.getSwingSpan2()) < cone.getFixThresh();
	const btScalar relaxation = cone.getRelaxationFactor();
	cone.setLimit(cone.getSwingSpan1(), cone.getSwingSpan2(), cone.getTwistSpan(), cone.getLimitSoftness(),
				  change(1, cone.getBiasFactor()), isLocked ? change(2, relaxation) : relaxation);
}

template <class Change>
void changeFactors(btSliderConstraint& slider, const Change& change)
{
	const int flags = slider.getFlags();
	if (flags & BT_SLIDER_FLAGS_ERP_DIRLIN)
		slider.setSoftnessDirLin(change(0, slider.getSoftnessDirLin()));
	if (flags & BT_SLIDER_FLAGS_ERP_DIRANG)
		slider.setSoftnessDirAng(change(1, slider.getSoftnessDirAng()));
	if (flags & BT_SLIDER_FLAGS_ERP_ORTLIN)
		slider.setSoftnessOrthoLin(change(2, slider.getSoftnessOrthoLin()));
	if (flags & BT_SLIDER_FLAGS_ERP_ORTANG)
		slider.setSoftnessOrthoAng(change(3, slider.getSoftnessOrthoAng()));
	if (flags & BT_SLIDER_FLAGS_ERP_LIMLIN)
		slider.setSoftnessLimLin(change(4, slider.getSoftnessLimLin()));
	if (flags & BT_SLIDER_FLAGS_ERP_LIMANG)
		slider.setSoftnessLimAng(change(5, slider.getSoftnessLimAng()));
}

template <class SixDofs, class Change>
void changeFactorsOfSixDofs(SixDofs& constraint, const Change& change)
{
	for (int i = 0; i < 3; ++i)
	{
		btScalar& linear = constraint.getTranslationalLimitMotor()->m_stopERP[i];
		btScalar& angular = constraint.getRotationalLimitMotor(i)->m_stopERP;
		linear = change(i, linear);
		angular = change(3 + i, angular);
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
				changeParameter(constraint, BT_CONSTRAINT_ERP, -1, 0, change);
			return;
		default:
			return;
	}
}

/// Each enabled spring's stiffness and damping become change(its degree of freedom, stiffness, damping).
template <class Change>
void changeSprings(btTypedConstraint& constraint, const Change& change)
{
	if (constraint.getConstraintType() != D6_SPRING_2_CONSTRAINT_TYPE)
		return;
	auto& sixDofs = static_cast<btGeneric6DofSpring2Constraint&>(constraint);
	btTranslationalLimitMotor2& linear = *sixDofs.getTranslationalLimitMotor();
	for (int dof = 0; dof < 6; ++dof)
	{
		btRotationalLimitMotor2* const angular = dof < 3 ? nullptr : sixDofs.getRotationalLimitMotor(dof - 3);
		if (angular ? angular->m_enableSpring : linear.m_enableSpring[dof])
			change(dof, angular ? angular->m_springStiffness : linear.m_springStiffness[dof],
				   angular ? angular->m_springDamping : linear.m_springDamping[dof]);
	}
}
}  // namespace

void StepParameters::scale(const SolverGroup& island, btScalar share, btScalar dt)
{
	m_held.resize(0);
	for (int i = 0; i < island.m_numConstraints; ++i)
		scale(*island.m_constraints[i], !island.m_joints[i] || island.m_joints[i]->hasBaseRows(), share, dt);
}

void StepParameters::scale(btTypedConstraint& constraint, bool hasRows, btScalar share, btScalar dt)
{
	Held held;
	held.m_constraint = &constraint;
	held.m_type = constraint.getConstraintType();
	const btScalar threshold = constraint.getBreakingImpulseThreshold(), impulse = impulseOf(constraint);
	held.m_threshold = {threshold, threshold < SIMD_INFINITY ? threshold * share : threshold};
	held.m_impulse = {impulse, impulse > 0 ? impulse * share : impulse};
	if (!hasRows && !held.m_threshold.isScaled() && !held.m_impulse.isScaled())
		return;
	if (held.m_threshold.isScaled())
		constraint.setBreakingImpulseThreshold(held.m_threshold.m_scaled);
	if (held.m_impulse.isScaled())
		setImpulse(constraint, held.m_impulse.m_scaled);
	if (hasRows)
	{
		changeFactors(constraint,
					  [&](int place, btScalar factor)
					  {
						  held.m_factors |= 1u << place;
						  held.m_factor[place] = {factor, factor * share * share};
						  return held.m_factor[place].m_scaled;
					  });
		changeSprings(constraint,
					  [&](int dof, btScalar& stiffness, btScalar& damping)
					  {
						  const SpringLimits limits(static_cast<btGeneric6DofSpring2Constraint&>(constraint), dof, dt);
						  held.m_springs |= 1u << dof;
						  held.m_stiffness[dof] = {stiffness, limits.limitStiffness(stiffness)};
						  held.m_damping[dof] = {damping, limits.limitDamping(damping)};
						  stiffness = held.m_stiffness[dof].m_scaled;
						  damping = held.m_damping[dof].m_scaled;
					  });
	}
	m_held.push_back(held);
}

void StepParameters::restore()
{
	for (int i = 0; i < m_held.size(); ++i)
		giveBack(m_held[i], false);
	m_held.resize(0);
}

void StepParameters::giveBack(const Held& held, bool mayBeChanged)
{
	btTypedConstraint& constraint = *held.m_constraint;
	if (constraint.getConstraintType() != held.m_type)
		return;
	if (held.m_threshold.isScaled())
		constraint.setBreakingImpulseThreshold(
			held.m_threshold.restored(constraint.getBreakingImpulseThreshold(), mayBeChanged));
	if (held.m_impulse.isScaled())
		setImpulse(constraint, held.m_impulse.restored(impulseOf(constraint), mayBeChanged));
	if (held.m_factors)
		changeFactors(
			constraint, [&](int place, btScalar factor)
			{ return held.m_factors >> place & 1u ? held.m_factor[place].restored(factor, mayBeChanged) : factor; });
	if (held.m_springs)
		changeSprings(constraint,
					  [&](int dof, btScalar& stiffness, btScalar& damping)
					  {
						  if (!(held.m_springs >> dof & 1u))
							  return;
						  stiffness = held.m_stiffness[dof].restored(stiffness, mayBeChanged);
						  damping = held.m_damping[dof].restored(damping, mayBeChanged);
					  });
}
}  // namespace btElasticPlastic
