// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SYSTEM_H
#define BT_ELASTIC_PLASTIC_SYSTEM_H

#include <vector>

#include "../linear/LinearSolver.h"

namespace btElasticPlastic
{
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
/// (from zero it would have to find that set step by step), ends in 1 to 3 factorisations where few rows change sides in a step,
/// and in some dozens where hundreds do.
///
/// The rows of a joint share axes and arms: they are a unit here, a fraction of the memory and of the arithmetic of as many
/// single rows. Other constraints and contacts come as single rows.
///
/// Contacts are hard (C = 0) or nearly so, with friction bounded by the normal impulse. They are made softer by an augmented
/// Lagrangian: with softening c and multiplier l the row asks for J dv + C lambda + c (lambda - l) = b; l becomes the last
/// lambda until nothing changes.
/// Friction bounds follow the normal impulses in the same loop.
class System
{
public:
	struct Body
	{
		double m_mass[3];     ///< along the world's axes
		double m_inertia[9];  ///< symmetric, positive definite, world coordinates
	};

	/// What (1) asks of a row.
	struct Law
	{
		double m_target;      ///< b
		double m_compliance;  ///< C > 0
		double m_lower;
		double m_upper;
		double m_impulse = 0;     ///< lambda; before solve(): the first guess of a contact's
		signed char m_bound = 0;  ///< -1 at the lower, 1 at the upper bound, 0 between; before solve(): the first guess
		bool m_isInMatrix = false;  ///< set by solve()
	};

	/// Rows along and about three axes through a point: J = [a, rA x a, -a, -rB x a] and [0, a, 0, -a].
	struct Joint
	{
		double m_axis[3][3];  ///< a, at a right angle to each other, unit length
		double m_arm[2][3];   ///< rA, rB: from the bodies' centres of mass to the point
		int m_body[2];        ///< by index, -1: one that does not move
		int m_firstLaw;
		int m_numLaws;
		signed char m_dof[6];  ///< of each law: 0 to 2 along, 3 to 5 about an axis
		int m_edge = -1;       ///< of the matrix, set by solve()
	};

	struct Row
	{
		double m_J[12];  ///< linear and angular part on one body, then on the other
		int m_body[2];   ///< by index, -1: one that does not move
		int m_law;
		int m_edge = -1;  ///< of the matrix, set by solve()
		bool m_isContact = false;
		int m_normal = -1;         ///< friction: the row of its normal impulse
		double m_friction = 0;     ///< friction: coefficient
		double m_frictionMax = 0;  ///< friction: greatest bound, 0: none
		double m_softening = 0;    ///< c of a contact, part of its law's compliance
		double m_target = 0;       ///< b of a contact, set by solve()
		double m_multiplier = 0;   ///< l of a contact, set by solve()
		double m_slip = 0;         ///< velocity that the last loop has left, set by solve()
		double m_leastSoftening = 0;
	};

	System() : m_linearSolver(m_statistics) {}

	/// Begins a new problem.
	void clear();

	/// The references are valid until the next one is added.
	Body& addBody();
	Joint& addJoint(int numLaws);
	Row& addRow();

	int getNumBodies() const { return int(m_bodies.size()); }
	int getNumRows() const { return int(m_rows.size()); }
	int getNumLaws() const { return int(m_laws.size()); }
	const Row& getRow(int i) const { return m_rows[i]; }
	Law& getLaw(int i) { return m_laws[i]; }

	/// Finds dv and the rows' impulses and bounds. \return false if it does not converge: then both mean nothing
	bool solve(int& ticket);

	/// dv of a body, 6 doubles
	const double* getVelocityChange(int body) const { return &m_velocity[6 * size_t(body)]; }

	LinearSolver& getLinearSolver() { return m_linearSolver; }
	btElasticPlasticStatistics& getStatistics() { return m_statistics; }
	const btElasticPlasticStatistics& getStatistics() const { return m_statistics; }

	void copySettings(const System& other)
	{
		m_maxNewtonSteps = other.m_maxNewtonSteps;
		m_maxContactLoops = other.m_maxContactLoops;
		m_contactTolerance = other.m_contactTolerance;
		m_linearSolver.copySettings(other.m_linearSolver);
	}

	/// Longest search, and how exactly contacts are solved.
	int m_maxNewtonSteps = 200;
	int m_maxContactLoops = 20;
	double m_contactTolerance = 1e-3;  ///< of velocities, relative to the fastest approach

private:
	void findEdges();
	int addEdge(const int body[2]);
	void assemble();
	void addToMatrix(const Joint& joint);
	void addToMatrix(const Row& row);
	void noteChange(const int body[2], int firstLaw, int numLaws);
	bool solveLinear(std::vector<double>& x);

	void project(const std::vector<double>& velocity, std::vector<double>& along) const;
	void addImpulses(std::vector<double>& momentum) const;
	void multiplyMass(const std::vector<double>& x, std::vector<double>& y) const;

	bool search();
	bool guess();
	bool newton();
	void evaluate();
	double findResidual();
	void move(double length);
	double exactLength();
	bool tightenContacts(int loop);

	std::vector<Body> m_bodies;
	std::vector<Law> m_laws;
	std::vector<Joint> m_joints;
	std::vector<Row> m_rows;
	std::vector<int> m_edges;  // two bodies each
	btElasticPlasticStatistics m_statistics;
	LinearSolver m_linearSolver;
	double m_phiTerms = 0;             // sum of the absolute values of phi's terms
	bool m_boundsChanged = false;      // by the last evaluate()
	bool m_matrixIsCurrent = false;    // H belongs to the rows' present bounds
	std::vector<int> m_changedBodies;  // by the last assembly
	std::vector<double> m_velocity;    // dv
	std::vector<double> m_residual;    // -gradient of (2) at dv
	std::vector<double> m_step;
	std::vector<double> m_start;
	std::vector<double> m_work;
	std::vector<double> m_along, m_alongStart;  // J times something, by law
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SYSTEM_H
