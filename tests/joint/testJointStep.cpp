// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// One step of a joint: evaluated, taken back, committed.

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/JointWorks.h"
#include "support/Row.h"

namespace
{
TEST(JointStep, EvaluatingChangesNothing)
{
	// Trial and revert: rows may be asked for as often as one likes; only a commit moves the state.
	Row row(1);
	row.run(20);
	btElasticPlasticJoint* joint = row.m_joints[0];
	btElasticPlastic::JointStep& step = btElasticPlastic::JointWorks::from(&joint->getConstraint())->m_step;
	const btElasticPlasticState before = joint->getState();
	for (int i = 0; i < 5; ++i)
	{
		EXPECT_EQ(6, step.prepare());
		step.revert();
		EXPECT_EQ(0, step.commit());
	}
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
	{
		EXPECT_EQ(before.m_force[i], joint->getState().m_force[i]);
		EXPECT_EQ(before.m_plastic[i], joint->getState().m_plastic[i]);
	}
	EXPECT_EQ(before.m_work, joint->getState().m_work);
}
}  // namespace
