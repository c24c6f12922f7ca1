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
/// How many times the impulse that would part the two bodies by themselves recovery may push. 4 leaves some of 300 random drops on
/// beams deep for long, without a bound one of twenty makes energy; 16 does neither.
const double MOST_PUSH = 16;
const double UNBOUNDED = 1e30;

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

/// Joints are linear here, whatever they do in the first solution: recovery is to make none yield, and none that yields flow further.
void Recovery::makeLinear(SystemInput& input, SystemResult& start) const
{
	std::vector<double> along;
	project(input, m_first.m_velocity, along);
	for (const SystemInput::Unit& unit : input.m_units)
		for (size_t r = size_t(unit.m_firstRow); r < size_t(unit.m_firstRow + unit.m_numRows); ++r)
		{
			SystemInput::Bounded& row = input.m_rows[r];
			// As if the row had come to its impulse without a bound.
			row.m_target = along[r] + row.m_compliance * m_first.m_impulses[r];
			if (row.m_partner >= 0)
				row.m_target += row.m_coupling * m_first.m_impulses[size_t(row.m_partner)];
			row.m_lower = -UNBOUNDED;
			row.m_upper = UNBOUNDED;
			start.m_bounds[r] = 0;
		}
}

/// The share of the second solution's difference that keeps the joints that do not yield within their bounds.
double Recovery::findShare(const SystemInput& input) const
{
	double share = 1;
	for (const SystemInput::Unit& unit : input.m_units)
		for (size_t r = size_t(unit.m_firstRow); r < size_t(unit.m_firstRow + unit.m_numRows); ++r)
		{
			const double first = m_first.m_impulses[r], change = m_second.m_impulses[r] - first;
			const double room = change > 0 ? m_rows[r].m_upper - first : first - m_rows[r].m_lower;
			if (m_first.m_bounds[r] == 0 && fabs(change) * share > room)
				share = std::max(room, 0.) / fabs(change);
		}
	return share;
}

void Recovery::solve(System& system, SystemInput& input, const std::vector<double>& push)
{
	m_first = system.getResult();
	input.m_rows = m_rows;
	SystemResult start = m_first;
	makeLinear(input, start);
	for (const Contact& contact : m_contacts)
	{
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
	system.setResult(start);
	system.forgetPlace();
	// What does not converge stays deep for a step: places are not worth as much as velocities.
	if (system.solveAgain(input, System::PLAIN))
	{
		m_second = system.getResult();
		const double share = findShare(input);
		m_motion = push;
		m_motion.resize(m_first.m_velocity.size());
		for (size_t i = 0; i < m_motion.size(); ++i)
			m_motion[i] = share * (m_motion[i] + m_second.m_velocity[i] - m_first.m_velocity[i]);
		for (size_t r = 0; r < m_second.m_impulses.size(); ++r)
		{
			const double first = m_first.m_impulses[r];
			m_second.m_impulses[r] =
				m_first.m_bounds[r] != 0 ? first : first + share * (m_second.m_impulses[r] - first);
		}
		m_second.m_bounds = m_first.m_bounds;
	}
	system.setResult(m_first);
}
}  // namespace btElasticPlastic
