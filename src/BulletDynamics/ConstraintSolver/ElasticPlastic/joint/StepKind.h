// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STEP_KIND_H
#define BT_ELASTIC_PLASTIC_STEP_KIND_H

#include "LinearMath/btScalar.h"

namespace btElasticPlastic
{
/// Which step of an island is solved.
struct StepKind
{
	btScalar m_share;  ///< of the world's step: 1, or less of an inner one
	/// Whether waves and swings count for more than that what the step does not resolve calms down at once: rows that it does not resolve well, and
	/// fibres, are damped by mode. By row a slow swing goes with the stiff rows that it passes, and the damage that it would do.
	bool m_keepsSwings;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_STEP_KIND_H
