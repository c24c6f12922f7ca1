// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SYSTEM_H
#define BT_ELASTIC_PLASTIC_SYSTEM_H

#include <memory>
#include <vector>

#include "../../btElasticPlasticSolverSettings.h"
#include "AugmentedContacts.h"
#include "AdmissibleBox.h"
#include "Condensation.h"
#include "InteriorPoint.h"
#include "SystemInput.h"
#include "SystemMatrix.h"
#include "WorkingSet.h"

namespace btElasticPlastic
{
/// The solution of a System.
struct SystemResult
{
	std::vector<double> m_velocity;     ///< dv, 6 by body
	std::vector<double> m_impulses;     ///< by row
	std::vector<signed char> m_bounds;  ///< by row: -1 at the lower, 1 at the upper bound, 0 between
};

/// A velocity-level problem of bodies and bounded, compliant rows, solved directly.
///
/// Find the change of velocity dv and impulses lambda with
///
///     M dv = sum J^T lambda,   J dv + C lambda = b  where lambda is inside its bounds, else lambda at the bound.       (1)
///
/// With lambda(u) = psi'(u) = clamp(u / C, lower, upper), (1) says that dv minimises the convex function
///
///     phi(dv) = 1/2 dv^T M dv + sum psi(b - J dv),   gradient  M dv - sum J^T lambda(b - J dv),                   (2)
///
/// whose Hessian is H = M + sum J^T (d lambda / du) J: symmetric positive definite, one 6x6 block per body and per pair of
/// joined bodies. Semismooth Newton with a line search, begun at the solution for the last step's set of bounded rows
/// (begun with none it would have to find that set step by step), ends after 1 to 3 factorisations where few rows reach or
/// leave a bound in a step. Where some dozens do, a WorkingSet finds them with the first factor. Where hundreds do, steps become short:
/// then InteriorPoint comes close to the solution, and Newton's method ends the search from there. Loops around it make contacts hard, see AugmentedContacts.
///
/// In a large problem the search runs in the places only where something happens, see Condensation.
///
/// A search that is cut gives impulses within their bounds all the same, see settle().
class System
{
public:
	enum
	{
		FEW_BODIES = 30  ///< with so many a step of the search costs little, and the exactness of contacts counts more
	};

	/// \param buffers  see LinearSolver
	explicit System(btElasticPlasticStatistics& statistics, BufferPool* buffers = nullptr);
	~System();

	/// How exactly a problem is solved.
	enum Effort
	{
		/// By a few Newton steps; where they do not converge, impulses that obey the law and gain no energy. Between sweeps of contacts.
		ROUGH,
		PLAIN,  ///< by Newton's method alone, contacts as soft as they begin; gives up where its steps become short
		EXACT
	};

	void setSettings(const btElasticPlasticSolverSettings& settings);

	/// The most work of the next solution, as btElasticPlasticSolverSettings::m_maxWork.
	void setMaxWork(long long work) { m_settings.m_maxWork = work; }

	/// Ages the plans and factors that are kept from step to step.
	void beginStep(bool isOneOfMany);

	/// Solves a problem. The targets, compliances and bounds of contacts' rows in the input are changed.
	/// \param islandId  the id that the last solution of the same island has left here, 0: none; gets the id for the next one
	/// \param numSolutions  about how often solveAgain() will follow, this one included
	/// \return false if the solution is not a number: then no velocity is
	bool solve(SystemInput& input, int& islandId, Effort effort, int numSolutions = 1);

	/// Solves the last problem again with other targets and bounds, from its solution on.
	/// \return as solve(); false, too, if the effort was PLAIN and it was given up: then the result means nothing
	bool solveAgain(SystemInput& input, Effort effort);

	/// Between these two solutions have other compliances of rows that are not elsewhere. What is elsewhere stays condensed, and the factor
	/// of before is kept if no other has been needed.
	void beginAside();
	void endAside();

	/// Whether a row is far from where a large problem is being searched: taken as linear, and condensed.
	bool isElsewhere(int row) const;

	/// Whether the last search was cut.
	bool isCut() const { return m_isCut; }

	/// Whether Newton's method alone has not solved the last problem.
	bool isHard() const { return m_isHard; }

