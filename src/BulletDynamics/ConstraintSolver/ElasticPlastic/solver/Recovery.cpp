// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Recovery.h"

#include <math.h>

#include <algorithm>

#include "BulletCollision/NarrowPhaseCollision/btManifoldPoint.h"
#include "BulletDynamics/ConstraintSolver/btContactSolverInfo.h"
#include "BulletDynamics/ConstraintSolver/btSolverConstraint.h"
#include "Jacobian.h"

namespace btElasticPlastic
{
namespace
{
/// Recovery that is slower stays where Bullet has put it: its energy is next to nothing, and a second solution is not worth it [m/s].
const double SLOW = 0.1;
/// Recovery that is faster waits where a joint would begin to yield by it: a contact that is found a hand deep would tear joints at
/// rest [m/s].
const double FAST = 0.5;
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

Recovery::Demand Recovery::take(btSolverConstraint& contact, const btContactSolverInfo& info)
{
	Demand demand;
	const btManifoldPoint* const point = static_cast<const btManifoldPoint*>(contact.m_originalContactPoint);
	if (!point || hasItsOwn(*point) || !(contact.m_jacDiagABInv > 0))
		return demand;
	const double gap = double(point->getDistance()) + double(info.m_linearSlop);
	const double speed = -gap * double(info.m_erp2) / double(info.m_timeStep);
	if (!(speed > SLOW))
		return demand;
	const bool isSplit = info.m_splitImpulse && !(gap > double(info.m_splitImpulsePenetrationThreshold));
	if (isSplit)
		contact.m_rhsPenetration = 0;
	demand.m_speed = speed;
	demand.m_isInRow = !isSplit;
	return demand;
}

void Recovery::begin()
{
	m_contacts.clear();
	m_motion.clear();
}

/// Whether a joint flows in the second solution that does not in the first: recovery that would tear it waits.
bool Recovery::makesYield(const SystemInput& input) const
{
	for (const SystemInput::Unit& unit : input.m_units)
		for (size_t r = size_t(unit.m_firstRow); r < size_t(unit.m_firstRow + unit.m_numRows); ++r)
			if (m_second.m_bounds[r] != 0 && m_first.m_bounds[r] == 0)
				return true;
	return false;
}

void Recovery::solve(System& system, SystemInput& input, const std::vector<double>& push)
{
	m_first = system.getResult();
	input.m_rows = m_rows;
	double fastest = 0;
	for (const double speed : push)
		fastest = std::max(fastest, fabs(speed));
	for (const Contact& contact : m_contacts)
	{
		fastest = std::max(fastest, contact.m_speed);
		SystemInput::Bounded& row = input.m_rows[size_t(contact.m_row)];
		row.m_target += contact.m_speed;
		row.m_upper = m_first.m_impulses[size_t(contact.m_row)] + MOST_PUSH * contact.m_speed * contact.m_alone;
	}
	if (!push.empty())
	{
		std::vector<double> along;
		project(input, push, along);
		for (size_t i = 0; i < along.size(); ++i)
			input.m_rows[i].m_target -= along[i];
	}
	// What does not converge stays deep for a step: places are not worth as much as velocities.
	if (system.solveAgain(input, System::PLAIN))
	{
		m_second = system.getResult();
		if (fastest > FAST && makesYield(input))
		{
			system.setResult(m_first);
			return;
		}
		m_motion = push;
		m_motion.resize(m_first.m_velocity.size());
		for (size_t i = 0; i < m_motion.size(); ++i)
			m_motion[i] += m_second.m_velocity[i] - m_first.m_velocity[i];
	}
	system.setResult(m_first);
}
}  // namespace btElasticPlastic
