// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SOLVER_H
#define BT_ELASTIC_PLASTIC_SOLVER_H

#include "btElasticPlasticPrecision.h"
#include "btElasticPlasticSolverSettings.h"
#include "btElasticPlasticStatistics.h"

namespace btElasticPlastic
{
class SolverWorks;
}

/// What the solvers for rigid bodies and for multibodies have in common: settings and statistics.
class btElasticPlasticSolver
{
public:
	btElasticPlasticSolver(const btElasticPlasticSolver&) = delete;
	btElasticPlasticSolver& operator=(const btElasticPlasticSolver&) = delete;

	/// All settings at once, between steps. \return false, with a message on the standard error output, and everything stays as it
	/// was, if one is out of its range (see btElasticPlasticSolverSettings::fault).
	bool setSettings(const btElasticPlasticSolverSettings& settings);
	const btElasticPlasticSolverSettings& getSettings() const;

	/// Change one setting; the others stay as they are. \return as setSettings()
	bool setForm(btElasticPlasticForm form);
	bool setNumThreads(int threads);
	btElasticPlasticForm getForm() const { return getSettings().m_form; }
	int getNumThreads() const { return getSettings().m_numThreads; }

	/// Of the direct form, summed since resetStatistics().
	const btElasticPlasticStatistics& getStatistics() const;
	void resetStatistics();

protected:
	btElasticPlasticSolver(btElasticPlasticOwnPrecision = {});
	~btElasticPlasticSolver();

	btElasticPlastic::SolverWorks* const m_works;
};

#endif  // BT_ELASTIC_PLASTIC_SOLVER_H
