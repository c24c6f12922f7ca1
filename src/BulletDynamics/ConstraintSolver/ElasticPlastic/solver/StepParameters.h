// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STEP_PARAMETERS_H
#define BT_ELASTIC_PLASTIC_STEP_PARAMETERS_H

#include "Islands.h"
#include "LinearMath/btAlignedObjectArray.h"
#include "LinearMath/btScalar.h"

namespace btElasticPlastic
{
/// What Bullet's constraints have for a step, and what that is in a shorter one.
///  - Impulses that bound what would better be bound by a force (a constraint's breaking threshold, the motors of hinges and cone twists, the
///    clamp of ball sockets): less in proportion.
///  - Their own factors of error reduction (limits of hinges, sliders, cone twists and of our joints' free directions): by the square. An error that a
///    long step has left, closed by the same share in a short one, would come out as many times as fast; and in proportion it would be closed with
///    one speed through all of them, by a motor that feeds what rings. Bullet's common factor is in btContactSolverInfo.
class StepParameters
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
	btAlignedObjectArray<btTypedConstraint*> m_withFactors;
	btAlignedObjectArray<btScalar> m_factors;  ///< of these, one after the other
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_STEP_PARAMETERS_H
