// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The first half of a step of btElasticPlasticJoint: from the bodies' pose and velocities to rows.

#include "BulletDynamics/ConstraintSolver/btElasticPlasticJoint.h"

#include <stdio.h>

#include "BulletDynamics/Dynamics/btRigidBody.h"

/// Without its commits the joint would be a wrong spring that never yields.
void btElasticPlasticJoint::refuseWithoutBooks()
{
	m_fault.m_quantity =
		m_action ? "number of commits in the last three substeps" : "number of actions that know the joint";
	m_fault.m_range = m_action ? "3: call btDynamicsWorld::addAction" : "1: call btElasticPlasticAction::addJoint";
	char text[320];
	printFault(text, sizeof text);
	fprintf(stderr, "Bullet Elastic-Plastic refused %s\n", text);
}

/// At the bodies' present transforms.
void btElasticPlasticJoint::measure(btElasticPlastic::Kinematics& k) const
{
	k.evaluate(m_constraint.getRigidBodyA().getCenterOfMassTransform(),
			   m_constraint.getRigidBodyB().getCenterOfMassTransform(), m_frameInA, m_frameInB, m_state.offset(),
			   m_state.m_plasticRotation, m_state.m_plasticMiddle);
}

btElasticPlastic::RelativeRotation btElasticPlasticJoint::turn() const
{
	return btElasticPlastic::RelativeRotation(getFrameA().getBasis(), getFrameB().getBasis(), m_state.m_plasticRotation,
								m_state.m_plasticMiddle);
}

int btElasticPlasticJoint::prepare()
{
	m_uncommitted = m_step.m_rows > 0 ? m_uncommitted + 1 : 0;
	m_step.m_rows = 0;
	m_step.m_request = m_request;
	m_request = WHOLE_ROWS;
	if (m_dofs && (!m_action || m_uncommitted > 2) && !m_fault)
		refuseWithoutBooks();
	const btRigidBody &A = m_constraint.getRigidBodyA(), &B = m_constraint.getRigidBodyB();
	if (m_fault || m_state.m_broken || (A.getInvMass() == 0 && B.getInvMass() == 0))
		return 0;
	// A body that something else made NaN, or pushes with NaN, must not take its neighbours with it. Here what Bullet multiplies
	// with any row; a row of its inertia tells whether it is turned in a way that is no number. Where it stands is looked at
	// with the strain.
	const btVector3 motion = A.getLinearVelocity() + A.getAngularVelocity() + A.getTotalForce() + A.getTotalTorque() +
							 A.getInvInertiaTensorWorld()[0] + B.getLinearVelocity() + B.getAngularVelocity() +
							 B.getTotalForce() + B.getTotalTorque() + B.getInvInertiaTensorWorld()[0];
	if (!btElasticPlasticIsFinite(motion.x() + motion.y() + motion.z()))
		return 0;
	// Angular rows first, as in Bullet's own classes.
	int rows = 0;
	for (int dof = 3; dof < BT_EP_DOF_COUNT; ++dof)
		if (m_dofs >> dof & 1u)
			m_step.m_row[rows++].m_dof = dof;
	for (int dof = 0; dof < 3; ++dof)
		if (m_dofs >> dof & 1u)
			m_step.m_row[rows++].m_dof = dof;
	m_step.m_rows = rows;
	return m_step.m_request == NO_ROWS ? 0 : m_step.m_rows;
}

bool btElasticPlasticJoint::prepareAlone()
{
	request(NO_ROWS);
	if (m_partingWorld || (hasBaseDof() && isBaseActive()))
		return false;
	m_constraint.internalSetAppliedImpulse(0);
	if (btJointFeedback* feedback = m_constraint.getJointFeedback())
		clear(*feedback);
	prepare();
	return true;
}

namespace
{
/// A = J M^-1 J^T of a joint's rows.
class Diagonal
{
public:
	Diagonal(const btRigidBody& a, const btRigidBody& b)
		: m_a(a.getInvInertiaTensorWorld()),
		  m_b(b.getInvInertiaTensorWorld()),
		  m_both(m_a + m_b),
		  m_inverseMass(a.getInvMass() + b.getInvMass())
	{
	}
	btScalar along(const btVector3& momentA, const btVector3& momentB) const
	{
		return m_inverseMass + momentA.dot(m_a * momentA) + momentB.dot(m_b * momentB);
	}
	btScalar about(const btVector3& axis) const { return axis.dot(m_both * axis); }

private:
	const btMatrix3x3 &m_a, &m_b;
	const btMatrix3x3 m_both;
	const btScalar m_inverseMass;
};
}  // namespace

