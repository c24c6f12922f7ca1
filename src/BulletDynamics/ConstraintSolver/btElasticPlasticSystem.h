/*
Bullet Elastic-Plastic: joints for Bullet Physics that bend before they break
Copyright (c) 2026 Bullet Elastic-Plastic contributors

This software is provided 'as-is', without any express or implied warranty.
In no event will the authors be held liable for any damages arising from the use of this software.
Permission is granted to anyone to use this software for any purpose,
including commercial applications, and to alter it and redistribute it freely,
subject to the following restrictions:

1. The origin of this software must not be misrepresented; you must not claim that you wrote the original software. If you use this software in a product, an acknowledgment in the product documentation would be appreciated but is not required.
2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the original software.
3. This notice may not be removed or altered from any source distribution.
*/

#ifndef BT_ELASTIC_PLASTIC_SYSTEM_H
#define BT_ELASTIC_PLASTIC_SYSTEM_H

#include <vector>

#include "btElasticPlasticBlockFactor.h"
#include "btElasticPlasticBlockMatrix.h"

/// A velocity-level problem of bodies and bounded, compliant rows, solved directly, in double whatever Bullet's precision.
///
/// Find the change of velocity dv and impulses lambda with
///
///     M dv = sum J^T lambda,   J dv + C lambda = b  where lambda is inside its bounds, else lambda at the bound.       (1)
///
/// With psi'(u) = clamp(u / C, lower, upper), (1) says that dv minimises the convex function
///
///     phi(dv) = 1/2 dv^T M dv + sum psi(b - J dv),   gradient  M dv - sum J^T clamp((b - J dv) / C),                   (2)
///
/// whose Hessian is H = M + sum over unbounded rows of J^T J / C: symmetric positive definite, one 6x6 block per body and per
/// pair of joined bodies. Semismooth Newton with a line search, begun at the solution for the last step's set of bounded rows
/// (from zero it would have to find that set step by step), ends in 1 to 3 factorisations.
///
/// Contacts are rows too, but hard (C = 0) and with friction bounded by the normal impulse. They are made soft by an augmented
/// Lagrangian: with compliance c and multiplier l the row asks for J dv + c (lambda - l) = b; l becomes the last lambda until
/// nothing changes. Friction bounds follow the normal impulses in the same loop.
class btElasticPlasticSystem
{
public:
	/// A row of (1). Bodies by index, -1: one that does not move.
	struct Row
	{
		double m_J[12];       ///< linear and angular part on body A, then on body B
		double m_target;      ///< b
		double m_compliance;  ///< C > 0
		double m_lower;
		double m_upper;
		double m_impulse = 0;     ///< lambda; before solve(): the first guess of a contact's
		double m_multiplier = 0;  ///< l of a contact
		int m_bodyA;
		int m_bodyB;
		int m_edge = -1;           ///< of the matrix's pattern, set by solve()
		int m_normal = -1;         ///< friction: the row of its normal impulse
		double m_friction = 0;     ///< friction: coefficient
		double m_frictionMax = 0;  ///< friction: greatest bound, 0: none
		signed char m_bound = 0;  ///< -1 at the lower, 1 at the upper bound, 0 between; before solve(): the first guess
		bool m_isInMatrix = false;  ///< set by solve()
		bool m_isContact = false;
		bool m_isAngular = false;  ///< has no linear part
	};

	/// What solving took, summed over calls.
	struct Statistics
	{
		long long m_systems = 0;
		long long m_rows = 0;
		long long m_newtonSteps = 0;
		long long m_analyses = 0;  ///< of the graph
		long long m_factorisations = 0;
		long long m_solutions = 0;   ///< with a factor
		long long m_iterations = 0;  ///< of conjugate gradients with the factor of an earlier step
		long long m_contactLoops = 0;
		long long m_failures = 0;  ///< no convergence or no numbers: the caller's fallback took over
	};

	/// Begins a new problem.
	void clear();

	/// \param mass  symmetric 6x6, positive definite, element (row, column) at [6 * column + row]
	/// \return the body's index
	int addBody(const double mass[36]);

	/// \return the row; the reference is valid until the next one is added
	Row& addRow();

	int getNumBodies() const { return int(m_mass.size() / 36); }
	int getNumRows() const { return int(m_rows.size()); }
	Row& getRow(int i) { return m_rows[i]; }

	/// Finds dv and the rows' impulses and bounds. \return false if it does not converge: then both mean nothing
	bool solve();

	/// dv of a body, 6 doubles
	const double* getVelocityChange(int body) const { return &m_velocity[6 * size_t(body)]; }

	const Statistics& getStatistics() const { return m_statistics; }
	void resetStatistics() { m_statistics = Statistics(); }

	/// A large system's factor is kept while a few iterations with it are cheaper than a new one. 0: never
	int m_maxIterations = 8;
	double m_iterationTolerance = 1e-11;  ///< of the residual momentum, relative to the right side

	/// Longest search, and how exactly contacts are solved.
	int m_maxNewtonSteps = 500;
	int m_maxContactLoops = 20;
	double m_contactTolerance = 1e-3;  ///< of velocities, relative to the fastest approach

private:
	/// A pattern of bodies and edges met before, with the plan of its factorisation.
	struct Plan
	{
		int m_numBodies = 0;
		std::vector<int> m_edges;  // two bodies each
		btElasticPlasticBlockMatrix m_matrix;
		btElasticPlasticBlockFactor m_factor;
		long long m_lastUse = 0;
		int m_patience = 0;  // solutions for which iterating with an old factor is not tried again
	};

	Plan& findPlan();
	void assemble();
	void addToMatrix(const Row& row, double weight);
	bool factorise();
	bool solveLinear(std::vector<double>& x);
	bool iterate(std::vector<double>& x);
	bool isWorthKeeping() const;
	void multiplyMass(const std::vector<double>& x, std::vector<double>& y) const;
	double along(const Row& row, const std::vector<double>& velocity) const;
	void addTo(std::vector<double>& momentum, const Row& row, double impulse) const;
	double evaluate();
	bool guess();
	bool newton();
	void move(double length);
	double exactLength();
	bool tightenContacts();

	std::vector<double> m_mass;
	std::vector<Row> m_rows;
	std::vector<int> m_edges;
	std::vector<Plan> m_plans;
	Plan* m_plan = nullptr;
	long long m_time = 0;            // solve() calls, for the plans' age
	bool m_boundsChanged = false;    // by the last evaluate()
	bool m_matrixIsCurrent = false;  // H belongs to the rows' present bounds
	bool m_factorIsCurrent = false;  // and the factor to H
	bool m_factorIsOfThisSolve = false;
	std::vector<int> m_changedBodies;  // since the last assembly
	std::vector<double> m_velocity;    // dv
	std::vector<double> m_residual;    // -gradient of (2) at dv
	std::vector<double> m_step;
	std::vector<double> m_start;
	std::vector<double> m_work;
	std::vector<double> m_rowDistance, m_rowSpeed;                                  // of the line search
	std::vector<double> m_solution, m_search, m_product, m_preconditioned, m_rest;  // of conjugate gradients
	Statistics m_statistics;
};

#endif  // BT_ELASTIC_PLASTIC_SYSTEM_H
