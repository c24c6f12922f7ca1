// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The second half of a step of btElasticPlasticJoint: from impulses to the next state.

#include "BulletDynamics/ConstraintSolver/btElasticPlasticJoint.h"

#include "BulletDynamics/Dynamics/btRigidBody.h"

/// A linear row's impulse is the force along its axis, an angular one's the torque about the common point along its axis.
void btElasticPlasticJoint::readFeedback()
{
	const btJointFeedback* feedback = m_constraint.getJointFeedback();
	if (!feedback)
		return;
	// Bullet multiplies by the bodies' factors, what they take away is lost: take the body that is freer.
	const btRigidBody &A = m_constraint.getRigidBodyA(), &B = m_constraint.getRigidBodyB();
	const btVector3 one(1, 1, 1);
	const bool useB = (A.getLinearFactor() != one || A.getAngularFactor() != one) && B.getInvMass() > 0 &&
					  B.getLinearFactor() == one && B.getAngularFactor() == one;
	const btVector3 force = (useB ? -feedback->m_appliedForceBodyB : feedback->m_appliedForceBodyA) * m_step.m_dt;
	btVector3 torque = (useB ? -feedback->m_appliedTorqueBodyB : feedback->m_appliedTorqueBodyA) * m_step.m_dt;
	if (useB)
		torque += (m_step.m_kinematics.m_rA - m_step.m_kinematics.m_rB).cross(force);
	btScalar impulse[BT_EP_DOF_COUNT];
	project(force, torque - m_step.m_kinematics.m_rA.cross(force), impulse);
	for (int r = 0; r < m_step.m_rows; ++r)
	{
		Row& row = m_step.m_row[r];
		row.m_impulse =
			m_dual.size() > 0 ? m_dual[2 * r].dot(force) + m_dual[2 * r + 1].dot(torque) : impulse[row.m_dof];
	}
}

void btElasticPlasticJoint::reportImpulses()
{
	const btElasticPlastic::Kinematics& k = m_step.m_kinematics;
	btVector3 sum[2] = {btVector3(0, 0, 0), btVector3(0, 0, 0)};
	btScalar largest = 0;
	for (int r = 0; r < m_step.m_rows; ++r)
	{
		const Row& row = m_step.m_row[r];
		sum[row.m_dof / 3] += k.m_axis[row.m_dof % 3] * row.m_impulse;
		btSetMax(largest, btFabs(row.m_impulse));
		m_constraint.internalSetAppliedImpulse(row.m_impulse);
	}
	if (btJointFeedback* feedback = m_constraint.getJointFeedback())
	{
		const btRigidBody &A = m_constraint.getRigidBodyA(), &B = m_constraint.getRigidBodyB();
		const btVector3 force = sum[0] / m_step.m_dt, torque = sum[1] / m_step.m_dt;
		feedback->m_appliedForceBodyA += force * A.getLinearFactor();
		feedback->m_appliedForceBodyB -= force * B.getLinearFactor();
		feedback->m_appliedTorqueBodyA += (torque + k.m_rA.cross(force)) * A.getAngularFactor();
		feedback->m_appliedTorqueBodyB -= (torque + k.m_rB.cross(force)) * B.getAngularFactor();
	}
	if (largest >= m_constraint.getBreakingImpulseThreshold())
		m_constraint.setEnabled(false);
}

btElasticPlastic::ReturnMapping btElasticPlasticJoint::returnMap(const Row& row, btScalar velocity1) const
{
	const btScalar k = m_capacity.m_stiffness[row.m_dof], yield = m_capacity.m_yield[row.m_dof];
	const btScalar strain = m_step.m_kinematics.m_strain[row.m_dof];
	const btScalar yieldImpulse = yield * m_step.m_dt;
	// The step's own axes: strain read from the turned configuration would count the turning as strain.
	const btScalar trial = strain - m_step.m_dt * velocity1;
	if (m_capacity.isRigidPlastic(row.m_dof))
		return btElasticPlastic::rigidReturnMap(
			row.m_impulse, trial, btElasticPlastic::isAtBound(row.m_impulse, row.m_lower, row.m_upper, trial, yieldImpulse),
			m_step.m_dt);
	if (m_scheme == BT_EP_SCHEME_PAPER)
		// The paper looks at the deformation at the start of the step.
		return btElasticPlastic::returnMap(
			k, yield, strain, btFabs(row.m_impulse) > btScalar(0.99999) * yieldImpulse && row.m_impulse * strain > 0);
	const bool beyond = btFabs(k * trial) > yield;
	return btElasticPlastic::returnMap(
		k, yield, trial,
		beyond && btElasticPlastic::isAtBound(row.m_impulse, row.m_lower, row.m_upper, trial, yieldImpulse));
}

