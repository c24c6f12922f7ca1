// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticSolver.h"

#include <stdio.h>

#include "ElasticPlastic/solver/SolverWorks.h"

btElasticPlasticSolver::btElasticPlasticSolver(btElasticPlasticOwnPrecision)
	: m_works(new btElasticPlastic::SolverWorks)
{
}
btElasticPlasticSolver::~btElasticPlasticSolver() { delete m_works; }

bool btElasticPlasticSolver::setSettings(const btElasticPlasticSolverSettings& settings)
{
	if (const btElasticPlasticFault fault = settings.fault())
	{
		char text[192];
		fault.print(text, sizeof text);
		fprintf(stderr, "Bullet Elastic-Plastic refused the solver's settings: %s\n", text);
		return false;
	}
	m_works->setSettings(settings);
	return true;
}

const btElasticPlasticSolverSettings& btElasticPlasticSolver::getSettings() const { return m_works->getSettings(); }

bool btElasticPlasticSolver::setForm(btElasticPlasticForm form)
{
	btElasticPlasticSolverSettings settings = getSettings();
	settings.m_form = form;
	return setSettings(settings);
}

bool btElasticPlasticSolver::setNumThreads(int threads)
{
	btElasticPlasticSolverSettings settings = getSettings();
	settings.m_numThreads = threads;
	return setSettings(settings);
}

const btElasticPlasticStatistics& btElasticPlasticSolver::getStatistics() const { return m_works->getStatistics(); }

void btElasticPlasticSolver::resetStatistics() { m_works->getStatistics() = btElasticPlasticStatistics(); }
