// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_ERROR_REDUCTION_H
#define BT_ELASTIC_PLASTIC_ERROR_REDUCTION_H

#include <vector>

#include "../solver/StepParameters.h"

class btDynamicsWorld;

namespace btElasticPlastic
{
class JointRegistry;

/// What a world has for a step, made that of a substep: its error reduction in proportion, its constraints' own parameters as StepParameters has it.
class ErrorReduction
{
public:
	/// \param share  of the step
	/// \param dt     of the step [s]
	void scale(btDynamicsWorld& world, btScalar share, btScalar dt);

	/// What others have changed since stays as it is. A constraint that has left the world gets its own back when it is in it again: nobody knows whether
	/// it still exists.
	/// \param registry  whose joints are known to exist; null: none
	void restore(btDynamicsWorld& world, JointRegistry* registry);

private:
	btScalar m_own[2] = {0, 0}, m_scaled[2] = {0, 0};  ///< m_erp and m_erp2 of the world
	bool m_isScaled = false;
	StepParameters m_parameters;
	std::vector<const btTypedConstraint*> m_existing;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_ERROR_REDUCTION_H
