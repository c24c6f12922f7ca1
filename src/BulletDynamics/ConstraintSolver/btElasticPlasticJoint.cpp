// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticJoint.h"

#include "BulletDynamics/ConstraintSolver/btSolverBody.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"
#include "btElasticPlasticAction.h"
#include "ElasticPlastic/joint/Separation.h"

#include <stdio.h>

btElasticPlasticJoint::btElasticPlasticJoint(btTypedConstraint& constraint, const btTransform& frameInA,
											 const btTransform& frameInB)
	: m_constraint(constraint), m_frameInA(frameInA), m_frameInB(frameInB)
{
	ensureFeedback();
}

btElasticPlasticJoint::~btElasticPlasticJoint()
{
	if (m_action)
		m_action->removeJoint(this);
}

void btElasticPlasticJoint::clear(btJointFeedback& feedback)
{
	const btVector3 zero(0, 0, 0);
	feedback.m_appliedForceBodyA = feedback.m_appliedTorqueBodyA = zero;
	feedback.m_appliedForceBodyB = feedback.m_appliedTorqueBodyB = zero;
}

void btElasticPlasticJoint::setOwnFeedback()
{
	clear(m_feedback);
	m_constraint.setJointFeedback(&m_feedback);
}

// ---- settings

bool btElasticPlasticJoint::setCapacity(const btElasticPlasticCapacity& capacity)
{
	m_capacity = capacity;
	m_fault = findFault();
	if (m_fault)
		return false;
	const unsigned before = m_dofs;
	m_dofs = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (m_capacity.isElasticPlastic(i))
		{
			m_dofs |= 1u << i;
			releaseBase(i);
		}
		else
			m_state.m_force[i] = m_state.m_applied[i] = m_state.m_forceRate[i] = 0;
	if (!isBaseActive())
		m_constraint.setDbgDrawSize(0);
	if (!m_hasReference)
		takeRoundingAsReference();
	else if (m_dofs & ~before)
		takePoseAsReference(m_dofs & ~before);
	m_hasReference = true;
	return true;
}

/// Degrees of freedom that were free for a while and hold again do so where they stand.
void btElasticPlasticJoint::takePoseAsReference(unsigned dofs)
{
	btElasticPlastic::Kinematics now;
	measure(now);
	btScalar away[BT_EP_DOF_COUNT] = {};
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (dofs >> i & 1u)
			away[i] = now.m_strain[i];
	for (int i = 0; i < 3; ++i)
		m_state.m_initial[i] += away[i];
	if (dofs >> 3)
		turnReference(away);
}

/// Frames that meet up to the rounding of their coordinates are meant to meet: in float half a micrometre on a metre would
/// be a force in a stiff joint. A larger misfit is the user's, and loads the joint.
void btElasticPlasticJoint::takeRoundingAsReference()
{
	const btTransform &A = m_constraint.getRigidBodyA().getCenterOfMassTransform(),
					  &B = m_constraint.getRigidBodyB().getCenterOfMassTransform();
	const btScalar size = A.getOrigin().length() + m_frameInA.getOrigin().length() + B.getOrigin().length() +
						  m_frameInB.getOrigin().length();
	btElasticPlastic::Kinematics now;
	measure(now);
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		// Eight roundings lie between the world's coordinates and a strain.
		if (btFabs(now.m_strain[i]) > 4 * SIMD_EPSILON * (i < 3 ? size : 1))
			return;
	setReferenceToCurrentPose();
}

btElasticPlasticFault btElasticPlasticJoint::findFault() const
{
	btElasticPlasticFault f = m_capacity.fault();
	if (f)
		return f;
	const btRigidBody* const bodies[2] = {&m_constraint.getRigidBodyA(), &m_constraint.getRigidBodyB()};
	if (bodies[0]->getInvMass() == 0 && bodies[1]->getInvMass() == 0)
	{
		f.m_quantity = "number of bodies with mass";
		f.m_range = "1 or 2: two static bodies cannot be joined";
		return f;
	}
	for (int i = 3; i < BT_EP_DOF_COUNT; ++i)
		for (int b = 0; b < 2 && m_capacity.isElasticPlastic(i); ++b)
		{
			const btVector3& inverse = bodies[b]->getInvInertiaDiagLocal();
			if (bodies[b]->getInvMass() == 0 || (inverse.x() > 0 && inverse.y() > 0 && inverse.z() > 0))
				continue;
			f.m_quantity = b == 0 ? "smallest inertia of body A [kg m^2]" : "smallest inertia of body B [kg m^2]";
			f.m_range = "greater than 0 for a body with mass: use btCollisionShape::calculateLocalInertia";
			f.m_dof = i;
			return f;
		}
	return f;
}

