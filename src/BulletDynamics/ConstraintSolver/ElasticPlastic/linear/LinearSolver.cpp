// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "LinearSolver.h"

#include <math.h>
#include <stdlib.h>

#include "ScopedTimer.h"

namespace btElasticPlastic
{
namespace
{
/// A plan that no island has used for more than this number of steps makes room for new ones. An island whose graph contacts
/// change in every step has one plan more than this number.
const long long KEPT_STEPS = 2;
/// The same where an island goes from one of several solvers to another, and returns after a while.
const long long KEPT_STEPS_OF_MANY = 20;
/// The number of plans that are kept where beginStep() is never called, so that plans have no age.
const size_t KEPT_PLANS = 256;

// Nominal work, see btElasticPlasticStatistics::m_work: measured on a processor of 3 GHz with vectors of 8 doubles, and rounded.
const double OPERATIONS_A_NANOSECOND = 50;     // of a factorisation
const double NANOSECONDS_A_BLOCK = 8;          // of a solution
const double NANOSECONDS_A_MATRIX_BLOCK = 20;  // of a product, and of a matrix's assembly

size_t hashOf(int numBodies, const std::vector<int>& edges)
{
	size_t hash = size_t(numBodies);
	for (const int body : edges)
		hash = (hash ^ size_t(body)) * size_t(0x9E3779B97F4A7C15ull) + (hash >> 29);
	return hash;
}

/// Whether a factor is so much more expensive than solutions with it that iterating with an old one pays.
bool isWorthKeeping(const BlockFactor& factor, int numSolutions)
{
	return LinearSolver::mayKeepFactor(factor.getNumBodies()) &&
		   double(factor.getNumOperations()) > 8. * 144 * double(factor.getNumBlocks()) * numSolutions;
}
}  // namespace

void LinearSolver::begin(int numBodies, const std::vector<int>& edges, int islandId, int numSolutions, int numLast)
{
	const ScopedTimer timer("elastic-plastic analyse", m_statistics.m_analysisTime, m_settings.m_measuresTime);
	const size_t hash = hashOf(numBodies, edges);
	leavePlan();
	const auto range = m_plans.equal_range(hash);
	for (auto i = range.first; i != range.second; ++i)
	{
		Plan& plan = *i->second;
		if ((plan.m_islandId == 0 || plan.m_islandId == abs(islandId)) && plan.m_numBodies == numBodies &&
			plan.m_edges == edges)
			m_plan = &plan;
	}
	if (!m_plan)
	{
		leaveGraphOf(abs(islandId));
		m_plan = &newPlan(hash);
		m_plan->m_numBodies = numBodies;
		m_plan->m_numLast = numLast;
		m_plan->m_edges = edges;
		m_plan->m_matrix.setPattern(numBodies, reinterpret_cast<const int(*)[2]>(edges.data()), int(edges.size() / 2));
		m_plan->m_factor.analyse(m_plan->m_matrix, numLast);
		if (!m_isOneOfMany && isWorthKeeping(m_plan->m_factor, 1))
			m_plan->m_islandId = ++m_lastIslandId;
		++m_statistics.m_analyses;
	}
	// What is kept of an island that has slept is not used: whether its plan is still there depends on other islands.
	const bool isFresh = m_isOneOfMany || islandId < 0 || m_plan->m_lastUse + 1 < m_step;
	m_factorState = !isFresh && isWorthKeeping(m_plan->m_factor, numSolutions) ? OLD : NONE;
	if (isFresh)
		m_plan->m_patience = m_plan->m_numUses = 0;
	++m_plan->m_numUses;
	m_plan->m_lastUse = m_step;
}

/// Where bodies touch and part, a graph is used once, and its factor is of no use to the next one. Whoever comes next uses its memory.
void LinearSolver::leavePlan()
{
	if (m_plan && (m_plan->m_islandId == 0 || m_plan->m_numUses < 2))
		giveBuffersBack(*m_plan);
	m_plan = nullptr;
}

/// The island has another graph now. If its last one returns, it is not in the next step.
void LinearSolver::leaveGraphOf(int islandId)
{
	for (auto i = m_plans.begin(); islandId != 0 && i != m_plans.end(); ++i)
		if (i->second->m_islandId == islandId)
		{
			giveBuffersBack(*i->second);
			i->second->m_numUses = 0;
		}
}

void LinearSolver::lendBuffers()
{
	if (m_plan)
		giveBuffersBack(*m_plan);
	m_factorState = NONE;
}

void LinearSolver::giveBuffersBack(Plan& plan)
{
	std::vector<double> values;
	plan.m_matrix.swapValues(values);
	m_buffers.give(values);
	plan.m_factor.swapValues(values);
	m_buffers.give(values);
}

/// Of the matrix or of the factor, where it has given its own back.
template <class Blocks>
void LinearSolver::takeBuffer(Blocks& blocks)
{
	if (blocks.hasValues())
		return;
	std::vector<double> values;
	m_buffers.take(blocks.getNumValues(), values);
	blocks.swapValues(values);
}

void LinearSolver::setMatrixZero()
{
	takeBuffer(m_plan->m_matrix);
	m_plan->m_matrix.setZero();
}

void LinearSolver::setSettings(const btElasticPlasticSolverSettings& settings)
{
	if (settings.m_maxVectorWidth != m_settings.m_maxVectorWidth)
	{
		// A plan is made for one width of vectors.
		m_plans.clear();
		m_plan = nullptr;
	}
	m_settings = settings;
}

LinearSolver::Plan& LinearSolver::newPlan(size_t hash)
{
	const long long oldest = m_step - (m_isOneOfMany ? KEPT_STEPS_OF_MANY : KEPT_STEPS);
	for (auto i = m_plans.begin(); i != m_plans.end();)
		if (i->second->m_lastUse < oldest)
		{
			giveBuffersBack(*i->second);
			i = m_plans.erase(i);
		}
		else
			++i;
	if (m_step == 0 && m_plans.size() >= KEPT_PLANS)
		m_plans.clear();
	Plan& plan = *m_plans.emplace(hash, std::unique_ptr<Plan>(new Plan))->second;
	plan.m_factor.setMaxVectorWidth(m_settings.m_maxVectorWidth);
	return plan;
}

void LinearSolver::setAssembled(const std::vector<int>& changedBodies)
{
	if (m_factorState == NONE || m_factorState == OLD)
		return;
	if (m_factorState == CURRENT)
		m_changed.clear();
	m_factorState = NEARLY;
	m_changed.insert(m_changed.end(), changedBodies.begin(), changedBodies.end());
}

bool LinearSolver::factorise()
{
	const ScopedTimer timer("elastic-plastic factorise", m_statistics.m_factorisationTime, m_settings.m_measuresTime);
	++m_statistics.m_factorisations;
	BlockFactor& factor = m_plan->m_factor;
	takeBuffer(factor);
	bool done;
	if (m_factorState == NEARLY && 8 * m_changed.size() < size_t(m_plan->m_numBodies))
	{
		++m_statistics.m_partialFactorisations;
		done = factor.factorise(m_plan->m_matrix, m_changed.data(), int(m_changed.size()));
	}
	else
		done = factor.factorise(m_plan->m_matrix);
	m_statistics.m_work += (long long)(double(factor.getNumFactorisedOperations()) / OPERATIONS_A_NANOSECOND +
									   NANOSECONDS_A_MATRIX_BLOCK * double(m_plan->m_matrix.getNumBlocks()));
	m_factorState = done ? CURRENT : NONE;
	return done;
}

void LinearSolver::countSolution()
{
	++m_statistics.m_solutions;
	m_statistics.m_work += (long long)(NANOSECONDS_A_BLOCK * double(m_plan->m_factor.getNumBlocks()));
}

bool LinearSolver::solve(std::vector<double>& x)
{
	if (m_factorState == OLD && m_plan->m_islandId && m_plan->m_factor.hasFactor() && m_settings.m_maxIterations > 0)
	{
		if (m_plan->m_patience > 0)
			--m_plan->m_patience;
		else if (iterate(x))
			return true;
		else
			m_plan->m_patience = 8;
	}
	if (m_factorState != CURRENT && !factorise())
		return false;
	const ScopedTimer timer("elastic-plastic solve", m_statistics.m_solutionTime, m_settings.m_measuresTime);
	m_plan->m_factor.solve(x.data());
	countSolution();
	return true;
}

void LinearSolver::solveHalf(const int bodies[2], const double b[12], HalfSolution& half)
{
	const ScopedTimer timer("elastic-plastic solve", m_statistics.m_solutionTime, m_settings.m_measuresTime);
	const int64_t numBlocks = m_plan->m_factor.solveHalf(bodies, b, half);
	m_statistics.m_work += (long long)(NANOSECONDS_A_BLOCK / 2 * double(numBlocks));
}

namespace
{
double scalarProduct(const std::vector<double>& x, const std::vector<double>& y)
{
	double sum = 0;
	for (size_t i = 0; i < x.size(); ++i)
		sum += x[i] * y[i];
	return sum;
}
}  // namespace

/// Solves by conjugate gradients, preconditioned with the factor of an earlier H. Leaves x as it was if that takes too many
/// iterations.
bool LinearSolver::iterate(std::vector<double>& x)
{
	const ScopedTimer timer("elastic-plastic solve", m_statistics.m_solutionTime, m_settings.m_measuresTime);
	const BlockMatrix& matrix = m_plan->m_matrix;
	const BlockFactor& factor = m_plan->m_factor;
	const size_t n = x.size();
	const double enough = m_settings.m_iterationTolerance * m_settings.m_iterationTolerance * scalarProduct(x, x);
	m_rest = x;
	m_product.resize(n);
	m_preconditioned = m_rest;
	factor.solve(m_preconditioned.data());
	countSolution();
	m_search = m_preconditioned;
	m_solution.assign(n, 0.);
	double rz = scalarProduct(m_rest, m_preconditioned), before = scalarProduct(x, x);
	for (int i = 0; i < m_settings.m_maxIterations; ++i)
	{
		matrix.multiply(m_search.data(), m_product.data());
		++m_statistics.m_iterations;
		m_statistics.m_work += (long long)(NANOSECONDS_A_MATRIX_BLOCK * double(matrix.getNumBlocks()));
		const double alpha = rz / scalarProduct(m_search, m_product);
		double rest = 0;
		for (size_t k = 0; k < n; ++k)
		{
			m_solution[k] += alpha * m_search[k];
			m_rest[k] -= alpha * m_product[k];
			rest += m_rest[k] * m_rest[k];
		}
		if (rest <= enough)
		{
			x.swap(m_solution);
			return true;
		}
		// The iterations that are left do not suffice if each of them gains what the last one did.
		if (!(rest < before) || pow(rest / before, m_settings.m_maxIterations - 1 - i) * rest > enough)
			return false;
		before = rest;
		m_preconditioned = m_rest;
		factor.solve(m_preconditioned.data());
		countSolution();
		const double next = scalarProduct(m_rest, m_preconditioned);
		for (size_t k = 0; k < n; ++k)
			m_search[k] = m_preconditioned[k] + next / rz * m_search[k];
		rz = next;
	}
	return false;
}
}  // namespace btElasticPlastic
