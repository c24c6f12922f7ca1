// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STEP_PART_H
#define BT_ELASTIC_PLASTIC_STEP_PART_H

#include "LinearMath/btScalar.h"

namespace btElasticPlastic
{
/// The part of a step of the world that is solved: all of it, or an inner step.
struct StepPart
{
	btScalar m_share;  ///< of the world's step

	/// How many parts as long as this one recover their penetration in it. The first inner step does it for all: each recovery is a second
	/// solution, and no place is the better for it if it moves bit by bit.
	btScalar m_recovery;

	static StepPart whole() { return {1, 1}; }
	static StepPart first(btScalar share) { return {share, 1 / share}; }
	static StepPart later(btScalar share) { return {share, 0}; }
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_STEP_PART_H
