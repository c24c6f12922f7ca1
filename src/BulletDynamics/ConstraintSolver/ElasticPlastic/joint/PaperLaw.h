// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_PAPER_LAW_H
#define BT_ELASTIC_PLASTIC_PAPER_LAW_H

#include "Law.h"

namespace btElasticPlastic
{
/// The paper's own law, kept as a baseline: wrong at many steps, see docs/theory.md. It has two forms, as the paper has two
/// classes.
struct PaperLaw
{
	enum Form
	{
		MOTOR,  ///< of its first class, Table IX
		SPRING  ///< of its second class, Table X
	};

	Form m_form;
	btScalar m_inverseMass;  ///< 1 / m of the lighter body, for a rotation 1 / I about the axis; only used by SPRING

	SoftRow row(const DofState& s, btScalar dt) const
	{
		return m_form == MOTOR ? motorRow(s, dt) : springRow(s, m_inverseMass, dt);
	}

	/// Return mapping of the deformation at the start of the step, as in the paper.
	ReturnMapping returnMap(const DofState& s, const RowOutcome& outcome, btScalar dt) const
	{
		const bool flows =
			btFabs(outcome.m_impulse) > btScalar(0.99999) * (s.m_yield * dt) && outcome.m_impulse * s.m_strain > 0;
		return btElasticPlastic::returnMap(s, s.m_strain, flows);
	}

	/// A velocity constraint capped at the spring's force, so it only ever brakes; the first step from rest is free.
	static SoftRow motorRow(const DofState& s, btScalar dt)
	{
		return brake(dt * btMin(s.m_yield, s.m_stiffness * btFabs(s.m_strain)));
	}

	/// Equation 16 asks whether sqrt(k / m_min) dt > 0.25. If so, a velocity constraint capped at yield without positional
	/// error; if not, the explicit spring.
	static SoftRow springRow(const DofState& s, btScalar inverseMass, btScalar dt)
	{
		if (s.m_stiffness * inverseMass * dt * dt <= btScalar(0.0625))
			return explicitRow(clampedForce(s), dt);
		return brake(dt * s.m_yield);
	}

private:
	static SoftRow brake(btScalar impulse)
	{
		SoftRow row;
		row.m_upper = impulse;
		row.m_lower = -impulse;
		return row;
	}
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_PAPER_LAW_H
