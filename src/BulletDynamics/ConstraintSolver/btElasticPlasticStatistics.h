// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STATISTICS_H
#define BT_ELASTIC_PLASTIC_STATISTICS_H

/// The cost of direct solutions, summed over calls. Reset the sums before a step to read the cost of that step.
struct btElasticPlasticStatistics
{
	long long m_islands = 0;
	long long m_rows = 0;  ///< those of contacts and of other constraints included
	long long m_newtonSteps = 0;
	long long m_interiorIterations = 0;  ///< of the interior point method, where Newton's steps become short
	long long m_cutSearches =
		0;  ///< searches that ended before they had converged: their impulses obey the law all the same
	long long m_analyses = 0;  ///< of islands whose graph was new
	long long m_factorisations = 0;
	long long m_partialFactorisations = 0;  ///< those of them that computed only what had changed
	long long m_solutions = 0;              ///< with a factor
	long long m_iterations = 0;             ///< of conjugate gradients with the factor of an earlier step
	long long m_contactLoops = 0;
	long long m_looseContacts = 0;  ///< islands whose contacts were not exact when their loops ended
	long long m_fallbacks = 0;      ///< islands left to the iterative form: none any more, see m_cutSearches

	/// What solutions cost, counted and not timed, so that it is the same in every run: in nanoseconds of a processor of 3 GHz,
	/// roughly. Set-up of rows and sweeps of contacts are not part of it.
	long long m_work = 0;

	/// Inner steps of islands that have taken more than one in a step of the world, those that were found too long and taken again
	/// included. Each counts as an island above.
	long long m_innerSteps = 0;

	/// Islands, with the iterative form groups of them, of which no result was finite: it was not written, so their bodies have
	/// kept their velocities, and their joints their state.
	long long m_notFinite = 0;

	// Where the time went, if btElasticPlasticSolverSettings::m_measuresTime asks for it, else 0: of all threads together [s], by the wall clock: on a loaded machine that
	// of others is in it. m_work is not.
	double m_setUpTime = 0;     ///< joints' rows
	double m_analysisTime = 0;  ///< the graph, known or new
	double m_assemblyTime = 0;  ///< the matrix
	double m_factorisationTime = 0;
	double m_solutionTime = 0;  ///< with a factor, conjugate gradients included
	double m_searchTime = 0;    ///< impulses, bounds, line search, contact loops

	btElasticPlasticStatistics& operator+=(const btElasticPlasticStatistics& s)
	{
		m_islands += s.m_islands;
		m_rows += s.m_rows;
		m_newtonSteps += s.m_newtonSteps;
		m_interiorIterations += s.m_interiorIterations;
		m_cutSearches += s.m_cutSearches;
		m_analyses += s.m_analyses;
		m_factorisations += s.m_factorisations;
		m_partialFactorisations += s.m_partialFactorisations;
		m_solutions += s.m_solutions;
		m_iterations += s.m_iterations;
		m_contactLoops += s.m_contactLoops;
		m_looseContacts += s.m_looseContacts;
		m_fallbacks += s.m_fallbacks;
		m_work += s.m_work;
		m_innerSteps += s.m_innerSteps;
		m_notFinite += s.m_notFinite;
		m_setUpTime += s.m_setUpTime;
		m_analysisTime += s.m_analysisTime;
		m_assemblyTime += s.m_assemblyTime;
		m_factorisationTime += s.m_factorisationTime;
		m_solutionTime += s.m_solutionTime;
		m_searchTime += s.m_searchTime;
		return *this;
	}
};

#endif  // BT_ELASTIC_PLASTIC_STATISTICS_H