void btElasticPlasticJoint::setName(const char* name) { snprintf(m_name, sizeof m_name, "%s", name ? name : ""); }

void btElasticPlasticJoint::printFault(char* text, int capacity) const
{
	char what[192];
	m_fault.print(what, sizeof what);
	const btVector3 p = getPosition();
	snprintf(text, capacity > 0 ? capacity : 0, "joint '%s' (id %d) at (%g, %g, %g): %s", m_name,
			 m_constraint.getUserConstraintId(), double(p.x()), double(p.y()), double(p.z()), what);
}

btVector3 btElasticPlasticJoint::getPosition() const { return (getFrameA().getOrigin() + getFrameB().getOrigin()) / 2; }

void btElasticPlasticJoint::setReferenceToCurrentPose()
{
	btElasticPlastic::Kinematics now;
	measure(now);
	const btElasticPlastic::RelativeRotation turn = this->turn();
	for (int i = 0; i < 3; ++i)
		m_state.m_initial[i] += now.m_strain[i];
	m_state.m_plasticRotation = turn.m_relative;
	m_state.m_plasticMiddle = turn.m_middle;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		m_state.m_force[i] = m_state.m_applied[i] = m_state.m_forceRate[i] = 0;
	revert();
}

void btElasticPlasticJoint::setState(const btElasticPlasticState& state)
{
	const bool broken = m_state.m_broken;
	m_state = state;
	m_state.m_broken = broken;
}

void btElasticPlasticJoint::resetState()
{
	m_state = btElasticPlasticState();
	setReferenceToCurrentPose();
}

// ---- what it tells

btScalar btElasticPlasticJoint::getElasticDeformation(int dof) const
{
	return m_capacity.m_stiffness[dof] > 0 ? m_state.m_force[dof] / m_capacity.m_stiffness[dof] : btScalar(0);
}

btScalar btElasticPlasticJoint::getUtilisation(int dof) const
{
	return m_capacity.isElasticPlastic(dof) ? btFabs(m_state.m_applied[dof]) / m_capacity.m_yield[dof] : btScalar(0);
}

btScalar btElasticPlasticJoint::getUtilisation(int* limitingDof) const
{
	btScalar largest = 0;
	int limiting = -1;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (getUtilisation(i) > largest)
		{
			largest = getUtilisation(i);
			limiting = i;
		}
	if (limitingDof)
		*limitingDof = limiting;
	return largest;
}

btScalar btElasticPlasticJoint::getDamage() const
{
	btScalar damage = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		damage += getDamage(i);
	return damage;
}

double btElasticPlasticJoint::getElasticEnergy() const
{
	double energy = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		energy += 0.5 * double(m_state.m_force[i]) * double(getElasticDeformation(i));
	return energy;
}

void btElasticPlasticJoint::measureOverlap()
{
	m_overlap =
		btElasticPlastic::suspendRecovery(*m_partingWorld, m_constraint.getRigidBodyA(), m_constraint.getRigidBodyB());
}

// ---- recognising each other without run-time type information

namespace
{
/// Goes where a solver would pass a body.
struct Question : btSolverBody
{
	btElasticPlasticJoint* m_answer = nullptr;
};
const btScalar QUESTION = -1;  // no step is negative
}  // namespace

btElasticPlasticJoint* btElasticPlasticJoint::from(btTypedConstraint* constraint)
{
	const btTypedConstraintType type = constraint->getConstraintType();
	if (type != D6_SPRING_CONSTRAINT_TYPE && type != D6_SPRING_2_CONSTRAINT_TYPE)
		return nullptr;
	// Both of Bullet's classes inherit an empty solveConstraintObsolete: only ours answers.
	Question question;
	question.m_originalBody = nullptr;
	constraint->solveConstraintObsolete(question, question, QUESTION);
	return question.m_answer;
}

void btElasticPlasticJoint::answer(btSolverBody& asked, btScalar timeStep)
{
	if (timeStep == QUESTION)
		static_cast<Question&>(asked).m_answer = this;
}
