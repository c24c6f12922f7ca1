// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "AugmentedContacts.h"

#include <math.h>

#include <algorithm>

namespace btElasticPlastic
{
namespace
{
// A loop leaves about c / (c + A) of a contact's slip, where A is that of the contact within the structure. Where a light
// foot carries thousands of times its weight, that is nearly all of it. Contacts that improve little after some loops are
// therefore made harder. If all of them were as hard from the start, Newton's method would need many steps.
const int PATIENT_LOOPS = 4;          // the first loops, in which a contact may improve little
const double LITTLE_GAIN = 0.5;       // a contact improves little if a loop leaves more than this share of its slip
const double HARDENING = 0.1;         // the share of the softening that is left when a contact is made harder
const double LEAST_SOFTENING = 1e-6;  // the least softening, as a share of the first one
/// Beyond so many times the momentum of all bodies at the fastest approach no contact is made harder: what is between two bodies that close on each other
/// whatever it does, a plate that is driven down and the ground, has contacts that no impulse fulfils, and they would only grow, by a million times.
const double MOST_IMPULSE = 100;
/// The change of a friction bound that asks for another loop, as a share of the largest bound.
const double FRICTION_TOLERANCE = 0.01;
/// The least compliance of a hard row, as a share of its softened one.
const double HARDEST = 1e-10;

/// Of all bodies, those included that have been eliminated [kg].
double massOf(const SystemInput& input)
{
	double mass = 0;
	for (const SystemInput::Body& body : input.m_bodies)
		mass += body.m_mass[0];
	const size_t order = 6 * input.m_condensed.m_bodies.size();
	for (size_t i = 0; i < order; i += 6)
		mass += input.m_condensed.m_matrix[i * order + i];
	return mass;
}
}  // namespace

void AugmentedContacts::begin(SystemInput& input, const AdmissibleBox& box)
{
	m_isAny = m_hasHardened = false;
	m_states.assign(input.m_singleRows.size(), State());
	for (size_t i = 0; i < m_states.size(); ++i)
	{
		const SystemInput::SingleRow& row = input.m_singleRows[i];
		if (!row.m_isContact)
			continue;
		m_isAny = true;
		m_states[i].m_target = input.m_rows[row.m_row].m_target;
		m_states[i].m_softening = row.m_softening;
		m_states[i].m_leastSoftening = LEAST_SOFTENING * row.m_softening;
	}
	if (!m_isAny)
		return;
	double fastest = 0;
	for (const State& state : m_states)
		fastest = std::max(fastest, state.m_target);
	m_mostImpulse = MOST_IMPULSE * massOf(input) * fastest;
	tighten(input, box, 0, 0);
}

AugmentedContacts::Progress AugmentedContacts::tighten(SystemInput& input, const AdmissibleBox& box, int loop,
													   double tolerance)
{
	Progress progress;
	// The least scales of velocity and friction, so that rounding counts for nothing where nothing moves.
	double fastest = 1e-9, strongest = 1e-12;
	double slip = 0, frictionChange = 0;
	for (size_t i = 0; i < m_states.size(); ++i)
		if (input.m_singleRows[i].m_isContact)
			fastest = std::max(fastest, fabs(m_states[i].m_target));
	for (size_t i = 0; i < m_states.size(); ++i)
	{
		if (!input.m_singleRows[i].m_isContact)
			continue;
		State& state = m_states[i];
		const int r = input.m_singleRows[i].m_row;
		SystemInput::Bounded& row = input.m_rows[r];
		const double rest = state.m_softening * fabs(box.getImpulse(r) - state.m_multiplier);
		slip = std::max(slip, rest);
		state.m_multiplier = box.getImpulse(r);
		const bool isStuck = loop > PATIENT_LOOPS && rest > LITTLE_GAIN * state.m_slip && rest > tolerance * fastest;
		if (isStuck && state.m_multiplier < m_mostImpulse && state.m_softening > state.m_leastSoftening)
		{
			row.m_compliance -= (1 - HARDENING) * state.m_softening;
			state.m_softening *= HARDENING;
			progress.m_hasChangedMatrix = m_hasHardened = true;
		}
		state.m_slip = rest;
		row.m_target = state.m_target + state.m_softening * state.m_multiplier;
	}
	for (const SystemInput::SingleRow& friction : input.m_singleRows)
	{
		if (friction.m_normal < 0)
			continue;
		SystemInput::Bounded& row = input.m_rows[friction.m_row];
		const double bound =
			friction.getFrictionBound(std::max(0., box.getImpulse(input.m_singleRows[friction.m_normal].m_row)));
		frictionChange = std::max(frictionChange, fabs(bound - row.m_upper));
		strongest = std::max(strongest, bound);
		row.m_upper = bound;
		row.m_lower = -bound;
	}
	progress.m_isOpen = slip > tolerance * fastest || frictionChange > FRICTION_TOLERANCE * strongest;
	return progress;
}

bool AugmentedContacts::releaseFriction(SystemInput& input, const AdmissibleBox& box) const
{
	bool isAny = false;
	for (const SystemInput::SingleRow& friction : input.m_singleRows)
	{
		if (friction.m_normal < 0 || box.getImpulse(friction.m_row) == 0 ||
			box.getImpulse(input.m_singleRows[size_t(friction.m_normal)].m_row) > 0)
			continue;
		SystemInput::Bounded& row = input.m_rows[size_t(friction.m_row)];
		row.m_lower = row.m_upper = 0;
		isAny = true;
	}
	return isAny;
}

SystemInput::Bounded AugmentedContacts::getHardRow(const SystemInput& input, int singleRow) const
{
	const State& state = m_states[size_t(singleRow)];
	SystemInput::Bounded row = input.m_rows[size_t(input.m_singleRows[size_t(singleRow)].m_row)];
	row.m_target = state.m_target;
	row.m_compliance = std::max(row.m_compliance - state.m_softening, HARDEST * row.m_compliance);
	return row;
}

void AugmentedContacts::setMultipliers(SystemInput& input, const std::vector<double>& impulses,
									   const std::vector<double>& upperBounds)
{
	for (size_t i = 0; i < m_states.size(); ++i)
	{
		const SystemInput::SingleRow& contact = input.m_singleRows[i];
		if (!contact.m_isContact)
			continue;
		SystemInput::Bounded& row = input.m_rows[size_t(contact.m_row)];
		State& state = m_states[i];
		state.m_multiplier = impulses[size_t(contact.m_row)];
		if (contact.m_normal >= 0)
		{
			row.m_upper = upperBounds[size_t(contact.m_row)];
			row.m_lower = -row.m_upper;
		}
		row.m_target = state.m_target + state.m_softening * state.m_multiplier;
	}
}

void AugmentedContacts::addWork(const SystemInput& input, const std::vector<double>& impulses, double& gain,
								double& cost) const
{
	const auto add = [&](const SystemInput::Bounded& row, double impulse)
	{
		gain += row.m_target * impulse;
		cost += row.m_compliance * impulse * impulse;
		if (row.m_partner >= 0)
			cost += row.m_coupling * impulse * impulses[size_t(row.m_partner)];
	};
	for (const SystemInput::Unit& unit : input.m_units)
		for (int r = unit.m_firstRow; r < unit.m_firstRow + unit.m_numRows; ++r)
			add(input.m_rows[size_t(r)], impulses[size_t(r)]);
	for (const SystemInput::Bundle& bundle : input.m_bundles)
		cost += 2 * input.getCouplingEnergy(bundle, impulses);
	for (int i = 0; i < input.getNumSingleRows(); ++i)
	{
		const SystemInput::SingleRow& row = input.m_singleRows[size_t(i)];
		add(row.m_isContact ? getHardRow(input, i) : input.m_rows[size_t(row.m_row)], impulses[size_t(row.m_row)]);
	}
}
}  // namespace btElasticPlastic
