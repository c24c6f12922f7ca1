// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_COMPARISON_H
#define EP_COMPARISON_H

#include <string>

#include "simulation/Demolisher.h"

namespace ep
{
/// What a kind of joint and a solver cost and get wrong on the same bridge.
struct Comparison
{
	JointKind kind;
	Solver solver;
	double sag;       ///< of the bridge at rest [m]
	double exactSag;  ///< that it should have [m]
	double stepTime;  ///< of the crossing, per step with its substeps [s]
	DemolisherSummary end;
};

/// One of them: the bridge comes to rest, then the autopilot drives across.
Comparison compare(const DemolisherSettings& settings, const JointKind& kind, Solver solver);

/// All kinds, each with the solvers that make a difference to it, and how fast each scene is, as text in Markdown.
std::string comparisonTables(const DemolisherSettings& settings);
}  // namespace ep

#endif  // EP_COMPARISON_H
