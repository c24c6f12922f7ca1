// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_REPORT_METHODS_H
#define EP_REPORT_METHODS_H

#include <vector>

#include "collect/Choices.h"
#include "world/World.h"

namespace ep
{
/// What a problem is computed by.
struct Setting
{
	Method method;
	Scheme scheme;
	double budget = 0;                        ///< above 0: substeps by btElasticPlasticStepControl for this error
	std::optional<ReportSolver> engine = {};  ///< another engine's solver; none: the method's

	ReportSolver solver() const { return engine ? *engine : reportSolverOf(method.solver); }
	std::optional<JointClass> jointClass() const
	{
		return engine ? std::nullopt : std::optional<JointClass>(method.jointClass);
	}
};

/// Of iterative solvers.
/// \param quick  one only
std::vector<int> iterationsToCompare(int stepsPerSecond, bool quick);

/// What the report compares in a case of the given step. At 1/60 s also what the profile makes of it for several budgets,
/// and at 1/480 s, as 8 substeps, the direct solver without each of its parts, and with fewer and more fibres.
/// \param hasFibres  whether the problem has sections that are cut into fibres
/// \param quick  one of each kind only
std::vector<Setting> settingsToCompare(int rate, int substeps, bool hasFibres, bool quick);
}  // namespace ep

#endif  // EP_REPORT_METHODS_H