/// J v of all six degrees of freedom, from the relative velocity of A to B at the common point and the relative angular velocity.
void btElasticPlasticJoint::project(const btVector3& linear, const btVector3& angular,
									btScalar onAxes[BT_EP_DOF_COUNT]) const
{
	for (int i = 0; i < 3; ++i)
	{
		onAxes[i] = m_step.m_kinematics.m_axis[i].dot(linear);
		onAxes[3 + i] = m_step.m_kinematics.m_axis[i].dot(angular);
	}
}

/// 1 / m_min of equation 16: the smaller of the bodies' masses or of their inertias about the axis.
btScalar btElasticPlasticJoint::paperInverseMass(int dof) const
{
	const btRigidBody &A = m_constraint.getRigidBodyA(), &B = m_constraint.getRigidBodyB();
	if (dof < 3)
		return btMax(A.getInvMass(), B.getInvMass());
	const btVector3& axis = m_step.m_kinematics.m_axis[dof - 3];
	return btMax((A.getInvInertiaTensorWorld() * axis).length(), (B.getInvInertiaTensorWorld() * axis).length());
}

inline btElasticPlastic::SoftRow btElasticPlasticJoint::makeRow(int dof, btScalar diagonal, btScalar erp) const
{
	const btScalar dt = m_step.m_dt;
	const btElasticPlastic::DofState s = {m_capacity.m_stiffness[dof],       m_capacity.m_yield[dof],
										m_step.m_kinematics.m_strain[dof], m_state.m_force[dof],
										m_state.m_forceRate[dof],          m_state.m_lastStep};
	if (m_capacity.isRigidPlastic(dof))
		return btElasticPlastic::rigidRow(s.m_yield, s.m_strain, erp, dt);
	if (m_scheme == BT_EP_SCHEME_PAPER)
		return m_constraint.getConstraintType() == D6_SPRING_CONSTRAINT_TYPE
				   ? btElasticPlastic::paperMotorRow(s, dt)
				   : btElasticPlastic::paperSpringRow(s, paperInverseMass(dof), dt);
	return m_step.m_request == WHOLE_ROWS ? btElasticPlastic::stockRow(s, diagonal, dt)
										  : btElasticPlastic::implicitRow(s, diagonal, dt);
}

inline btElasticPlastic::SoftRow btElasticPlasticJoint::startRow(Row& row, btScalar diagonal, btScalar erp)
{
	const btElasticPlastic::SoftRow made = makeRow(row.m_dof, diagonal, erp);
	row.m_lower = made.m_lower;
	row.m_upper = made.m_upper;
	return made;
}

btElasticPlastic::SoftRow btElasticPlasticJoint::implicitRow(int r, btScalar diagonal, btScalar erp)
{
	return startRow(m_step.m_row[r], diagonal, erp);
}

static void copy(btScalar* to, const btVector3& from)
{
	for (int i = 0; i < 3; ++i)
		to[i] = from[i];
}

/// A kinematic body already stands where the step will take it, and has the velocity that brought it there.
void btElasticPlasticJoint::takeBackKinematicMotion(btScalar dt)
{
	const btRigidBody &A = m_constraint.getRigidBodyA(), &B = m_constraint.getRigidBodyB();
	if (!A.isKinematicObject() && !B.isKinematicObject())
		return;
	btElasticPlastic::Kinematics& k = m_step.m_kinematics;
	btVector3 linear(0, 0, 0), angular(0, 0, 0);
	if (A.isKinematicObject())
	{
		linear += A.getVelocityInLocalPoint(k.m_rA);
		angular += A.getAngularVelocity();
	}
	if (B.isKinematicObject())
	{
		linear -= B.getVelocityInLocalPoint(k.m_rB);
		angular -= B.getAngularVelocity();
	}
	btScalar moved[BT_EP_DOF_COUNT];
	project(linear, angular, moved);
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		k.m_strain[i] += dt * moved[i];
}

