// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The impulses of a joint's rows, from what Bullet's own solvers tell.

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/JointWorks.h"
#include "support/Pair.h"

namespace testStockFeedback
{
using namespace ep;

TEST(StockFeedback, ARowThatIsOneOfBulletsToo)
{
	// Bullet's row turns about x, and so does the joint's first one; its second turns about y.
	Pair pair(Solver::Stock, 12, 12);
	btElasticPlasticJoint* joint = pair.join(evenCapacity(1e6));
	btElasticPlastic::JointStep& step = btElasticPlastic::JointWorks::from(&joint->getConstraint())->m_step;
	ASSERT_EQ(6, step.prepare());
	ASSERT_TRUE(step.evaluate(1));
	const int rows = 7, skip = 3;
	btScalar linear[rows * skip] = {}, angular[rows * skip] = {};
	const int axes[rows] = {0, 0, 1, 2, 0, 1, 2};
	for (int r = 0; r < rows; ++r)
	{
		// A pointer, since gcc 12 takes a wrong index in (a ? b : c)[i] of two arrays under -fsanitize=bounds.
		btScalar* jacobian = r < 4 ? angular : linear;
		jacobian[r * skip + axes[r]] = 1;
	}
	btTypedConstraint::btConstraintInfo2 info = {};
	info.m_J1linearAxis = linear;
	info.m_J1angularAxis = angular;
	info.rowskip = skip;

	btElasticPlastic::StockFeedback feedback;
	btJointFeedback told;
	joint->getConstraint().setJointFeedback(&told);
	told.m_appliedForceBodyA.setValue(1, 2, 3);
	told.m_appliedTorqueBodyA.setValue(4, 5, 6);
	feedback.separateRows(info, 1, 6);
	feedback.decode(joint->getConstraint(), step);
	const double expected[6] = {0, 5, 6, 1, 2, 3};
	for (int r = 0; r < 6; ++r)
		EXPECT_EQ(expected[r], double(step.getImpulse(r))) << r;
	step.revert();
	joint->getConstraint().setJointFeedback(nullptr);
}
}  // namespace testStockFeedback
