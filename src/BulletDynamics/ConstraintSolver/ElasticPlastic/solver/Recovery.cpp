// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Recovery.h"

#include "BulletCollision/NarrowPhaseCollision/btManifoldPoint.h"
#include "BulletDynamics/ConstraintSolver/btContactSolverInfo.h"
#include "BulletDynamics/ConstraintSolver/btSolverConstraint.h"

namespace btElasticPlastic
{
namespace
{
/// Recovery that is slower stays where Bullet has put it: its energy is next to nothing, and a second solution is not worth it [m/s].
const double SLOW = 0.1;
/// How many times the impulse that would part the two bodies by themselves recovery may push. 4 leaves some of 300 random drops on
/// beams deep for long, without a bound one of twenty makes energy; 16 does neither.
const double MOST_PUSH = 16;

/// A contact that a user has given a stiffness or an error reduction of its own.
bool hasItsOwn(const btManifoldPoint& point)
{
	return (point.m_contactPointFlags & (BT_CONTACT_FLAG_HAS_CONTACT_CFM | BT_CONTACT_FLAG_HAS_CONTACT_ERP |
										 BT_CONTACT_FLAG_CONTACT_STIFFNESS_DAMPING)) != 0;
}
}  // namespace

void Recovery::addContact(btSolverConstraint& from, const btContactSolverInfo& info, SystemInput& input, int row)
{
	const btManifoldPoint* const point = static_cast<const btManifoldPoint*>(from.m_originalContactPoint);
	if (!point || hasItsOwn(*point) || !(from.m_jacDiagABInv > 0))
		return;
	const double gap = double(point->getDistance()) + double(info.m_linearSlop);
	const double speed = -gap * double(info.m_erp2) / double(info.m_timeStep);
	if (!(speed > SLOW))
		return;
	const bool isSplit = info.m_splitImpulse && !(gap > double(info.m_splitImpulsePenetrationThreshold));
	if (isSplit)
		from.m_rhsPenetration = 0;
	else
		input.m_rows[size_t(row)].m_target -= speed;
	m_contacts.push_back({row, speed, MOST_PUSH * speed * double(from.m_jacDiagABInv)});
}

bool Recovery::solve(System& system, SystemInput& input, int& islandId)
{
	m_motion.clear();
	if (!m_contacts.empty())
		m_rows = input.m_rows;
	if (!system.solve(input, islandId))
		return false;
	if (m_contacts.empty())
		return true;
	m_first = system.getResult();
	input.m_rows = m_rows;
	for (const Contact& contact : m_contacts)
	{
		SystemInput::Bounded& row = input.m_rows[size_t(contact.m_row)];
		row.m_target += contact.m_speed;
		row.m_upper = m_first.m_impulses[size_t(contact.m_row)] + contact.m_mostImpulse;
	}
	if (system.solveAgain(input))
	{
		m_second = system.getResult();
		m_motion.resize(m_first.m_velocity.size());
		for (size_t i = 0; i < m_motion.size(); ++i)
			m_motion[i] = m_second.m_velocity[i] - m_first.m_velocity[i];
	}
	// What does not converge stays deep for a step: places are not worth a wrong velocity.
	system.setResult(m_first);
	return true;
}
}  // namespace btElasticPlastic
