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

	/// Takes its own feedback object off, for solvers that tell impulses directly: Bullet would fill it row by row, for nobody.
	void detach(btTypedConstraint& constraint)
	{
		if (constraint.getJointFeedback() == &m_feedback)
			constraint.setJointFeedback(nullptr);
	}

	static void clear(btJointFeedback& feedback);

	/// The feedback sums the rows of Bullet's class and the elastic-plastic ones: finds what tells these from each other.
	/// \param baseRows  Bullet's rows, which come first
	void separateRows(const btTypedConstraint::btConstraintInfo2& info, int baseRows, int numRows);
	/// There are none of Bullet's class.
	void setNoBaseRows() { m_dual.resize(0); }

	/// Sets the impulses of the step's rows from what Bullet has summed up.
	void decode(const btTypedConstraint& constraint, JointStep& step) const;

private:
	btJointFeedback m_feedback;
	btAlignedObjectArray<btVector3>
		m_dual;  ///< two vectors a row: impulse = force . first + torque . second; empty: the axes do
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_STOCK_FEEDBACK_H
