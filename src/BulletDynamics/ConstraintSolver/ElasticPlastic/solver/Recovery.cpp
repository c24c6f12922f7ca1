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
/// What would be recovered more slowly stays as it is, a tenth of a millimetre at 1/60 s [m/s].
const double SLOW = 1e-3;
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

double Recovery::take(btSolverConstraint& contact, const btContactSolverInfo& info, double slowest)
{
	const btManifoldPoint* const point = static_cast<const btManifoldPoint*>(contact.m_originalContactPoint);
	if (!point || hasItsOwn(*point) || !(contact.m_jacDiagABInv > 0))
		return 0;
	const double gap = double(point->getDistance()) + double(info.m_linearSlop);
	const double speed = -gap * double(info.m_erp2) / double(info.m_timeStep);
	if (!(speed > slowest))
		return 0;
	const bool isSplit = info.m_splitImpulse && !(gap > double(info.m_splitImpulsePenetrationThreshold));
	if (isSplit)
		contact.m_rhsPenetration = 0;
	else
		contact.m_rhs -= btScalar(speed) * contact.m_jacDiagABInv;
	return speed > SLOW ? speed : 0;
}

void Recovery::begin()
{
	m_isAsked = false;
	m_pushed.clear();
	m_joined.clear();
	m_motion.clear();
}

void Recovery::addContact(int contact, double speed, const bool moves[2])
{
	m_isAsked |= speed > 0;
	m_pushed.push_back({contact, speed, 0, {moves[0], moves[1]}});
}

void Recovery::addJoinedContact(int row, double speed, double alone)
{
	m_isAsked = true;
	m_joined.push_back({row, speed, alone});
}

/// Moves places as if only contacts held the bodies.
void Recovery::push(const SolverPools& pools, int sweeps)
{
	struct Side
	{
		const btVector3 &m_normal, &m_arm, &m_turn;
		int m_solverBody;
	};
	for (int sweep = 0; sweep < sweeps; ++sweep)
		for (PushedContact& contact : m_pushed)
		{
			const btSolverConstraint& row = pools.m_contacts[contact.m_contact];
			const Side sides[2] = {
				{row.m_contactNormal1, row.m_relpos1CrossNormal, row.m_angularComponentA, row.m_solverBodyIdA},
				{row.m_contactNormal2, row.m_relpos2CrossNormal, row.m_angularComponentB, row.m_solverBodyIdB}};
			double speed = 0, response = 0;
			for (int k = 0; k < 2; ++k)
			{
				const Side& side = sides[k];
				const btSolverBody& body = pools.m_bodies[side.m_solverBody];
				const double* const motion = getMotion(side.m_solverBody);
				for (int i = 0; i < 3; ++i)
					speed += double(side.m_normal[i]) * motion[i] + double(side.m_arm[i]) * motion[3 + i];
				if (contact.m_moves[k])
					response += double(side.m_normal.dot(side.m_normal * body.internalGetInvMass())) +
								double(side.m_arm.dot(side.m_turn));
			}
			if (!(response > 0))
				continue;
			const double before = contact.m_impulse;
			contact.m_impulse = std::max(0., before + (contact.m_speed - speed) / response);
			for (int k = 0; k < 2; ++k)
			{
				const Side& side = sides[k];
				const btSolverBody& body = pools.m_bodies[side.m_solverBody];
				const btVector3 linear = side.m_normal * body.internalGetInvMass() * body.m_linearFactor,
								angular = side.m_turn * body.m_angularFactor;
				double* const motion = &m_motion[6 * size_t(side.m_solverBody)];
				for (int i = 0; contact.m_moves[k] && i < 3; ++i)
				{
					motion[i] += (contact.m_impulse - before) * double(linear[i]);
					motion[3 + i] += (contact.m_impulse - before) * double(angular[i]);
				}
			}
		}
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

/// \param push  of joined bodies, by the system's bodies: motion of their places by contacts that are not in the system; empty: none
/// \return false if joined bodies have to wait
bool Recovery::solveJoined(System& system, SystemInput& input, const std::vector<double>& push)
{
	m_first = system.getResult();
	input.m_rows = m_rows;
	double fastest = 0;
	for (const double speed : push)
		fastest = std::max(fastest, fabs(speed));
	for (const JoinedContact& contact : m_joined)
	{
		fastest = std::max(fastest, contact.m_speed);
		SystemInput::Bounded& row = input.m_rows[size_t(contact.m_row)];
		row.m_target += contact.m_speed;
		row.m_upper = m_first.m_impulses[size_t(contact.m_row)] + MOST_PUSH * contact.m_speed * contact.m_alone;
	}
	std::vector<double> along;
	project(input, push, along);
	for (size_t i = 0; i < along.size(); ++i)
		input.m_rows[i].m_target -= along[i];
	// What does not converge stays deep for a step: places are not worth as much as velocities.
	const bool isSolved = system.solveAgain(input, System::PLAIN);
	m_second = system.getResult();
	system.setResult(m_first);
	return isSolved && !(fastest > FAST && makesYield(input));
}

void Recovery::solve(System& system, SystemInput& input, const SolverPools& pools, const btContactSolverInfo& info,
					 const btAlignedObjectArray<int>& solverBodies, const btAlignedObjectArray<bool>& isLoose)
{
	m_motion.assign(6 * size_t(pools.m_bodies.size()), 0.);
	push(pools, info.m_numIterations);
	// What loose bodies do is no business of the joints.
	std::vector<double> joined(6 * size_t(input.getNumBodies()), 0.);
	bool isAnyPushed = false;
	for (int b = 0; b < input.getNumBodies(); ++b)
		for (int i = 0; i < 6 && !isLoose[b]; ++i)
		{
			joined[size_t(6 * b + i)] = getMotion(solverBodies[b])[i];
			isAnyPushed |= joined[size_t(6 * b + i)] != 0;
		}
	if (m_joined.empty() && !isAnyPushed)
		return;
	const bool moves = solveJoined(system, input, joined);
	for (int b = 0; b < input.getNumBodies(); ++b)
		for (size_t i = 0; i < 6; ++i)
		{
			double& motion = m_motion[6 * size_t(solverBodies[b]) + i];
			if (moves)
				motion += m_second.m_velocity[6 * size_t(b) + i] - m_first.m_velocity[6 * size_t(b) + i];
			else if (!isLoose[b])
				motion = 0;
		}
}
}  // namespace btElasticPlastic
