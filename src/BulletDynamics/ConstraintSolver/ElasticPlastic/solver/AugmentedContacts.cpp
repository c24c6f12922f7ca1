// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "AugmentedContacts.h"

#include <math.h>

#include <algorithm>

namespace btElasticPlastic
{
namespace
{
// What a loop leaves of a contact's slip is about c / (c + A), with A of the contact in the structure. Where a light foot may
// carry thousands of times its weight that is nearly all of it: contacts that hardly gain after some loops are made harder. All
// of them from the start would make Newton crawl from one to the next.
const int PATIENT_LOOPS = 4;          // in which a contact may gain little
const double LITTLE_GAIN = 0.5;       // a loop leaves more of the slip than this
const double HARDENING = 0.1;         // of the softening, what is left when a contact is made harder
const double LEAST_SOFTENING = 1e-6;  // of the softening at the beginning
/// Change of friction's bounds that matters, of the strongest one.
const double FRICTION_TOLERANCE = 0.01;
}  // namespace

bool AugmentedContacts::begin(SystemInput& input, const BoxLaw& law)
{
	bool hasContacts = false;
	m_states.assign(input.m_singleRows.size(), State());
	for (size_t i = 0; i < m_states.size(); ++i)
	{
		const SystemInput::SingleRow& row = input.m_singleRows[i];
		if (!row.m_isContact)
			continue;
		hasContacts = true;
		m_states[i].m_target = input.m_rows[row.m_row].m_target;
		m_states[i].m_softening = row.m_softening;
		m_states[i].m_leastSoftening = LEAST_SOFTENING * row.m_softening;
	}
	if (hasContacts)
		tighten(input, law, 0, 0);
	return hasContacts;
}

AugmentedContacts::Progress AugmentedContacts::tighten(SystemInput& input, const BoxLaw& law, int loop, double tolerance)
{
	Progress progress;
	// Where nothing moves, and nothing rubs, rounding is measured by these.
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
		const double rest = state.m_softening * fabs(law.getImpulse(r) - state.m_multiplier);
		slip = std::max(slip, rest);
		state.m_multiplier = law.getImpulse(r);
		if (loop > PATIENT_LOOPS && rest > LITTLE_GAIN * state.m_slip && rest > tolerance * fastest &&
			state.m_softening > state.m_leastSoftening)
		{
			row.m_compliance -= (1 - HARDENING) * state.m_softening;
			state.m_softening *= HARDENING;
			progress.m_hasChangedMatrix = true;
		}
		state.m_slip = rest;
		row.m_target = state.m_target + state.m_softening * state.m_multiplier;
	}
	for (const SystemInput::SingleRow& friction : input.m_singleRows)
	{
		if (friction.m_normal < 0)
			continue;
		SystemInput::Bounded& row = input.m_rows[friction.m_row];
		double bound =
			friction.m_friction * std::max(0., law.getImpulse(input.m_singleRows[friction.m_normal].m_row));
		if (friction.m_frictionMax > 0)
			bound = std::min(bound, friction.m_frictionMax);
		frictionChange = std::max(frictionChange, fabs(bound - row.m_upper));
		strongest = std::max(strongest, bound);
		row.m_upper = bound;
		row.m_lower = -bound;
	}
	progress.m_isOpen = slip > tolerance * fastest || frictionChange > FRICTION_TOLERANCE * strongest;
	return progress;
}
}  // namespace btElasticPlastic
