// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "compute/Computation.h"

#include <algorithm>
#include <cmath>

#include "compute/Methods.h"
#ifdef EP_WITH_ODE
#include "compute/OdeEngine.h"
#endif
#include "trials/Catalogue.h"

namespace ep
{
namespace
{
const Precision PRECISION = sizeof(btScalar) == sizeof(double) ? Precision::Double : Precision::Float;
}  // namespace

std::vector<Record> compute(const Problem& problem, const ComputationSettings& s)
{
	std::vector<Setting> settings = settingsToCompare(s.rate, s.substeps, problem.hasFibres, s.quick);
#ifdef EP_WITH_ODE
	for (const Setting& setting : odeSettings(problem.name, s.rate, s.substeps, s.quick))
		settings.push_back(setting);
#endif
	Stepping stepping;
	stepping.step = 1. / s.rate;
	stepping.substeps = s.substeps;
	std::vector<Outcome> outcomes(settings.size());
	std::vector<std::vector<double>> times(settings.size());
	for (int round = 0; round < s.repeats; ++round)
		for (size_t i = 0; i < settings.size(); ++i)
		{
			// What takes long needs no median.
			if (round > 0 && times[i][0] > 0.3)
				continue;
			stepping.error = settings[i].budget;
			outcomes[i] = problem.solve(settings[i].method, stepping);
			times[i].push_back(outcomes[i].runTime);
		}
	std::vector<Record> records;
	for (size_t i = 0; i < settings.size(); ++i)
	{
		std::sort(times[i].begin(), times[i].end());
		for (const Quantity& quantity : outcomes[i].quantities)
		{
			Record r;
			r.problem = problem.name;
			r.quantity = quantity.name;
			r.solver = settings[i].solver();
			r.scheme = settings[i].scheme;
			r.jointClass = settings[i].jointClass();
			r.precision = PRECISION;
			r.dt = stepping.step;
			r.substeps = stepping.substeps;
			r.iterations = settings[i].method.iterations;
			r.budget = settings[i].budget;
			r.value = quantity.value;
			r.exact = quantity.exact;
			r.error = quantity.error();
			r.runTime = times[i][times[i].size() / 2];
			r.spread = times[i].size() > 1 ? (times[i].back() - times[i].front()) / r.runTime : NAN;
			r.simulated = outcomes[i].simulated;
			r.steps = outcomes[i].substeps;
			r.energyAudit = outcomes[i].energyCreated;
			records.push_back(r);
		}
	}
	return records;
}

std::vector<TrialRecord> computeTrials()
{
	std::vector<TrialRecord> records;
	for (const Trial& trial : stabilityTrials())
		for (const Solver solver : {Solver::Direct, Solver::Iterative, Solver::Stock})
			for (const JointClass jointClass : {JointClass::Spring2, JointClass::Spring})
			{
				Method method(solver);
				method.jointClass = jointClass;
				const Verdict v = trial.run(method);
				records.push_back({trial.group, trial.name, reportSolverOf(solver), jointClass, PRECISION,
								   v.complaint(), v.value, v.exact, std::max(v.created, v.createdByJoints), v.runTime});
			}
	return records;
}
}  // namespace ep
