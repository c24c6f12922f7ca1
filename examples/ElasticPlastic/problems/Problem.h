// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PROBLEM_H
#define EP_PROBLEM_H

#include <algorithm>
#include <string>
#include <vector>

#include "world/World.h"

namespace ep
{
/// What a problem is judged by.
struct Quantity
{
	std::string name;  ///< with its unit
	double value, exact;

	/// Relative error; infinite where there is no number.
	double error() const;
};

/// What a method makes of a problem.
struct Outcome
{
	std::vector<Quantity> quantities;
	double runTime = 0;        ///< of the steps alone [s]
	double simulated = 0;      ///< [s]
	int substeps = 0;          ///< that were taken
	double energyCreated = 0;  ///< from nowhere, over all there is: EnergyAudit

	/// The quantity with the largest error.
	const Quantity& worst() const
	{
		return *std::max_element(quantities.begin(), quantities.end(),
								 [](const Quantity& a, const Quantity& b) { return a.error() < b.error(); });
	}
	double error() const { return worst().error(); }
};

/// How finely a problem is stepped.
struct Stepping
{
	double step = 1. / 60;  ///< [s]
	int substeps = 1;
	double error = 0;  ///< above 0: as many substeps as btElasticPlasticStepControl takes for this error
	Watch watch = {};  ///< after each substep
};

/// A reference problem with an exact answer.
struct Problem
{
	const char* name;
	const char* what;
	const char* source;  ///< of the exact answer
	Outcome (*solve)(const Method& method, const Stepping& stepping);
	/// Whether forces act together in sections that are cut into fibres, as many as the method says.
	bool hasFibres = false;
};
}  // namespace ep

#endif  // EP_PROBLEM_H