	/// What the last solution makes of energy, by the sum that it minimises: 1/2 lambda^T (A + C) lambda - b^T lambda.
	double findMade(const SystemInput& input);

	SystemResult getResult() const;
	void setResult(const SystemResult& result);

	// The result, by body and by row.

	/// dv of a body, 6 doubles
	const double* getVelocityChange(int body) const { return &m_velocity[6 * size_t(body)]; }
	double getImpulse(int row) const { return m_admissible.getImpulse(row); }
	/// From a row on.
	const double* getImpulses(int row) const { return m_admissible.getImpulses(row); }
	/// -1 at the lower, 1 at the upper bound, 0 between; from a row on.
	const signed char* getBounds(int row) const { return m_admissible.getBounds(row); }

private:
	void forgetFactor();
	bool search(SystemInput& input, Effort effort);
	bool isLarge(const SystemInput& input) const;
	enum Found
	{
		SOLVED,
		GAVE_UP,   ///< with PLAIN effort
		ELSEWHERE  ///< happens everywhere: the whole has to be searched
	};
	Found searchInside(SystemInput& input, Effort effort);
	void findPlaces(const SystemInput& input, std::vector<int>& bodies) const;
	bool finish();
	bool guess(const SystemInput& input);
	bool isRight(const SystemInput& input);
	bool mayUseSets(const SystemInput& input) const;
	bool findBounds(const SystemInput& input);
	bool isExact(const SystemInput& input);
	bool findMinimum(SystemInput& input, Effort effort);
	bool newton(const SystemInput& input, bool mayCrawl, int maxSteps);
	void releaseFriction(SystemInput& input);
	/// Of impulses: b^T lambda, and lambda^T (A + C) lambda.
	struct Work
	{
		double m_gain = 0, m_cost = 0;
		double made() const { return m_cost / 2 - m_gain; }
	};

	Work findWork(const SystemInput& input, const std::vector<double>& impulses);
	void settle(const SystemInput& input, std::vector<double> impulses);
	void evaluate(const SystemInput& input);
	bool isSpent(long long nextWork = 1) const
	{
		return m_settings.m_maxWork > 0 && m_statistics.m_work + nextWork > m_workEnd;
	}
	double findResidual(const SystemInput& input);
	bool solveLinear(const SystemInput& input, std::vector<double>& x);
	void move(double length);
	double exactLength(const SystemInput& input);

	btElasticPlasticSolverSettings m_settings;
	btElasticPlasticStatistics& m_statistics;
	LinearSolver m_linearSolver;
	SystemMatrix m_matrix;
	AdmissibleBox m_admissible;
	AugmentedContacts m_contacts;
	InteriorPoint m_interior;
	WorkingSet m_workingSet;
	double m_phiTerms = 0;    // sum of the absolute values of phi's terms
	long long m_workEnd = 0;  // of the statistics' count, at which this island's is spent
	/// Where something happens in a large problem; null in the problem inside.
	struct Place;
	std::unique_ptr<Place> m_place;
	std::vector<double> m_impulsesBefore;  // of the last solution of the same problem, empty: there is none
	SystemResult m_before;                 // a large problem's rows' impulses and bounds before the search
	std::vector<SystemInput::Bounded> m_singleRowsBefore;
	bool m_insideHasSolved = false, m_isCut = false;
	bool m_expectsPlaces = false;  // of the problem that is being solved
	int m_searchedInside = 0;      // the island of the last problem, if it was searched in places
	bool m_interiorHasSolved = false, m_isHard = false, m_hasSearched = false;
	bool m_boundsChanged = false;  // by the last evaluate()
	/// Of a solution between beginAside() and endAside().
	enum Aside
	{
		NOT_ASIDE,
		WITHOUT_FACTOR,  ///< the factor of before is still there
		WITH_FACTOR      ///< of its own
	} m_aside = NOT_ASIDE;
	bool m_matrixIsCurrent = false;  // H belongs to the rows' present bounds
	std::vector<double> m_velocity;  // dv
	std::vector<double> m_residual;  // -gradient of (2) at dv
	std::vector<double> m_step;
	std::vector<double> m_start;
	std::vector<double> m_work;
	std::vector<double> m_along, m_alongStart;  // J times something, by row
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SYSTEM_H