int btElasticPlasticJoint::commit()
{
	m_step.m_committedRows = m_step.m_rows;
	if (m_step.m_rows == 0)
		return NOTHING;
	if (m_step.m_request == WHOLE_ROWS)
		readFeedback();

	const btElasticPlastic::Kinematics& k = m_step.m_kinematics;
	const btRigidBody &A = m_constraint.getRigidBodyA(), &B = m_constraint.getRigidBodyB();
	// The velocities with which the bodies were moved: other actions may have changed the present ones already.
	const btVector3 &wA = A.getInterpolationAngularVelocity(), &wB = B.getInterpolationAngularVelocity();
	const btVector3 linear =
		A.getInterpolationLinearVelocity() + wA.cross(k.m_rA) - B.getInterpolationLinearVelocity() - wB.cross(k.m_rB);
	btScalar velocity1[BT_EP_DOF_COUNT], increment[BT_EP_DOF_COUNT] = {};
	project(linear, wA - wB, velocity1);

	const btScalar rate = 1 / m_step.m_dt;
	m_state.m_lastStep = m_step.m_dt;
	double work = 0;
	bool flowed = false;
	for (int r = 0, rows = m_step.m_rows; r < rows; ++r)
	{
		Row& row = m_step.m_row[r];
		const int i = row.m_dof;
		row.m_velocity1 = velocity1[i];
		const btElasticPlastic::ReturnMapping mapped = returnMap(row, velocity1[i]);
		m_state.m_forceRate[i] = (mapped.m_force - m_state.m_force[i]) * rate;
		m_state.m_force[i] = mapped.m_force;
		m_state.m_applied[i] = row.m_impulse * rate;
		// The work of an impulse on the bodies is exactly impulse times mean velocity.
		work += double(row.m_impulse) * (double(row.m_velocity0) + double(velocity1[i]));
		if (mapped.m_increment == 0)
			continue;
		increment[i] = mapped.m_increment;
		m_state.m_plastic[i] += mapped.m_increment;
		m_state.m_plasticPath[i] += btFabs(mapped.m_increment);
		m_state.m_plasticEnergy += double(m_capacity.m_yield[i]) * btFabs(double(mapped.m_increment));
		flowed = true;
	}
	m_state.m_work -= 0.5 * work;
	revert();
	if (!flowed)
		return NOTHING;
	if (increment[3] != 0 || increment[4] != 0 || increment[5] != 0)
		turnReference(increment);
	const int outcome = m_state.m_yielded ? NOTHING : YIELDED;
	m_state.m_yielded = true;
	m_state.m_broken = getDamage() >= 1;
	return m_state.m_broken ? outcome | BROKE : outcome;
}

/// Turns the plastic rotation so that the elastic rotation that is measured at the new pose loses the increment.
void btElasticPlasticJoint::turnReference(const btScalar increment[6])
{
	btElasticPlastic::Kinematics now;
	measure(now);
	const btElasticPlastic::RelativeRotation turn = this->turn();
	const btVector3 elastic(now.m_strain[3] - increment[3], now.m_strain[4] - increment[4],
							now.m_strain[5] - increment[5]);
	m_state.m_plasticRotation =
		(btElasticPlastic::exponential(-quatRotate(turn.m_middle, elastic)) * turn.m_relative).normalized();
	m_state.m_plasticMiddle = (turn.m_middle * btElasticPlastic::exponential(elastic * btScalar(-0.5))).normalized();
}
