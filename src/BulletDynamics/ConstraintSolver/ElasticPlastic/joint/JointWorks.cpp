// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "JointWorks.h"

#include <stdio.h>

#include "../../btElasticPlasticEvent.h"
#include "../../btElasticPlasticJoint.h"
#include "BulletDynamics/ConstraintSolver/btSolverBody.h"
#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "Diagonal.h"
#include "JoinedVelocity.h"
#include "JointRegistry.h"
#include "LoadWatch.h"
#include "SupportWay.h"

namespace btElasticPlastic
{
// ---- recognising each other without run-time type information

namespace
{
/// Passed by from() in place of a solver body. Its m_originalBody points to a mark that no other caller can have.
struct Question : btSolverBody
{
	JointWorks* m_answer = nullptr;
};

const char SIGN = 0;
btRigidBody* signOfQuestion() { return reinterpret_cast<btRigidBody*>(const_cast<char*>(&SIGN)); }
}  // namespace

const JointWorks& JointWorks::of(const btElasticPlasticJoint& joint) { return *joint.m_works; }

JointWorks* JointWorks::from(btTypedConstraint* constraint)
{
	const btTypedConstraintType type = constraint->getConstraintType();
	if (type != D6_SPRING_CONSTRAINT_TYPE && type != D6_SPRING_2_CONSTRAINT_TYPE)
		return nullptr;
	// solveConstraintObsolete() is empty in both of Bullet's classes; only btElasticPlasticConstraint overrides it, and
	// answers.
	Question question;
	question.m_originalBody = signOfQuestion();
	constraint->solveConstraintObsolete(question, question, 0);
	return question.m_answer;
}

void JointWorks::answer(btSolverBody& asked)
{
	if (asked.m_originalBody == signOfQuestion())
		static_cast<Question&>(asked).m_answer = this;
}

// ---- faults

void JointWorks::setFault(const btElasticPlasticFault& fault)
{
	m_model.m_fault = fault;
	m_isFaultTold = !fault;
}

void JointWorks::releaseBase()
{
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		if (m_model.isElasticPlastic(i))
			m_joint.releaseBase(i);
}

void JointWorks::tellFault(JointRegistry* registry)
{
	m_isFaultTold = true;
	tell(m_model.m_fault, registry);
}

void JointWorks::printFault(const btElasticPlasticFault& fault, char* text, int capacity) const
{
	char what[192];
	fault.print(what, sizeof what);
	const int idOfBullet = m_model.m_constraint.getUserConstraintId();
	char name[48] = "", id[24] = "";
	if (m_joint.getName()[0] != 0)
		snprintf(name, sizeof name, " '%s'", m_joint.getName());
	if (idOfBullet != -1)
		snprintf(id, sizeof id, " (id %d)", idOfBullet);
	const btVector3 p = m_joint.getPosition();
	snprintf(text, size_t(capacity > 0 ? capacity : 0), "joint%s%s at (%g, %g, %g): %s", name, id, double(p.x()),
			 double(p.y()), double(p.z()), what);
}

void JointWorks::tell(const btElasticPlasticFault& fault, JointRegistry* registry)
{
	char text[320];
	printFault(fault, text, sizeof text);
	if (registry)
		registry->refuse(m_joint, text);
	else
		btElasticPlasticListener().onRefused(m_joint, text);
}

void JointWorks::setOutOfIslands(bool isOut)
{
	if (isOut != m_isOutOfIslands)
		m_model.m_constraint.setEnabled(!isOut);
	m_isOutOfIslands = isOut;
}

void JointWorks::tellFaultOnce()
{
	if (!m_isFaultTold)
		tellFault(m_entry.m_registry);
}

bool JointWorks::setState(const btElasticPlasticState& state)
{
	JointRegistry* const registry = m_entry.m_registry;
	// Inner steps may have broken it in a step that has not ended: its registry does not know yet.
	const bool wasBroken = registry ? registry->isBroken(*this) : m_model.m_state.m_broken;
	btElasticPlasticFault fault = m_model.findStateFault(state);
	if (!fault && registry && wasBroken && !state.m_broken)
		fault = registry->putBack(*this, nullptr);
	if (fault)
	{
		tell(fault, registry);
		return false;
	}
	if (registry && !wasBroken && state.m_broken)
		registry->moveToBroken(*this);
	m_model.m_state = state;
	leaveStep();
	rouse();
	return true;
}

bool JointWorks::needsRegistry() const
{
	return m_model.m_dofs && holds() && (!m_entry.m_registry || m_numUncommitted > 2 || m_numLeft > 2);
}

/// Refuses a joint that nobody commits: it would be a spring that never yields.
void JointWorks::refuseWithoutRegistry()
{
	setFault(m_entry.m_registry ? btElasticPlasticFault("number of commits in the last three substeps", 0,
														"3: call btDynamicsWorld::addAction")
								: btElasticPlasticFault("number of actions that know the joint", 0,
														"1: call btElasticPlasticAction::addJoint"));
}

// ---- the step

void JointWorks::buildJacobian()
{
	// Bullet's own solvers report impulses only in a joint feedback.
	if (m_nextRequest == WHOLE_ROWS)
		m_feedback.attach(m_model.m_constraint);
	m_separation.holdOverlap(m_model.m_constraint);
}

int JointWorks::prepare()
{
	rouse();
	m_numUncommitted = m_step.getNumRows() > 0 ? m_numUncommitted + 1 : 0;
	m_hasBeenInWorld = true;
	m_request = m_nextRequest;
	m_nextRequest = WHOLE_ROWS;
	m_step.revert();
	if (needsRegistry())
		refuseWithoutRegistry();
	tellFaultOnce();
	m_isLeftOut = m_model.m_fault || !passesGate();
	const int rows = m_isLeftOut ? 0 : m_step.prepare(m_request != WHOLE_ROWS);
	return m_request == NO_ROWS ? 0 : rows;
}

/// Whether the joint may take part in the present step. If not, the listener is told, once for as long as the fault lasts.
bool JointWorks::passesGate()
{
	setStepFault(m_model.findStepFault());
	return !m_stepFault;
}

void JointWorks::setStepFault(const btElasticPlasticFault& fault)
{
	if (fault && !m_stepFault)
		tell(fault, m_entry.m_registry);
	m_stepFault = fault;
}

void JointWorks::tellForgotten()
{
	setStepFault(
		btElasticPlasticFault("number of worlds that the joint is in", 0, "1: call btDynamicsWorld::addConstraint"));
}

void JointWorks::tellMissingBody()
{
	if (const btElasticPlasticFault fault = m_model.findMissingWorld())
		setStepFault(fault);
}

bool JointWorks::hasBaseRows() const
{
	return !m_isLeftOut && !m_model.m_state.m_broken && !m_model.isElasticPlasticThroughout() && m_joint.isBaseActive();
}

void JointWorks::request(Request request)
{
	m_nextRequest = request;
	m_feedback.detach(m_model.m_constraint);
}

void JointWorks::requestJacobians() { request(JACOBIANS); }

void JointWorks::resume(int numUncommitted, int nextRequest)
{
	leaveStep();
	m_numUncommitted = numUncommitted;
	request(Request(nextRequest));
	leaveFactor();
}

bool JointWorks::beginAlone()
{
	request(NO_ROWS);
	if (m_separation.isUnderWay() || (!m_model.isElasticPlasticThroughout() && m_joint.isBaseActive()))
		return false;
	m_model.m_constraint.internalSetAppliedImpulse(0);
	if (btJointFeedback* feedback = m_model.m_constraint.getJointFeedback())
		StockFeedback::clear(*feedback);
	prepare();
	return true;
}

namespace
{
void copy(btScalar* to, const btVector3& from)
{
	for (int i = 0; i < 3; ++i)
		to[i] = from[i];
}

/// What Bullet's solver adds to J v for the velocity of a body that stands, see JoinedVelocity.h.
btScalar velocityOfStanding(const btRigidBody& body, const btScalar* linearAxis, const btScalar* angularAxis)
{
	if (!isStanding(body))
		return 0;
	const btVector3 &v = body.getLinearVelocity(), &w = body.getAngularVelocity();
	btScalar sum = 0;
	for (int i = 0; i < 3; ++i)
		sum += linearAxis[i] * v[i] + angularAxis[i] * w[i];
	return sum;
}
}  // namespace

void JointWorks::writeRows(btTypedConstraint::btConstraintInfo2* info, int firstRow)
{
	if (m_request == NO_ROWS)
		return;
	// Local copies, which the compiler need not read again after every write to the rows.
	const int rows = m_step.getNumRows(), skip = info->rowskip;
	// Without an action no substep ends.
	if (!m_entry.m_registry)
		m_step.forgetLead();
	if (!m_step.evaluate(1 / info->fps))
	{
		// Bullet has filled the rows with zeros; with bounds of zero they do nothing.
		for (int s = firstRow * skip, r = 0; r < rows; ++r, s += skip)
			info->m_lowerLimit[s] = info->m_upperLimit[s] = 0;
		return;
	}
	if (m_entry.m_registry)
		m_entry.m_registry->expectUnsure();
	const Kinematics& k = m_step.getKinematics();
	const Diagonal diagonal(m_model.bodyA(), m_model.bodyB());
	const bool isWhole = m_request == WHOLE_ROWS;
	int s = firstRow * skip;
	for (int r = 0; r < rows; ++r, s += skip)
	{
		const int dof = m_step.getDof(r);
		const btVector3& axis = k.m_axis[dof < 3 ? dof : dof - 3];
		btScalar a = 0;
		if (dof < 3)
		{
			const btVector3 momentA = k.armA(dof).cross(axis), momentB = axis.cross(k.armB(dof));
			copy(info->m_J1linearAxis + s, axis);
			copy(info->m_J2linearAxis + s, -axis);
			copy(info->m_J1angularAxis + s, momentA);
			copy(info->m_J2angularAxis + s, momentB);
			if (isWhole)
				a = diagonal.along(momentA, momentB);
		}
		else
		{
			copy(info->m_J1angularAxis + s, axis);
			copy(info->m_J2angularAxis + s, -axis);
			if (isWhole)
				a = diagonal.about(axis);
		}
		info->m_constraintError[s] =
			velocityOfStanding(m_model.bodyA(), info->m_J1linearAxis + s, info->m_J1angularAxis + s) +
			velocityOfStanding(m_model.bodyB(), info->m_J2linearAxis + s, info->m_J2angularAxis + s);
		if (!isWhole)
			continue;
		const SoftRow soft = m_step.makeRow(r, a, info->erp, true);
		info->m_constraintError[s] += soft.m_velocity;
		info->cfm[s] = soft.m_compliance / a;
		info->m_lowerLimit[s] = soft.m_lower;
		info->m_upperLimit[s] = soft.m_upper;
	}
	if (firstRow > 0 && isWhole)
		m_feedback.separateRows(*info, firstRow, rows);
	else
		m_feedback.setNoBaseRows();
}

void JointWorks::finishAlone(const double* impulses, const signed char* bounds)
{
	btTypedConstraint& constraint = m_model.m_constraint;
	btScalar largest = 0;
	m_step.setSolution(impulses, bounds);
	for (int r = 0; r < m_step.getNumRows(); ++r)
	{
		const btScalar impulse = m_step.getImpulse(r);
		btSetMax(largest, btFabs(impulse));
		constraint.internalSetAppliedImpulse(impulse);
	}
	if (btJointFeedback* feedback = constraint.getJointFeedback())
	{
		const btRigidBody &A = m_model.bodyA(), &B = m_model.bodyB();
		const Kinematics& k = m_step.getKinematics();
		btVector3 force, torque;
		m_step.getLoad(force, torque);
		feedback->m_appliedForceBodyA += force * A.getLinearFactor();
		feedback->m_appliedForceBodyB -= force * B.getLinearFactor();
		feedback->m_appliedTorqueBodyA += (torque + k.m_rA.cross(force)) * A.getAngularFactor();
		feedback->m_appliedTorqueBodyB -= (torque + k.m_rB.cross(force)) * B.getAngularFactor();
	}
	if (largest >= constraint.getBreakingImpulseThreshold())
		constraint.setEnabled(false);
}

void JointWorks::commitInside(double share)
{
	// The registry ends no step of a broken joint that stays in the world until its bodies have parted.
	if (m_separation.isUnderWay())
		return;
	m_isCommittedInside = true;
	m_outcome |= static_cast<unsigned char>(m_step.commit(share, m_isNew));
}

void JointWorks::rewind(const btElasticPlasticState& state)
{
	m_step.revert();
	m_step.forgetLosses();
	m_model.m_state = state;
	m_isCommittedInside = false;
	m_outcome = 0;
}

bool JointWorks::beginInside()
{
	const bool isAwaited = m_isCommittedInside;
	m_isCommittedInside = false;
	m_isNew = m_model.m_state.m_lastStep == 0;
	if (isAwaited && m_entry.m_registry)
		m_entry.m_registry->forgetTaken();
	return m_entry.m_registry && !isAwaited && m_step.getNumRows() == 0;
}

void JointWorks::takeFeedback()
{
	if (!m_isCommittedInside && m_step.getNumRows() > 0 && m_request == WHOLE_ROWS)
		m_feedback.decode(m_model.m_constraint, m_step);
}

void JointWorks::leaveUncommitted()
{
	leaveStep();
	++m_numLeft;
}

void JointWorks::leaveStep()
{
	m_step.forget();
	m_isCommittedInside = false;
	m_outcome = 0;
}

int JointWorks::commit()
{
	if (isInStep())
		m_numLeft = 0;
	const int inside = m_outcome;
	const bool isDone = m_isCommittedInside;
	m_outcome = 0;
	m_isCommittedInside = false;
	if (isDone)
		return inside;
	return inside | m_step.commit(1, m_model.m_state.m_lastStep == 0);
}

bool JointWorks::mayHaveSupport() const { return m_model.m_dofs != 0 && SupportWay::mayBe(m_model.m_state); }

bool JointWorks::isLoadChanging(btScalar share, btScalar step)
{
	const bool hasDeformed = wasInStep() && LoadWatch(m_model).hasDeformed(m_step.getKinematics().m_strain, share);
	SupportWay support(m_model);
	const bool hasMoved = support.follow(step, m_step.getLead());
	m_step.forgetLead();
	support.keepAwake(hasMoved);
	return hasMoved || hasDeformed;
}

btVector3 JointWorks::appliedImpulse() const
{
	// One that has had no step, or has been put back since, has no axes of it.
	Kinematics k = m_step.getKinematics();
	if (!wasInStep())
		m_model.measure(k);
	btVector3 force(0, 0, 0);
	for (int i = 0; i < 3; ++i)
		force += k.m_axis[i] * m_model.m_state.m_applied[i];
	return force * m_model.m_state.m_lastStep;
}

btVector3 JointWorks::relativeVelocity() const
{
	const btRigidBody &a = m_model.bodyA(), &b = m_model.bodyB();
	const btVector3 place = m_joint.getPosition();
	return velocityAt(b, place - b.getCenterOfMassPosition()) - velocityAt(a, place - a.getCenterOfMassPosition());
}

void JointWorks::updateDrawnFrames() { m_joint.updateDrawnFrames(); }

void JointWorks::rouse()
{
	if (m_entry.m_registry)
		m_entry.m_registry->rouse(*this, m_entry.m_index);
}

void JointWorks::wakeBodies()
{
	if (!m_entry.m_registry)
		return;
	m_entry.m_registry->wake(m_model.bodyA());
	m_entry.m_registry->wake(m_model.bodyB());
}
}  // namespace btElasticPlastic
