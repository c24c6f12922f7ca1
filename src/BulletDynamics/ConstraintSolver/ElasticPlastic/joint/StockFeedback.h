// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STOCK_FEEDBACK_H
#define BT_ELASTIC_PLASTIC_STOCK_FEEDBACK_H

#include "BulletDynamics/ConstraintSolver/btTypedConstraint.h"
#include "LinearMath/btAlignedObjectArray.h"

namespace btElasticPlastic
{
class JointStep;

/// Decodes the impulses of a joint's rows from Bullet's joint feedback, the only way in which Bullet's own solvers tell them.
/// Uses the user's feedback object if there is one, else its own.
class StockFeedback
{
public:
	/// Sets its own feedback object unless the user has set one.
	void attach(btTypedConstraint& constraint)
	{
		if (!constraint.getJointFeedback())
		{
			clear(m_feedback);
			constraint.setJointFeedback(&m_feedback);
		}
	}

	/// Removes its own feedback object, which nobody reads if the solver returns impulses directly.
	void detach(btTypedConstraint& constraint)
	{
		if (constraint.getJointFeedback() == &m_feedback)
			constraint.setJointFeedback(nullptr);
	}

	static void clear(btJointFeedback& feedback);

	/// Finds the dual vectors that separate the elastic-plastic rows' impulses from those of Bullet's class: the feedback is
	/// the sum of both.
	/// \param baseRows  Bullet's rows, which come first
	void separateRows(const btTypedConstraint::btConstraintInfo2& info, int baseRows, int numRows);
	/// Notes that Bullet's class has no rows in this step.
	void setNoBaseRows() { m_dual.resize(0); }

	/// Sets the impulses of the step's rows from what Bullet has summed up.
	void decode(const btTypedConstraint& constraint, JointStep& step) const;

private:
	btJointFeedback m_feedback;
	btAlignedObjectArray<btVector3>
		m_dual;  ///< two vectors a row: impulse = force . first + torque . second; empty: the joint's axes serve as dual vectors
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_STOCK_FEEDBACK_H
