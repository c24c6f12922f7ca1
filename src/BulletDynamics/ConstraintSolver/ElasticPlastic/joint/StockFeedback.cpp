// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "StockFeedback.h"

#include "BulletDynamics/Dynamics/btRigidBody.h"
#include "JointStep.h"

namespace btElasticPlastic
{
namespace
{
/// A row's Jacobian on body A, or what is left of it.
struct Direction
{
	btVector3 m_linear, m_angular;

	btScalar dot(const Direction& d) const { return m_linear.dot(d.m_linear) + m_angular.dot(d.m_angular); }
	void subtract(const Direction& d, btScalar factor)
	{
		m_linear -= d.m_linear * factor;
		m_angular -= d.m_angular * factor;
	}
};
}  // namespace

void StockFeedback::clear(btJointFeedback& feedback)
{
	const btVector3 zero(0, 0, 0);
	feedback.m_appliedForceBodyA = feedback.m_appliedTorqueBodyA = zero;
	feedback.m_appliedForceBodyB = feedback.m_appliedTorqueBodyB = zero;
}

/// Row i's impulse is its component along the dual vector: what is left of J_i after taking away its parts along all other
/// rows, scaled so that its product with J_i is 1. Rows of Bullet's class may be parallel to each other (two limits), never to
/// the elastic-plastic ones: they are on other degrees of freedom.
void StockFeedback::separateRows(const btTypedConstraint::btConstraintInfo2& info, int baseRows, int numRows)
{
	const int count = baseRows + numRows;
	m_dual.resize(2 * numRows);
	for (int r = 0; r < numRows; ++r)
	{
		// What has no part of its own is not told from Bullet's rows, and has no impulse.
		const btVector3 zero(0, 0, 0);
		Direction orthonormal[BT_EP_DOF_COUNT], own = {zero, zero};
		int n = 0;
		for (int j = 0; j <= count; ++j)
		{
			// The row itself comes last.
			const int source = j == count ? baseRows + r : j;
			if (j == baseRows + r)
				continue;
			const btScalar *linear = info.m_J1linearAxis + source * info.rowskip,
						   *angular = info.m_J1angularAxis + source * info.rowskip;
			const Direction full = {btVector3(linear[0], linear[1], linear[2]),
									btVector3(angular[0], angular[1], angular[2])};
			Direction rest = full;
			for (int i = 0; i < n; ++i)
				rest.subtract(orthonormal[i], rest.dot(orthonormal[i]));
			const btScalar left = rest.dot(rest);
			if (left < btScalar(1e-8) * full.dot(full))
				continue;
			if (j == count)
				own = {rest.m_linear / left, rest.m_angular / left};
			else if (n < BT_EP_DOF_COUNT)
				orthonormal[n++] = {rest.m_linear / btSqrt(left), rest.m_angular / btSqrt(left)};
		}
		m_dual[2 * r] = own.m_linear;
		m_dual[2 * r + 1] = own.m_angular;
	}
}

/// A linear row's impulse is the force along its axis, an angular one's the torque about the common point along its axis.
void StockFeedback::decode(const btTypedConstraint& constraint, JointStep& step) const
{
	const btJointFeedback* feedback = const_cast<btTypedConstraint&>(constraint).getJointFeedback();
	if (!feedback)
		return;
	// Bullet multiplies the feedback by a body's linear and angular factors, which may lose a part of it. The body without
	// factors is read.
	const btRigidBody &A = constraint.getRigidBodyA(), &B = constraint.getRigidBodyB();
	const btVector3 one(1, 1, 1);
	const bool useB = (A.getLinearFactor() != one || A.getAngularFactor() != one) && B.getInvMass() > 0 &&
					  B.getLinearFactor() == one && B.getAngularFactor() == one;
	const btScalar dt = step.getTimeStep();
	const btVector3 &rA = step.getKinematics().m_rA, &rB = step.getKinematics().m_rB;
	const btVector3 force = (useB ? -feedback->m_appliedForceBodyB : feedback->m_appliedForceBodyA) * dt;
	btVector3 torque = (useB ? -feedback->m_appliedTorqueBodyB : feedback->m_appliedTorqueBodyA) * dt;
	if (useB)
		torque += (rA - rB).cross(force);
	btScalar impulse[BT_EP_DOF_COUNT];
	step.getKinematics().projectLoad(force, torque - rA.cross(force), impulse);
	for (int r = 0; r < step.getNumRows(); ++r)
		step.setImpulse(
			r, m_dual.size() > 0 ? m_dual[2 * r].dot(force) + m_dual[2 * r + 1].dot(torque) : impulse[step.getDof(r)]);
}
}  // namespace btElasticPlastic
