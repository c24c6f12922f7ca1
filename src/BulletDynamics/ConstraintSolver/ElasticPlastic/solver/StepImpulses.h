// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STEP_IMPULSES_H
#define BT_ELASTIC_PLASTIC_STEP_IMPULSES_H

#include "Islands.h"
#include "LinearMath/btAlignedObjectArray.h"
#include "LinearMath/btScalar.h"

namespace btElasticPlastic
{
/// What Bullet bounds by an impulse in a step, and not by a force: a constraint's breaking threshold, the motors of hinges and cone
/// twists, the clamp of ball sockets. In a shorter step they are less in proportion.
class StepImpulses
{
public:
	/// \param share  of the world's step
	void scale(const SolverGroup& island, btScalar share);
	void restore();

private:
	struct Bound
	{
		btTypedConstraint* m_constraint;
		btScalar m_threshold, m_impulse;
	};

	btAlignedObjectArray<Bound> m_bounds;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_STEP_IMPULSES_H
