// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "System.h"

#include <math.h>

#include <algorithm>
#include <limits>

#include "../linear/ScopedTimer.h"
#include "Jacobian.h"

namespace btElasticPlastic
{
namespace
{
// ---- when the search ends, relative to the sum of the absolute values of phi's terms

/// A predicted gain below this is smaller than the rounding of phi.
const double ROUNDING = 1e-12;
/// The number of steps that are still made when the predicted gain is only rounding, for exactness. More would not help: rows
/// whose impulses differ from a bound by rounding may change sides for ever.
const int ROUNDING_STEPS = 3;
/// Hard rows make the step itself inexact: two sets of bounds may take turns a little above that. After so many steps below this
/// gain the last one is as good as any.
const double TURNING = 1e-10;
const int TURNING_STEPS = 10;

// ---- the line search

/// A full step is taken if it gains this share of what its slope promises (Armijo's rule), up to the rounding of phi.
const double SUFFICIENT_GAIN = 1e-4, PHI_ROUNDING = 1e-14;
/// The exact search ends at this share of the step, or when Newton's method has moved by less.
const double LENGTH_TOLERANCE = 1e-15, LENGTH_STEP = 1e-14;
/// The most iterations of the exact search; bisection alone would need 50.
const int MAX_LENGTH_STEPS = 60;

// ---- when Newton's method is left for the interior point method

/// A step of this share of its full length is short.
const double SHORT_STEP = 0.1;
/// After so many short ones, or so many steps of any length that did not end the search, there is no end in sight.
const int SHORT_STEPS = 2, PATIENCE = 5;
/// The same in an island of few bodies.
const int PATIENCE_WITH_FEW = 50;

// ---- when and where a search runs inside a place

/// Where a factor of the whole takes less, multiplications and additions, it costs little: a wall of 800 bodies, a cube of 350.
const int64_t MANY_OPERATIONS = 30000000;
/// How far from contacts and flowing rows a place reaches, how far it grows from a row outside that has reached a bound, and how
/// often it may.
const int RINGS = 6, RINGS_MORE = 4, MOST_PLACES = 4;

/// How often rows may join a working set, and how many guesses have sets.
const int MOST_TURNS = 16, MOST_GUESSES = 4;

/// Where contacts' loops have taken so many Newton steps, the interior point method takes over; the second number is for islands of few bodies.
const int MANY_STEPS = 15, MANY_STEPS_WITH_FEW = 50;

/// Nominal work of an evaluation by row, see btElasticPlasticStatistics::m_work.
const double EVALUATION_A_ROW = 8;

/// Numbers for which there is memory from the beginning, for the factor and the matrix of a structure of some 700 joints: 1.1 MB. The system's pages cost
/// more than what is computed in them, and a game's solver is made while it loads.
const size_t READY_FACTOR = 96 * 1024, READY_MATRIX = 44 * 1024;

/// A solution with a larger velocity [m/s], [rad/s] counts as no number.
const double FASTEST = 1e30;
}  // namespace

struct System::Place
{
	Condensation m_condensation;
	System m_inside;

