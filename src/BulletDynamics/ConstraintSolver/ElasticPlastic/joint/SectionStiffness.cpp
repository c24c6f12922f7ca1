// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "SectionStiffness.h"

namespace btElasticPlastic
{
namespace
{
/// What is left of a stiffness when what the others take is taken off, over itself: less is rounding.
const double LEAST_REST = 1e-9;
}  // namespace

/// By elimination: first of the elongation, then of the turn about y, then of that about z.
SectionCompliance SectionStiffness::invert() const
{
	SectionCompliance c;
	if (!(m_axial > 0))
		return c;
	// About the middle of stiffness.
	const double z = cancelledProduct(m_mixed[0], m_axial, m_turns[0]) / m_axial,
				 y = -cancelledProduct(m_mixed[1], m_axial, m_turns[1]) / m_axial, zz = m_turns[0] - m_axial * z * z,
				 yy = m_turns[1] - m_axial * y * y,
				 zy = -cancelledProduct(m_mixed[2], m_turns[0], m_turns[1]) - m_axial * z * y;
	const bool turnsY = zz > LEAST_REST * m_turns[0];
	const double rest = yy - (turnsY ? zy * zy / zz : 0);
	const bool turnsZ = rest > LEAST_REST * m_turns[1];
	if (turnsY)
		c.m_turns[0] = 1 / zz;
	if (turnsZ)
	{
		const double share = turnsY ? zy / zz : 0;
		c.m_turns[1] = 1 / rest;
		c.m_turns[0] += share * share / rest;
		c.m_mixed[2] = share / rest;
	}
	// A moment about the joint's axis is one about that middle, and so is what an axial force at the joint makes.
	c.m_mixed[0] = -z * c.m_turns[0] + y * c.m_mixed[2];
	c.m_mixed[1] = -z * c.m_mixed[2] + y * c.m_turns[1];
	c.m_axial = 1 / m_axial - z * c.m_mixed[0] + y * c.m_mixed[1];
	return c;
}
}  // namespace btElasticPlastic
