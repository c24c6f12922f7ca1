// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Recovery.h"

#include <math.h>

#include <algorithm>

#include "BulletCollision/NarrowPhaseCollision/btManifoldPoint.h"
#include "BulletDynamics/ConstraintSolver/btContactSolverInfo.h"
#include "BulletDynamics/ConstraintSolver/btSolverConstraint.h"
#include "ContactFactors.h"
#include "Jacobian.h"

namespace btElasticPlastic
{
namespace
{
/// What would be recovered more slowly stays as it is, a tenth of a millimetre at 1/60 s [m/s].
const double SLOW = 1e-3;
/// More than any impulse.
const double BOUNDLESS = 1e30;
/// How many times the impulse that would part the two bodies by themselves recovery may push. 4 leaves some of 300 random drops on
/// beams deep for long, without a bound one of twenty makes energy; 16 does neither.
const double MOST_PUSH = 16;

/// The compliance of joints as recovery moves their bodies, as a share of how far the bodies would part by themselves. As elastic as joints
/// are, recovery would turn the Charpy test's hinge by 2 % of its rotation without work; with 1e-5 a cantilever of 12 blocks on a foot
/// still creeps.
const double STIFF = 1e-7;

/// How far the impulse of a unit's row parts its bodies at least, by impulse.
double findResponse(const SystemInput& input, const SystemInput::Unit& unit, int dof)
{
	const double* const axis = unit.m_axis[dof % 3];
	double response = 0;
	for (const int b : unit.m_body)
	{
		if (b < 0)
			continue;
		const SystemInput::Body& body = input.m_bodies[size_t(b)];
		double inertia = 0;
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j)
				inertia += axis[i] * axis[j] * (dof >= 3 ? body.m_inertia[3 * i + j] : i == j ? body.m_mass[i] : 0);
		response += 1 / inertia;
	}
	return response;
}

}  // namespace

double Recovery::take(btSolverConstraint& contact, const btContactSolverInfo& info, double slowest)
{
	const btManifoldPoint* const point = static_cast<const btManifoldPoint*>(contact.m_originalContactPoint);
	if (!point || !(contact.m_jacDiagABInv > 0))
		return 0;
	if (isSpring(*point) || info.m_globalCfm > 0)
	{
		// Its depth is its force. Where it is deeper than some centimetres Bullet would push places instead, and pull them out of the joints.
		contact.m_rhs += contact.m_rhsPenetration;
		contact.m_rhsPenetration = 0;
		return 0;
	}
	const double gap = double(point->getDistance()) + double(info.m_linearSlop);
	const btScalar factor = hasOwnFactor(*point) ? point->m_contactERP : info.m_erp2;
	const double speed = -gap * double(factor) / double(info.m_timeStep);
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

/// Makes joints stiff and without bounds, but for those far from what happens in a large structure: what they are condensed to holds on.
/// Where nothing is recovered their impulses and velocities are those of the first solution.
void Recovery::stiffen(const System& system, SystemInput& input)
{
	const auto stays = [&](const SystemInput::Unit& unit) { return system.isElsewhere(unit.m_firstRow); };
	m_share.assign(size_t(input.getNumRows()), 1.);
	for (const SystemInput::Unit& unit : input.m_units)
	{
		if (stays(unit))
			continue;
		double least = 1;
		for (int i = 0; i < unit.m_numRows; ++i)
		{
			const size_t r = size_t(unit.m_firstRow + i);
			const double response = findResponse(input, unit, i < unit.getNumPlainRows() ? unit.m_dof[i] : 0);
			m_share[r] = std::min(1., STIFF * response / input.m_rows[r].m_compliance);
			least = std::min(least, m_share[r]);
		}
		// Rows whose compliance is coupled become stiffer together.
		for (int i = 0; i < unit.m_numRows; ++i)
		{
			const size_t r = size_t(unit.m_firstRow + i);
			const SystemInput::Bounded& row = input.m_rows[r];
			if (row.isInBundle())
				m_share[r] = least;
			else if (row.m_partner >= 0)
				m_share[r] = m_share[size_t(row.m_partner)] = std::min(m_share[r], m_share[size_t(row.m_partner)]);
		}
		if (unit.m_bundle < 0)
			continue;
		const int first = input.m_bundles[size_t(unit.m_bundle)].m_firstCoupling;
		for (int i = 0; i < unit.m_numFibres; ++i)
			for (double& coupling : input.m_couplings[size_t(first + i)].m_shear)
				coupling *= least;
	}
	std::vector<double> targets;
	project(input, m_first.m_velocity, targets);
	for (const SystemInput::Unit& unit : input.m_units)
		for (size_t r = size_t(unit.m_firstRow); !stays(unit) && r < size_t(unit.m_firstRow + unit.m_numRows); ++r)
		{
			SystemInput::Bounded& row = input.m_rows[r];
			row.m_compliance *= m_share[r];
			row.m_coupling *= m_share[r];
			targets[r] += row.m_compliance * m_first.m_impulses[r];
			if (row.m_partner >= 0)
				targets[r] += row.m_coupling * m_first.m_impulses[size_t(row.m_partner)];
		}
	for (const SystemInput::Bundle& bundle : input.m_bundles)
	{
		const SystemInput::Unit& unit = input.m_units[size_t(bundle.m_unit)];
		for (int s = 0; s < 2; ++s)
			for (int i = 0; bundle.m_shearRow[s] >= 0 && i < unit.m_numFibres; ++i)
			{
				const size_t fibre = size_t(unit.getFirstFibreRow() + i), shear = size_t(bundle.m_shearRow[s]);
				const double coupling = input.m_couplings[size_t(bundle.m_firstCoupling + i)].m_shear[s];
				targets[fibre] += coupling * m_first.m_impulses[shear];
				targets[shear] += coupling * m_first.m_impulses[fibre];
			}
	}
	m_second = m_first;
	for (const SystemInput::Unit& unit : input.m_units)
		for (size_t r = size_t(unit.m_firstRow); !stays(unit) && r < size_t(unit.m_firstRow + unit.m_numRows); ++r)
		{
			SystemInput::Bounded& row = input.m_rows[r];
			row.m_target = targets[r];
			row.m_lower = -BOUNDLESS;
			row.m_upper = BOUNDLESS;
			m_second.m_bounds[r] = 0;
		}
}

/// \param push  of joined bodies, by the system's bodies: motion of their places by contacts that are not in the system; empty: none
/// \return false if joined bodies have to wait
bool Recovery::solveJoined(System& system, SystemInput& input, const std::vector<double>& push)
{
	m_first = system.getResult();
	input.m_rows = m_rows;
	stiffen(system, input);
	system.setResult(m_second);
	system.beginAside();
	for (const JoinedContact& contact : m_joined)
	{
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
	system.endAside();
	return isSolved;
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