	Place(btElasticPlasticStatistics& statistics, BufferPool* buffers)
		: m_condensation(statistics, buffers), m_inside(statistics, buffers)
	{
	}
};

System::System(btElasticPlasticStatistics& statistics, BufferPool* buffers)
	: m_statistics(statistics),
	  m_linearSolver(statistics, buffers),
	  m_matrix(m_linearSolver),
	  m_interior(statistics),
	  m_workingSet(statistics)
{
	if (buffers)
		return;
	m_linearSolver.getBuffers().reserve(READY_FACTOR);
	m_linearSolver.getBuffers().reserve(READY_MATRIX);
}

System::~System() = default;

void System::setSettings(const btElasticPlasticSolverSettings& settings)
{
	m_settings = settings;
	m_linearSolver.setSettings(settings);
	m_interior.measureTime(settings.m_measuresTime);
	m_workingSet.measureTime(settings.m_measuresTime);
	m_place.reset();
}

void System::beginStep(bool isOneOfMany)
{
	m_linearSolver.beginStep(isOneOfMany);
	if (!m_place)
		return;
	m_place->m_condensation.beginStep(isOneOfMany);
	m_place->m_inside.beginStep(isOneOfMany);
}

void System::forgetFactor()
{
	m_matrixIsCurrent = false;
	m_matrix.forget();
	m_linearSolver.forgetFactor();
}

void System::beginAside()
{
	m_aside = WITHOUT_FACTOR;
	m_matrixIsCurrent = false;
}

void System::endAside()
{
	if (m_aside == WITH_FACTOR)
		forgetFactor();
	m_aside = NOT_ASIDE;
}

bool System::isElsewhere(int row) const
{
	return m_place && !m_place->m_condensation.isEmpty() && !m_place->m_condensation.isRowInside(row);
}

/// x = H^-1 x for the rows' present bounds.
bool System::solveLinear(const SystemInput& input, std::vector<double>& x)
{
	if (m_aside == WITHOUT_FACTOR)
	{
		m_aside = WITH_FACTOR;
		forgetFactor();
	}
	if (!m_matrixIsCurrent)
	{
		const ScopedTimer timer("elastic-plastic assemble", m_statistics.m_assemblyTime, m_settings.m_measuresTime);
		m_matrix.assemble(input, m_admissible);
		m_matrixIsCurrent = true;
	}
	return m_linearSolver.solve(x);
}

// ---- the function

/// Impulses and bounds of all rows at dv.
void System::evaluate(const SystemInput& input)
{
	const ScopedTimer timer("elastic-plastic search", m_statistics.m_searchTime, m_settings.m_measuresTime);
	m_statistics.m_work += (long long)(EVALUATION_A_ROW * double(input.getNumRows()));
	project(input, m_velocity, m_along);
	m_boundsChanged = m_admissible.project(input, m_along);
	if (m_boundsChanged)
		m_matrixIsCurrent = false;
}

/// The residual that belongs to the last evaluate(). \return phi
double System::findResidual(const SystemInput& input)
{
	const ScopedTimer timer("elastic-plastic search", m_statistics.m_searchTime, m_settings.m_measuresTime);
	double phi = 0;
	m_phiTerms = 0;
	m_admissible.addPotential(input, m_along, phi, m_phiTerms);
	multiplyMass(input, m_velocity, m_residual);
	for (size_t i = 0; i < m_residual.size(); ++i)
	{
		const double term = 0.5 * m_velocity[i] * m_residual[i];
		phi += term;
		m_phiTerms += fabs(term);
		m_residual[i] = -m_residual[i];
	}
	addImpulses(input, m_admissible.getImpulses(0), m_residual);
	const SystemInput::Condensed& condensed = input.m_condensed;
	for (size_t i = 0; i < condensed.m_momentum.size(); ++i)
	{
		const double term = m_velocity[6 * size_t(condensed.m_bodies[i / 6]) + i % 6] * condensed.m_momentum[i];
		phi -= term;
		m_phiTerms += fabs(term);
	}
	addCondensedMomentum(input, m_residual);
	return phi;
}

// ---- the search

/// dv for the rows' present bounds as if they were right.
bool System::guess(const SystemInput& input)
{
	m_admissible.holdBounds(input);
	std::fill(m_velocity.begin(), m_velocity.end(), 0.);
	addImpulses(input, m_admissible.getImpulses(0), m_velocity);
	addCondensedMomentum(input, m_velocity);
	if (!solveLinear(input, m_velocity))
		return false;
	if (mayUseSets(input))
		m_workingSet.begin(m_admissible, m_velocity);
	return true;
}

/// Whether a guess is right: no bound changes at the dv that solves the linear problem for the guessed ones exactly.
bool System::isRight(const SystemInput& input)
{
	evaluate(input);
	return !m_boundsChanged;
}

/// Where a factor costs next to nothing, Newton's steps do, too; a large problem has places instead.
bool System::mayUseSets(const SystemInput& input) const { return input.getNumBodies() > FEW_BODIES && !isLarge(input); }

/// Finds the bounds by working sets, after a guess() that was not right. If that fails, all is as it was before.
bool System::findBounds(const SystemInput& input)
{
	const std::vector<double> first = m_velocity;
	m_hasSearched = true;
	for (int k = 0; k < MOST_GUESSES; ++k)
	{
		// Where a set has become too large, its bounds are the next guess.
		if (k > 0 && !guess(input))
			break;
		if (k > 0 && isRight(input))
			return true;
		int turn = 0;
		for (; turn < MOST_TURNS; ++turn)
		{
			if (isSpent(m_workingSet.getMostWork()) ||
				!m_workingSet.solve(input, m_admissible, m_along, m_linearSolver, m_velocity))
				break;
			evaluate(input);
			if (m_workingSet.isRight(m_admissible))
				return true;
		}
		if (turn == 0)
			break;
	}
	m_velocity = first;
	evaluate(input);
	return false;
}

/// Whether what a working set has found leaves no more than rounding, by the factor that is there: a Newton step would take another one.
bool System::isExact(const SystemInput& input)
{
	findResidual(input);
	m_step = m_residual;
	if (!m_linearSolver.solve(m_step))
		return false;
	double gain = 0;
	for (size_t i = 0; i < m_step.size(); ++i)
		gain += m_residual[i] * m_step[i];
	return gain <= ROUNDING * m_phiTerms;
}

/// From the last evaluate() on. \param mayCrawl  whether to go on where steps become short
bool System::newton(const SystemInput& input, bool mayCrawl, int maxSteps)
{
	double phi = findResidual(input);
	int roundings = 0, turns = 0, shortSteps = 0;
	long long stepWork = 1;
	for (int step = 0; step < maxSteps && !isSpent(stepWork); ++step)
	{
		const long long workBefore = m_statistics.m_work;
		m_step = m_residual;
		if (!solveLinear(input, m_step))
			return false;
		++m_statistics.m_newtonSteps;
		m_hasSearched = true;
		double slope = 0;
		for (size_t i = 0; i < m_step.size(); ++i)
			slope -= m_residual[i] * m_step[i];
		if (-slope <= ROUNDING * m_phiTerms && ++roundings > ROUNDING_STEPS)
			return true;
		if (-slope <= TURNING * m_phiTerms && ++turns > TURNING_STEPS)
			return true;
		m_start = m_velocity;
		move(1);
		evaluate(input);
		// A full step that changes no bound has found the solution, too.
		if (!m_boundsChanged)
			return true;
		stepWork = m_statistics.m_work - workBefore;
		const double before = phi;
		phi = findResidual(input);
		if (phi <= before + SUFFICIENT_GAIN * slope + PHI_ROUNDING * fabs(before))
			continue;
		const double length = exactLength(input);
		move(length);
		m_statistics.m_work += (long long)(4 * EVALUATION_A_ROW * double(input.getNumRows()));
		evaluate(input);
		phi = findResidual(input);
		if (!btElasticPlasticIsNumber(phi))
			return false;
		shortSteps += length < SHORT_STEP;
		const int patience = input.getNumBodies() > FEW_BODIES ? PATIENCE : PATIENCE_WITH_FEW;
		if (!mayCrawl && (shortSteps >= SHORT_STEPS * patience / PATIENCE || step >= patience))
			return false;
	}
	return false;
}

/// Finds dv for the present targets of contacts. Where the interior point method was needed once, it is from the start.
bool System::findMinimum(SystemInput& input, Effort effort)
{
	const bool mayUseInterior = effort != PLAIN && m_settings.m_maxInteriorIterations > 0;
	// What has been condensed once in this step stays so. Where it was searched for in the step before, a guess of the whole costs its
	// factor and would not be right.
	const bool hasPlaces = m_place && !m_place->m_condensation.isEmpty();
	bool isEverywhere = false;
	if (isLarge(input) && (m_expectsPlaces || hasPlaces))
	{
		m_expectsPlaces = false;
		const Found found = searchInside(input, effort);
		if (found != ELSEWHERE)
			return found == SOLVED;
		// Places that are chosen again would be the same ones.
		isEverywhere = !hasPlaces;
	}
	if (!mayUseInterior || !m_isHard)
	{
		if (!guess(input))
			return false;
		if (isRight(input))
			return true;
		if (mayUseSets(input) && m_linearSolver.hasHalves() && findBounds(input) && isExact(input))
			return true;
		bool mayCrawl = m_settings.m_maxInteriorIterations == 0;
		if (isLarge(input))
		{
			const Found found = isEverywhere ? ELSEWHERE : searchInside(input, effort);
			if (found != ELSEWHERE)
				return found == SOLVED;
			// It happens everywhere.
			mayCrawl = true;
			evaluate(input);
		}
		if (newton(input, mayCrawl, effort == ROUGH ? PATIENCE : m_settings.m_maxNewtonSteps))
			return true;
		if (!mayUseInterior)
			return false;
		m_isHard = true;
	}
	// Between sweeps any impulses will do that obey the law and gain no energy.
	if (effort == ROUGH)
	{
		evaluate(input);
		settle(input, m_admissible.getImpulses());
		return true;
	}
	const bool isNear = m_interior.solve(input, m_contacts, m_matrix, m_linearSolver, m_velocity,
										 m_settings.m_maxInteriorIterations, m_settings.m_maxWork > 0 ? m_workEnd : 0);
	forgetFactor();
	if (isNear)
	{
		m_interiorHasSolved = true;
		m_contacts.setMultipliers(input, m_interior.getImpulses(), m_interior.getUpperBounds());
	}
	evaluate(input);
	if (newton(input, true, m_settings.m_maxNewtonSteps))
		return true;
	if (!isNear)
		return false;
	++m_statistics.m_cutSearches;
	settle(input, m_interior.getImpulses());
	return true;
}

void System::move(double length)
{
	for (size_t i = 0; i < m_step.size(); ++i)
		m_velocity[i] = m_start[i] + length * m_step[i];
}

/// Finds the share of the step, between 0 and 1, at which phi is least. The derivative of phi along the step is monotonic and
/// piecewise linear, with a kink wherever a row reaches a bound: Newton's method, kept within the bracket, ends exactly.
/// Halving the step would not be enough: rows of little compliance give phi almost an edge, along which the search would
/// zigzag.
double System::exactLength(const SystemInput& input)
{
	const ScopedTimer timer("elastic-plastic search", m_statistics.m_searchTime, m_settings.m_measuresTime);
	m_work.resize(m_step.size());
	multiplyMass(input, m_step, m_work);
	double along0 = 0, along1 = 0;
	for (size_t i = 0; i < m_step.size(); ++i)
	{
		along0 += m_work[i] * m_start[i];
		along1 += m_work[i] * m_step[i];
	}
	const SystemInput::Condensed& condensed = input.m_condensed;
	for (size_t i = 0; i < condensed.m_momentum.size(); ++i)
		along0 -= condensed.m_momentum[i] * m_step[6 * size_t(condensed.m_bodies[i / 6]) + i % 6];
	project(input, m_start, m_alongStart);
	project(input, m_step, m_along);
	m_admissible.beginLine(input, m_alongStart, m_along);
	double low = 0, high = 1, t = 1;
	for (int i = 0; i < MAX_LENGTH_STEPS && high - low > LENGTH_TOLERANCE; ++i)
	{
		double derivative = along0 + t * along1, second = along1;
		m_admissible.addDerivatives(input, m_along, t, derivative, second);
		(derivative > 0 ? high : low) = t;
		const double next = t - derivative / second;
		if (fabs(next - t) <= LENGTH_STEP)
			break;
		t = next > low && next < high ? next : (low + high) / 2;
	}
	return t;
}

bool System::search(SystemInput& input, Effort effort)
{
	const auto tighten = [&](int loop)
	{
		const AugmentedContacts::Progress progress =
			m_contacts.tighten(input, m_admissible, loop, m_settings.m_contactTolerance);
		if (progress.m_hasChangedMatrix)
			forgetFactor();
		return progress.m_isOpen;
	};
	if (isLarge(input))
	{
		m_singleRowsBefore.resize(input.m_singleRows.size());
		for (size_t i = 0; i < m_singleRowsBefore.size(); ++i)
			m_singleRowsBefore[i] = input.m_rows[size_t(input.m_singleRows[i].m_row)];
		m_admissible.getResult(m_before.m_impulses, m_before.m_bounds);
	}
	m_contacts.begin(input, m_admissible);
	m_interiorHasSolved = m_insideHasSolved = m_hasSearched = m_isCut = false;
	const long long newtonSteps = m_statistics.m_newtonSteps;
	long long workBefore = m_statistics.m_work;
	bool solved = findMinimum(input, effort);
	if (m_insideHasSolved)
		return finish();
	bool open = effort == EXACT && m_contacts.isAny() && tighten(1);
	// The interior point method has no need of them: its contacts are hard.
	bool isShort = false;
	for (int loop = 0; solved && open && !m_interiorHasSolved && loop < m_settings.m_maxContactLoops; ++loop)
	{
		isShort = isSpent(m_statistics.m_work - workBefore);
		if (isShort)
			break;
		workBefore = m_statistics.m_work;
		++m_statistics.m_contactLoops;
		// The interior point method ends the loops, too.
		m_isHard |= m_statistics.m_newtonSteps - newtonSteps >
					(input.getNumBodies() > FEW_BODIES ? MANY_STEPS : MANY_STEPS_WITH_FEW);
		// The contacts' targets have changed, so the solution changes even if no bound does.
		solved = findMinimum(input, effort);
		if (m_insideHasSolved)
			return finish();
		open = tighten(loop + 2);
	}
	m_statistics.m_looseContacts += open;
	if (!solved && effort == PLAIN)
		return false;
	if (effort == EXACT && (!solved || isShort || (open && isSpent())))
	{
		++m_statistics.m_cutSearches;
		evaluate(input);
		settle(input, m_admissible.getImpulses());
	}
	if (effort == EXACT && solved && !m_isCut)
		releaseFriction(input);
	return finish();
}

/// Takes friction back where nothing presses any more. Its bounds are those of normal impulses of the loop before, or of the interior
/// point method's, to within their tolerance. What it has held may part other contacts.
void System::releaseFriction(SystemInput& input)
{
	while (!isSpent() && m_contacts.releaseFriction(input, m_admissible))
	{
		const SystemResult last = getResult();
		evaluate(input);
		if (!newton(input, true, m_settings.m_maxNewtonSteps))
		{
			setResult(last);
			return;
		}
	}
}

/// \return false if the solution is not a number
bool System::finish()
{
	for (const double v : m_velocity)
		if (!(fabs(v) < FASTEST))
		{
			// IslandSolver finds it in the bodies, and withholds it.
			std::fill(m_velocity.begin(), m_velocity.end(), std::numeric_limits<double>::quiet_NaN());
			return false;
		}
	return true;
}

bool System::isLarge(const SystemInput& input) const
{
	return m_settings.m_condenses && m_linearSolver.getNumOperations() > MANY_OPERATIONS &&
		   input.m_condensed.m_bodies.empty();
}

/// The bodies of contacts, and of rows that are at their bounds.
void System::findPlaces(const SystemInput& input, std::vector<int>& bodies) const
{
	bodies.clear();
	const auto add = [&](const int body[2])
	{
		for (int side = 0; side < 2; ++side)
			if (body[side] >= 0)
				bodies.push_back(body[side]);
	};
	for (const SystemInput::Unit& unit : input.m_units)
		for (int r = 0; r < unit.m_numRows; ++r)
			if (*m_admissible.getBounds(unit.m_firstRow + r) != 0)
			{
				add(unit.m_body);
				break;
			}
	for (const SystemInput::SingleRow& row : input.m_singleRows)
		if (row.m_isContact)
			add(row.m_body);
}

/// Searches a large problem where something happens only.
System::Found System::searchInside(SystemInput& input, Effort effort)
{
	if (!m_place)
		m_place.reset(new Place(m_statistics, &m_linearSolver.getBuffers()));
	Condensation& condensation = m_place->m_condensation;
	System& inside = m_place->m_inside;
	std::vector<int> bodies;
	// As before the search: the bounds at which rows outside stay, and contacts without multipliers.
	SystemResult held = m_before;
	m_admissible.setResult(held.m_impulses, held.m_bounds);
	for (size_t i = 0; i < m_singleRowsBefore.size(); ++i)
		input.m_rows[size_t(input.m_singleRows[i].m_row)] = m_singleRowsBefore[i];
	// What is eliminated outside is as large.
	m_matrixIsCurrent = false;
	m_matrix.lendBuffers();
	const bool isAgain = !condensation.isEmpty();
	if (isAgain)
	{
		if (!condensation.condenseAgain(input, m_admissible))
		{
			m_contacts.begin(input, m_admissible);
			return ELSEWHERE;
		}
	}
	else
	{
		findPlaces(input, bodies);
		if (bodies.empty() || !condensation.choose(input, bodies, RINGS) ||
			!condensation.condense(input, m_admissible, m_linearSolver.getNumOperations()))
		{
			condensation.clear();
			m_contacts.begin(input, m_admissible);
			return ELSEWHERE;
		}
	}
	for (int turn = 0; turn < MOST_PLACES; ++turn)
	{
		btElasticPlasticSolverSettings settings = m_settings;
		if (m_settings.m_maxWork > 0)
			settings.m_maxWork = std::max(m_workEnd - m_statistics.m_work, 1ll);
		inside.setSettings(settings);
		int islandId = 0;
		// What is rough between sweeps is exact here: it costs little.
		if (!inside.solve(condensation.getInput(), islandId, effort == PLAIN ? PLAIN : EXACT))
		{
			if (effort == PLAIN)
				return GAVE_UP;
			break;
		}
		SystemResult result = inside.getResult();
		condensation.expand(result.m_velocity, m_velocity);
		m_admissible.setResult(held.m_impulses, held.m_bounds);
		evaluate(input);
		bodies.clear();
		const auto check = [&](int firstRow, int numRows, const int body[2])
		{
			for (int r = firstRow; r < firstRow + numRows; ++r)
				if (!condensation.isRowInside(r) && *m_admissible.getBounds(r) != held.m_bounds[size_t(r)])
				{
					for (int side = 0; side < 2; ++side)
						if (body[side] >= 0)
							bodies.push_back(body[side]);
					return;
				}
		};
		for (const SystemInput::Unit& unit : input.m_units)
			check(unit.m_firstRow, unit.m_numRows, unit.m_body);
		for (const SystemInput::SingleRow& row : input.m_singleRows)
			check(row.m_row, 1, row.m_body);
		const std::vector<int>& rows = condensation.getRows();
		SystemResult whole = getResult();
		for (size_t i = 0; i < rows.size(); ++i)
		{
			const size_t r = size_t(rows[i]);
			held.m_impulses[r] = whole.m_impulses[r] = result.m_impulses[i];
			held.m_bounds[r] = whole.m_bounds[r] = result.m_bounds[i];
		}
		if (bodies.empty())
		{
			for (size_t i = 0; i < rows.size(); ++i)
				input.m_rows[size_t(rows[i])] = condensation.getTerms(int(i));
			m_insideHasSolved = true;
			m_isHard = inside.m_isHard;
			m_hasSearched = inside.m_hasSearched;
			setResult(whole);
			if (inside.m_isCut)
				settle(input, whole.m_impulses);
			return SOLVED;
		}
		m_admissible.setResult(held.m_impulses, held.m_bounds);
		if (!condensation.enlarge(input, bodies, RINGS_MORE) ||
			!condensation.condense(input, m_admissible, m_linearSolver.getNumOperations()))
			break;
	}
	condensation.clear();
	m_admissible.setResult(held.m_impulses, held.m_bounds);
	m_contacts.begin(input, m_admissible);
	forgetFactor();
	return ELSEWHERE;
}

/// Sets dv to what impulses make of it.
System::Work System::findWork(const SystemInput& input, const std::vector<double>& impulses)
{
	Work work;
	m_contacts.addWork(input, impulses, work.m_gain, work.m_cost);
	std::fill(m_velocity.begin(), m_velocity.end(), 0.);
	addImpulses(input, impulses.data(), m_velocity);
	m_work = m_velocity;
	divideByMass(input, m_velocity);
	for (size_t i = 0; i < m_work.size(); ++i)
		work.m_cost += m_work[i] * m_velocity[i];
	return work;
}

double System::findMade(const SystemInput& input)
{
	m_start = m_velocity;
	const double made = findWork(input, m_admissible.getImpulses()).made();
	m_velocity = m_start;
	return made;
}

/// Gives impulses that are no solution what they lack. Within their bounds they gain no energy as long as
///     1/2 lambda^T (A + C) lambda <= b^T lambda,
/// since this is what the bodies and springs have less after the step. Scaled by a factor below 1 impulses stay within bounds that
/// contain zero. The velocities follow from the impulses, and momentum is kept; which rows flow follows from the velocities.
void System::settle(const SystemInput& input, std::vector<double> impulses)
{
	m_isCut = true;
	if (!input.m_condensed.m_bodies.empty())
	{
		// The whole problem's search ends it.
		SystemResult result = getResult();
		result.m_impulses = impulses;
		setResult(result);
		return;
	}
	const Work work = findWork(input, impulses);
	const double share = work.m_cost > work.m_gain ? std::max(work.m_gain, 0.) / work.m_cost : 1;
	for (double& impulse : impulses)
		impulse *= share;
	// What has been swept since the last solution relies on its impulses: less than they have made is not to be had by other ones.
	if (!m_impulsesBefore.empty())
	{
		for (size_t i = 0; i < m_impulsesBefore.size(); ++i)
			m_impulsesBefore[i] =
				std::max(input.m_rows[i].m_lower, std::min(m_impulsesBefore[i], input.m_rows[i].m_upper));
		if (findWork(input, m_impulsesBefore).made() < Work{share * work.m_gain, share * share * work.m_cost}.made())
			impulses = m_impulsesBefore;
	}
	findWork(input, impulses);
	evaluate(input);
	SystemResult result = getResult();
	result.m_impulses = impulses;
	setResult(result);
}

bool System::solveAgain(SystemInput& input, Effort effort)
{
	if (m_contacts.hasHardened())
		forgetFactor();
	m_impulsesBefore = m_admissible.getImpulses();
	return search(input, effort);
}

SystemResult System::getResult() const
{
	SystemResult result;
	result.m_velocity = m_velocity;
	m_admissible.getResult(result.m_impulses, result.m_bounds);
	return result;
}

void System::setResult(const SystemResult& result)
{
	m_velocity = result.m_velocity;
	m_admissible.setResult(result.m_impulses, result.m_bounds);
	m_matrixIsCurrent = false;
}

bool System::solve(SystemInput& input, int& islandId, Effort effort, int numSolutions)
{
	++m_statistics.m_islands;
	m_statistics.m_rows += input.getNumRows();
	m_expectsPlaces = islandId != 0 && islandId == m_searchedInside;
	m_matrix.begin(input, islandId, numSolutions);
	islandId = m_linearSolver.getIslandId();
	m_matrixIsCurrent = false;
	m_admissible.begin(input);
	m_isHard = false;
	m_impulsesBefore.clear();
	if (m_place)
		m_place->m_condensation.clear();
	// A sixteenth is for what the last step of the search takes beyond what was foreseen.
	m_workEnd = m_statistics.m_work + (m_settings.m_maxWork - m_settings.m_maxWork / 16);
	m_velocity.assign(6 * size_t(input.getNumBodies()), 0.);
	m_residual.resize(m_velocity.size());
	const bool isNumber = search(input, effort);
	if (isLarge(input))
		m_searchedInside = m_insideHasSolved && m_hasSearched ? islandId : 0;
	return isNumber;
}
}  // namespace btElasticPlastic