bool btElasticPlasticJoint::startStep(btScalar dt)
{
	measure(m_step.m_kinematics);
	btScalar sum = 0;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		sum += m_step.m_kinematics.m_strain[i];
	if (!btElasticPlasticIsFinite(sum))
	{
		revert();
		return false;
	}
	const btRigidBody &A = m_constraint.getRigidBodyA(), &B = m_constraint.getRigidBodyB();
	const btElasticPlastic::Kinematics& k = m_step.m_kinematics;
	const btVector3 linear = A.getVelocityInLocalPoint(k.m_rA) - B.getVelocityInLocalPoint(k.m_rB);
	btScalar velocity[BT_EP_DOF_COUNT];
	project(linear, A.getAngularVelocity() - B.getAngularVelocity(), velocity);
	for (int r = 0, rows = m_step.m_rows; r < rows; ++r)
	{
		m_step.m_row[r].m_velocity0 = velocity[m_step.m_row[r].m_dof];
		m_step.m_row[r].m_impulse = 0;
	}
	m_step.m_dt = dt;
	takeBackKinematicMotion(dt);
	return true;
}

void btElasticPlasticJoint::getDiagonals(btScalar diagonals[BT_EP_DOF_COUNT]) const
{
	const btElasticPlastic::Kinematics& k = m_step.m_kinematics;
	const Diagonal diagonal(m_constraint.getRigidBodyA(), m_constraint.getRigidBodyB());
	for (int r = 0; r < m_step.m_rows; ++r)
	{
		const int dof = m_step.m_row[r].m_dof;
		const btVector3& axis = k.m_axis[dof % 3];
		diagonals[r] = dof < 3 ? diagonal.along(k.m_rA.cross(axis), k.m_rB.cross(axis)) : diagonal.about(axis);
	}
}

void btElasticPlasticJoint::writeRows(btTypedConstraint::btConstraintInfo2* info, int firstRow)
{
	if (m_step.m_request == NO_ROWS)
		return;
	const btElasticPlastic::Kinematics& k = m_step.m_kinematics;
	const Diagonal diagonal(m_constraint.getRigidBodyA(), m_constraint.getRigidBodyB());
	// Copies of what the compiler would read again after every write.
	const int rows = m_step.m_rows, skip = info->rowskip;
	const bool isWhole = m_step.m_request == WHOLE_ROWS;
	if (!startStep(1 / info->fps))
	{
		// Rows of zeros, as Bullet has left them.
		for (int s = firstRow * skip, r = 0; r < rows; ++r, s += skip)
			info->m_lowerLimit[s] = info->m_upperLimit[s] = 0;
		return;
	}
	int s = firstRow * skip;
	for (int r = 0; r < rows; ++r, s += skip)
	{
		Row& row = m_step.m_row[r];
		const btVector3& axis = k.m_axis[row.m_dof < 3 ? row.m_dof : row.m_dof - 3];
		btScalar a = 0;
		if (row.m_dof < 3)
		{
			const btVector3 momentA = k.m_rA.cross(axis), momentB = axis.cross(k.m_rB);
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
		if (!isWhole)
			continue;
		const btElasticPlastic::SoftRow made = startRow(row, a, info->erp);
		info->m_constraintError[s] = made.m_velocity;
		info->cfm[s] = made.m_compliance / a;
		info->m_lowerLimit[s] = made.m_lower;
		info->m_upperLimit[s] = made.m_upper;
	}
	m_dual.resize(0);
	if (firstRow > 0 && isWhole)
		separateBaseRows(*info, firstRow);
}

void btElasticPlasticJoint::request(Request request)
{
	m_request = request;
	// Bullet would fill it row by row, for nobody.
	if (request != WHOLE_ROWS && m_constraint.getJointFeedback() == &m_feedback)
		m_constraint.setJointFeedback(nullptr);
}

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

/// The feedback sums the rows of Bullet's class and ours. Row i's impulse is its component along the dual vector: what is left
/// of J_i after taking away its parts along all other rows, scaled so that its product with J_i is 1. Rows of Bullet's class
/// may be parallel to each other (two limits), never to ours: they are on other degrees of freedom.
void btElasticPlasticJoint::separateBaseRows(const btTypedConstraint::btConstraintInfo2& info, int baseRows)
{
	const int count = baseRows + m_step.m_rows;
	m_dual.resize(2 * m_step.m_rows);
	for (int r = 0; r < m_step.m_rows; ++r)
	{
		Direction orthonormal[BT_EP_DOF_COUNT], own = {};
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
