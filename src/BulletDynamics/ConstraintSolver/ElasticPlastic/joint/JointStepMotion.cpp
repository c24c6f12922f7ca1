// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// How a joint's bodies move in the step, along and about its axes.

#include "JointStep.h"

#include "BodyGate.h"
#include "JoinedVelocity.h"

namespace btElasticPlastic
{
namespace
{
/// The least and the most that bodies turn by as one in a step for that to be left out of what the step leaves open [rad]: of less there is nothing to be left out.
const btScalar LEAST_TURN_AS_ONE = btScalar(1e-6), MOST_TURN_AS_ONE = btScalar(0.35);
}  // namespace

void JointStep::projectVelocities(btScalar onAxes[BT_EP_DOF_COUNT]) const
{
	const btRigidBody &A = m_model.bodyA(), &B = m_model.bodyB();
	m_kinematics.projectMotion(velocityAt(A, m_kinematics.m_rA) - velocityAt(B, m_kinematics.m_rB),
							   spinOf(A) - spinOf(B), onAxes);
}

bool JointStep::projectMotion(btScalar before[BT_EP_DOF_COUNT], btScalar after[BT_EP_DOF_COUNT]) const
{
	projectVelocities(after);
	return findMotion(m_numRows, before, after);
}

void JointStep::getMotion(btScalar before[BT_EP_DOF_COUNT], btScalar after[BT_EP_DOF_COUNT]) const
{
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		after[i] = 0;
	for (int r = 0; r < m_numCommittedRows; ++r)
		after[m_row[r].m_dof] = m_row[r].m_velocity1;
	findMotion(m_numCommittedRows, before, after);
}

/// \return whether anything flows
bool JointStep::findMotion(int numRows, btScalar before[BT_EP_DOF_COUNT], btScalar after[BT_EP_DOF_COUNT]) const
{
	bool flows = false;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		before[i] = 0;
	for (int r = 0; r < numRows; ++r)
	{
		before[m_row[r].m_dof] = m_row[r].m_velocity0;
		flows |= isFlowing(r);
	}
	if (!flows)
		leaveTurnOut(before, after);
	return flows;
}

/// Where bodies turn as one, they part at some rate as a step begins, twice as fast if nobody has held them on their circles in the last one, and close by as much in it; but for
/// a share of a turn in any direction. A turn that a blow gives or takes is none, and one that is too fast hides what a blow does.
void JointStep::leaveTurnOut(btScalar before[BT_EP_DOF_COUNT], btScalar after[BT_EP_DOF_COUNT]) const
{
	const auto lasting = [](const btVector3& one, const btVector3& other)
	{ return one.length2() < other.length2() ? one : other; };
	const btVector3 spins[2] = {lasting(m_spin0[0], spinOf(m_model.bodyA())),
								lasting(m_spin0[1], spinOf(m_model.bodyB()))};
	const btScalar turn = m_dt * btSqrt(btMax(spins[0].length2(), spins[1].length2()));
	if (turn < LEAST_TURN_AS_ONE || turn > MOST_TURN_AS_ONE)
		return;
	const auto towardsMiddle = [](const btVector3& spin, const btVector3& arm) { return spin.cross(spin.cross(arm)); };
	const btVector3 parting =
		(towardsMiddle(spins[0], m_kinematics.m_rA) - towardsMiddle(spins[1], m_kinematics.m_rB)) * (m_dt / 2);
	const btScalar beside = turn * parting.length();
	btScalar ofTurn[BT_EP_DOF_COUNT];
	m_kinematics.projectMotion(parting, btVector3(0, 0, 0), ofTurn);
	const auto without = [&](btScalar rate, int dof, btScalar times)
	{
		const btScalar most = times * ofTurn[dof], slack = btFabs(times) * beside;
		return rate - btClamped(rate, btMin(most, btScalar(0)) - slack, btMax(most, btScalar(0)) + slack);
	};
	for (int i = BT_EP_AXIAL; i <= BT_EP_SHEAR_Z; ++i)
	{
		before[i] = without(before[i], i, 2);
		after[i] = without(after[i], i, -1);
	}
}

/// J v of all degrees of freedom, and the relative angular velocity, with which the bodies were moved: other actions may have changed
/// the present velocities already.
void JointStep::projectEnd(btScalar onAxes[BT_EP_DOF_COUNT], btVector3& spin) const
{
	const Kinematics& k = m_kinematics;
	const btRigidBody &A = m_model.bodyA(), &B = m_model.bodyB();
	// Bullet does not move what is static or frozen, and leaves it the velocities of its last motion.
	const btVector3 still(0, 0, 0);
	const auto moves = [](const btRigidBody& body) { return !isStanding(body) && !isFrozen(body); };
	const auto lastSpin = [&](const btRigidBody& body)
	{ return moves(body) ? body.getInterpolationAngularVelocity() : still; };
	const auto lastVelocity = [&](const btRigidBody& body)
	{ return moves(body) ? body.getInterpolationLinearVelocity() : still; };
	const btVector3 wA = lastSpin(A), wB = lastSpin(B);
	spin = wA - wB;
	k.projectMotion(lastVelocity(A) + wA.cross(k.m_rA) - lastVelocity(B) - wB.cross(k.m_rB), spin, onAxes);
}
}  // namespace btElasticPlastic
