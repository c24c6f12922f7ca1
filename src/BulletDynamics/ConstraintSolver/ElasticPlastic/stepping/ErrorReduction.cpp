// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "ErrorReduction.h"

#include <algorithm>

#include "../joint/JointRegistry.h"
#include "../joint/JointWorks.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"

namespace btElasticPlastic
{
void ErrorReduction::scale(btDynamicsWorld& world, btScalar share, btScalar dt)
{
	btContactSolverInfo& info = world.getSolverInfo();
	btScalar* const factors[2] = {&info.m_erp, &info.m_erp2};
	for (int i = 0; i < 2; ++i)
	{
		m_own[i] = *factors[i];
		m_scaled[i] = *factors[i] *= share;
	}
	m_isScaled = true;
	for (int i = 0; i < world.getNumConstraints() && share < 1; ++i)
	{
		btTypedConstraint& constraint = *world.getConstraint(i);
		const JointWorks* const joint = JointWorks::from(&constraint);
		m_parameters.scale(constraint, !joint || !joint->m_model.isElasticPlasticThroughout(), share, dt);
	}
}

void ErrorReduction::restore(btDynamicsWorld& world, JointRegistry* registry)
{
	btContactSolverInfo& info = world.getSolverInfo();
	btScalar* const factors[2] = {&info.m_erp, &info.m_erp2};
	for (int i = 0; i < 2 && m_isScaled; ++i)
		if (*factors[i] == m_scaled[i])
			*factors[i] = m_own[i];
	m_isScaled = false;
	if (!m_parameters.isAnyHeld())
		return;
	m_existing.clear();
	for (int i = 0; i < world.getNumConstraints(); ++i)
		m_existing.push_back(world.getConstraint(i));
	for (int i = 0; registry && i < registry->getNumJoints(); ++i)
		m_existing.push_back(&registry->getJoint(i).m_model.m_constraint);
	std::sort(m_existing.begin(), m_existing.end());
	m_parameters.restoreWhere([this](const btTypedConstraint* constraint)
							  { return std::binary_search(m_existing.begin(), m_existing.end(), constraint); });
}
}  // namespace btElasticPlastic
