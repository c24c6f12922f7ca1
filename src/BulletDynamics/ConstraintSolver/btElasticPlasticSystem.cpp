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

#include "btElasticPlasticSystem.h"

#include <math.h>
#include <string.h>

#include <algorithm>

#include "btElasticPlasticLap.h"

void btElasticPlasticSystem::clear()
{
	m_bodies.clear();
	m_laws.clear();
	m_joints.clear();
	m_rows.clear();
}

btElasticPlasticSystem::Body& btElasticPlasticSystem::addBody()
{
	m_bodies.emplace_back();
	return m_bodies.back();
}

btElasticPlasticSystem::Joint& btElasticPlasticSystem::addJoint(int numLaws)
{
	m_joints.emplace_back();
	Joint& joint = m_joints.back();
	joint.m_firstLaw = int(m_laws.size());
	joint.m_numLaws = numLaws;
	m_laws.resize(m_laws.size() + numLaws);
	return joint;
}

btElasticPlasticSystem::Row& btElasticPlasticSystem::addRow()
{
	m_rows.emplace_back();
	m_rows.back().m_law = int(m_laws.size());
	m_laws.emplace_back();
	return m_rows.back();
}

// ---- vectors in space

namespace
{
const double AT_REST[6] = {};

inline double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// to = a x b
inline void cross(const double* a, const double* b, double* to)
{
	to[0] = a[1] * b[2] - a[2] * b[1];
	to[1] = a[2] * b[0] - a[0] * b[2];
	to[2] = a[0] * b[1] - a[1] * b[0];
}

inline void addScaled(double factor, const double* a, double* to)
{
	for (int i = 0; i < 3; ++i)
		to[i] += factor * a[i];
}
}  // namespace

/// J v of all rows.
void btElasticPlasticSystem::project(const std::vector<double>& velocity, std::vector<double>& along) const
{
	along.resize(m_laws.size());
	const auto of = [&velocity](int body) { return body >= 0 ? &velocity[6 * size_t(body)] : AT_REST; };
	for (const Joint& joint : m_joints)
	{
		const double *a = of(joint.m_body[0]), *b = of(joint.m_body[1]);
		double turnA[3], turnB[3], relative[2][3];
		cross(a + 3, joint.m_arm[0], turnA);
		cross(b + 3, joint.m_arm[1], turnB);
		for (int i = 0; i < 3; ++i)
		{
			relative[0][i] = a[i] + turnA[i] - b[i] - turnB[i];
			relative[1][i] = a[3 + i] - b[3 + i];
		}
		double* to = &along[joint.m_firstLaw];
		for (int l = 0; l < joint.m_numLaws; ++l)
		{
			const int dof = joint.m_dof[l];
			to[l] = dof < 3 ? dot(joint.m_axis[dof], relative[0]) : dot(joint.m_axis[dof - 3], relative[1]);
		}
	}
	for (const Row& row : m_rows)
	{
		const double *a = of(row.m_body[0]), *b = of(row.m_body[1]);
		along[row.m_law] = dot(row.m_J, a) + dot(row.m_J + 3, a + 3) + dot(row.m_J + 6, b) + dot(row.m_J + 9, b + 3);
	}
}

/// momentum += sum J^T lambda.
void btElasticPlasticSystem::addImpulses(std::vector<double>& momentum) const
{
	double onGround[6] = {};
	const auto of = [&](int body) { return body >= 0 ? &momentum[6 * size_t(body)] : onGround; };
	for (const Joint& joint : m_joints)
	{
		double sum[2][3] = {}, moment[3];
		for (int l = 0; l < joint.m_numLaws; ++l)
		{
			const int dof = joint.m_dof[l];
			addScaled(m_laws[joint.m_firstLaw + l].m_impulse, joint.m_axis[dof % 3], sum[dof / 3]);
		}
		for (int side = 0; side < 2; ++side)
		{
			double* to = of(joint.m_body[side]);
			const double sign = side == 0 ? 1 : -1;
			cross(joint.m_arm[side], sum[0], moment);
			addScaled(sign, sum[0], to);
			addScaled(sign, moment, to + 3);
			addScaled(sign, sum[1], to + 3);
		}
	}
	for (const Row& row : m_rows)
	{
		const double impulse = m_laws[row.m_law].m_impulse;
		for (int side = 0; side < 2; ++side)
		{
			double* to = of(row.m_body[side]);
			addScaled(impulse, row.m_J + 6 * side, to);
			addScaled(impulse, row.m_J + 6 * side + 3, to + 3);
		}
	}
}

void btElasticPlasticSystem::multiplyMass(const std::vector<double>& x, std::vector<double>& y) const
{
	for (size_t b = 0; b < m_bodies.size(); ++b)
		for (int i = 0; i < 3; ++i)
		{
			y[6 * b + i] = m_bodies[b].m_mass[i] * x[6 * b + i];
			y[6 * b + 3 + i] = dot(&m_bodies[b].m_inertia[3 * i], &x[6 * b + 3]);
		}
}

// ---- the matrix

/// Rows between the same bodies that follow each other have one edge.
int btElasticPlasticSystem::addEdge(const int body[2])
{
	if (body[0] < 0 || body[1] < 0)
		return -1;
	const size_t n = m_edges.size();
	if (n < 2 || m_edges[n - 2] != body[0] || m_edges[n - 1] != body[1])
		m_edges.insert(m_edges.end(), body, body + 2);
	return int(m_edges.size() / 2) - 1;
}

void btElasticPlasticSystem::findEdges()
{
	m_edges.clear();
	for (Joint& joint : m_joints)
		joint.m_edge = addEdge(joint.m_body);
	for (Row& row : m_rows)
		row.m_edge = addEdge(row.m_body);
}

void btElasticPlasticSystem::assemble()
{
	const btElasticPlasticLap lap("elastic-plastic assemble", m_statistics.m_assemblyTime);
	btElasticPlasticBlockMatrix& matrix = m_linearSolver.getMatrix();
	matrix.setZero();
	for (int b = 0; b < getNumBodies(); ++b)
	{
		double* block = matrix.diagonal(b);
		for (int i = 0; i < 3; ++i)
		{
			block[7 * i] = m_bodies[b].m_mass[i];
			memcpy(block + 6 * (3 + i) + 3, &m_bodies[b].m_inertia[3 * i], 3 * sizeof(double));
		}
	}
	m_changedBodies.clear();
	for (const Joint& joint : m_joints)
	{
		addToMatrix(joint);
		noteChange(joint.m_body, joint.m_firstLaw, joint.m_numLaws);
	}
	for (const Row& row : m_rows)
	{
		if (m_laws[row.m_law].m_bound == 0)
			addToMatrix(row);
		noteChange(row.m_body, row.m_law, 1);
	}
	m_matrixIsCurrent = true;
	m_linearSolver.setAssembled(m_changedBodies);
}

void btElasticPlasticSystem::noteChange(const int body[2], int firstLaw, int numLaws)
{
	bool changed = false;
	for (int l = firstLaw; l < firstLaw + numLaws; ++l)
	{
		const bool isIn = m_laws[l].m_bound == 0;
		changed |= isIn != m_laws[l].m_isInMatrix;
		m_laws[l].m_isInMatrix = isIn;
	}
	for (int side = 0; changed && side < 2; ++side)
		if (body[side] >= 0)
			m_changedBodies.push_back(body[side]);
}

namespace
{
/// A 6x6 block in four 3x3 parts, each by columns.
struct Parts
{
	double m_topLeft[9], m_bottomLeft[9], m_topRight[9], m_bottomRight[9];

	void addTo(double* block) const
	{
		for (int c = 0; c < 3; ++c)
			for (int r = 0; r < 3; ++r)
			{
				block[6 * c + r] += m_topLeft[3 * c + r];
				block[6 * c + 3 + r] += m_bottomLeft[3 * c + r];
				block[6 * (3 + c) + r] += m_topRight[3 * c + r];
				block[6 * (3 + c) + 3 + r] += m_bottomRight[3 * c + r];
			}
	}
};

/// to = sum w a a^T, lower is mirrored; a symmetric 3x3 matrix.
inline void addSquare(double w, const double* a, double* to)
{
	for (int c = 0; c < 3; ++c)
		for (int r = 0; r < 3; ++r)
			to[3 * c + r] += w * a[c] * a[r];
}
}  // namespace

/// With S = sum a a^T / C along the axes, U the same about them, and X the matrix of r x: the rows' squares sum up to
///     [ S     S X^T         ]
///     [ X S   X S X^T + U   ]   on a body, and to minus [ S, S XB^T; XA S, XA S XB^T + U ] between the two.
void btElasticPlasticSystem::addToMatrix(const Joint& joint)
{
	double square[2][9] = {};
	for (int l = 0; l < joint.m_numLaws; ++l)
	{
		const Law& law = m_laws[joint.m_firstLaw + l];
		if (law.m_bound == 0)
			addSquare(1 / law.m_compliance, joint.m_axis[joint.m_dof[l] % 3], square[joint.m_dof[l] / 3]);
	}
	// X S of both bodies; as S is symmetric, S X^T is its mirror image, and X S X^T the product of X with that.
	double moment[2][9], mirrored[2][9];
	for (int side = 0; side < 2; ++side)
	{
		for (int c = 0; c < 3; ++c)
			cross(joint.m_arm[side], square[0] + 3 * c, moment[side] + 3 * c);
		for (int c = 0; c < 3; ++c)
			for (int r = 0; r < 3; ++r)
				mirrored[side][3 * c + r] = moment[side][3 * r + c];
	}
	btElasticPlasticBlockMatrix& matrix = m_linearSolver.getMatrix();
	const auto parts = [&](int row, int column, double sign)
	{
		Parts p;
		for (int c = 0; c < 3; ++c)
			cross(joint.m_arm[row], mirrored[column] + 3 * c, p.m_bottomRight + 3 * c);
		for (int i = 0; i < 9; ++i)
		{
			p.m_topLeft[i] = sign * square[0][i];
			p.m_bottomLeft[i] = sign * moment[row][i];
			p.m_topRight[i] = sign * mirrored[column][i];
			p.m_bottomRight[i] = sign * (p.m_bottomRight[i] + square[1][i]);
		}
		return p;
	};
	for (int side = 0; side < 2; ++side)
		if (joint.m_body[side] >= 0)
			parts(side, side, 1).addTo(matrix.diagonal(joint.m_body[side]));
	if (joint.m_edge < 0)
		return;
	bool transposed;
	double* block = matrix.offDiagonal(joint.m_edge, transposed);
	parts(transposed, !transposed, -1).addTo(block);
}

void btElasticPlasticSystem::addToMatrix(const Row& row)
{
	btElasticPlasticBlockMatrix& matrix = m_linearSolver.getMatrix();
	const double weight = 1 / m_laws[row.m_law].m_compliance;
	const auto add = [weight](double* block, const double* x, const double* y)
	{
		for (int c = 0; c < 6; ++c)
			for (int r = 0; r < 6; ++r)
				block[6 * c + r] += weight * x[r] * y[c];
	};
	for (int side = 0; side < 2; ++side)
		if (row.m_body[side] >= 0)
			add(matrix.diagonal(row.m_body[side]), row.m_J + 6 * side, row.m_J + 6 * side);
	if (row.m_edge < 0)
		return;
	bool transposed;
	double* block = matrix.offDiagonal(row.m_edge, transposed);
	add(block, row.m_J + (transposed ? 6 : 0), row.m_J + (transposed ? 0 : 6));
}

/// x = H^-1 x for the rows' present bounds.
bool btElasticPlasticSystem::solveLinear(std::vector<double>& x)
{
	if (!m_matrixIsCurrent)
		assemble();
	return m_linearSolver.solve(x);
}

// ---- the function

/// Impulses and bounds of all rows at dv.
void btElasticPlasticSystem::evaluate()
{
	const btElasticPlasticLap lap("elastic-plastic search", m_statistics.m_searchTime);
	project(m_velocity, m_along);
	m_boundsChanged = false;
	for (size_t l = 0; l < m_laws.size(); ++l)
	{
		Law& law = m_laws[l];
		const double impulse = (law.m_target - m_along[l]) / law.m_compliance;
		// Bounds without room between them, of friction where nothing presses, leave nothing to choose: on which side an impulse
		// of rounding's size lies must not count as a change.
		const signed char bound = impulse > law.m_upper || law.m_lower == law.m_upper ? 1
								  : impulse < law.m_lower                             ? -1
																					  : 0;
		law.m_impulse = bound > 0 ? law.m_upper : bound < 0 ? law.m_lower : impulse;
		m_boundsChanged |= bound != law.m_bound;
		law.m_bound = bound;
	}
	if (m_boundsChanged)
		m_matrixIsCurrent = false;
}

/// The residual that belongs to the last evaluate(). \return phi
double btElasticPlasticSystem::findResidual()
{
	const btElasticPlasticLap lap("elastic-plastic search", m_statistics.m_searchTime);
	double phi = 0;
	for (size_t l = 0; l < m_laws.size(); ++l)
	{
		// psi is u^2 / 2C between the bounds and goes on straight beyond them.
		const Law& law = m_laws[l];
		phi += law.m_impulse * (law.m_target - m_along[l] - 0.5 * law.m_compliance * law.m_impulse);
	}
	multiplyMass(m_velocity, m_residual);
	for (size_t i = 0; i < m_residual.size(); ++i)
	{
		phi += 0.5 * m_velocity[i] * m_residual[i];
		m_residual[i] = -m_residual[i];
	}
	addImpulses(m_residual);
	return phi;
}

// ---- the search

/// dv for the rows' present bounds as if they were right.
bool btElasticPlasticSystem::guess()
{
	for (Law& law : m_laws)
		law.m_impulse = law.m_bound == 0  ? law.m_target / law.m_compliance
						: law.m_bound > 0 ? law.m_upper
										  : law.m_lower;
	std::fill(m_velocity.begin(), m_velocity.end(), 0.);
	addImpulses(m_velocity);
	return solveLinear(m_velocity);
}

bool btElasticPlasticSystem::newton()
{
	evaluate();
	// With the bounds that were guessed, dv solves a linear problem, exactly.
	if (!m_boundsChanged)
		return true;
	double phi = findResidual();
	for (int step = 0; step < m_maxNewtonSteps; ++step)
	{
		m_step = m_residual;
		if (!solveLinear(m_step))
			return false;
		++m_statistics.m_newtonSteps;
		double slope = 0;
		for (size_t i = 0; i < m_step.size(); ++i)
			slope -= m_residual[i] * m_step[i];
		m_start = m_velocity;
		move(1);
		evaluate();
		// So does a full step that changes no bound.
		if (!m_boundsChanged)
			return true;
		const double before = phi;
		phi = findResidual();
		if (phi <= before + 1e-4 * slope + 1e-14 * fabs(before))
			continue;
		move(exactLength());
		evaluate();
		phi = findResidual();
		if (!(phi == phi))
			return false;
	}
	return false;
}

void btElasticPlasticSystem::move(double length)
{
	for (size_t i = 0; i < m_step.size(); ++i)
		m_velocity[i] = m_start[i] + length * m_step[i];
}

/// Where phi is least along the step from the start, between 0 and 1. Its derivative there is monotonous and piecewise linear,
/// with a kink wherever a row reaches a bound: Newton's method, kept in the bracket, ends exactly. Halving the step would not
/// do: rows of little compliance bend phi almost like an edge, and the search would zigzag along it.
double btElasticPlasticSystem::exactLength()
{
	const btElasticPlasticLap lap("elastic-plastic search", m_statistics.m_searchTime);
	m_work.resize(m_step.size());
	multiplyMass(m_step, m_work);
	double along0 = 0, along1 = 0;
	for (size_t i = 0; i < m_step.size(); ++i)
	{
		along0 += m_work[i] * m_start[i];
		along1 += m_work[i] * m_step[i];
	}
	project(m_start, m_alongStart);
	project(m_step, m_along);
	double low = 0, high = 1, t = 1;
	for (int i = 0; i < 60 && high - low > 1e-15; ++i)
	{
		double derivative = along0 + t * along1, second = along1;
		for (size_t l = 0; l < m_laws.size(); ++l)
		{
			const Law& law = m_laws[l];
			const double impulse = (law.m_target - m_alongStart[l] - t * m_along[l]) / law.m_compliance;
			derivative -= m_along[l] * std::max(law.m_lower, std::min(law.m_upper, impulse));
			if (impulse > law.m_lower && impulse < law.m_upper)
				second += m_along[l] * m_along[l] / law.m_compliance;
		}
		(derivative > 0 ? high : low) = t;
		const double next = t - derivative / second;
		if (fabs(next - t) <= 1e-14)
			break;
		t = next > low && next < high ? next : (low + high) / 2;
	}
	return t;
}

/// One loop of the augmented Lagrangian: multipliers follow impulses, friction's bounds follow normal impulses.
/// \return whether anything changed that matters
bool btElasticPlasticSystem::tightenContacts()
{
	double slip = 0, fastest = 1e-9, frictionChange = 0, strongest = 1e-12;
	for (Row& row : m_rows)
	{
		if (!row.m_isContact)
			continue;
		Law& law = m_laws[row.m_law];
		slip = std::max(slip, law.m_compliance * fabs(law.m_impulse - row.m_multiplier));
		fastest = std::max(fastest, fabs(row.m_target));
		row.m_multiplier = law.m_impulse;
		law.m_target = row.m_target + law.m_compliance * row.m_multiplier;
	}
	for (const Row& row : m_rows)
	{
		if (row.m_normal < 0)
			continue;
		Law& law = m_laws[row.m_law];
		double bound = row.m_friction * std::max(0., m_laws[m_rows[row.m_normal].m_law].m_impulse);
		if (row.m_frictionMax > 0)
			bound = std::min(bound, row.m_frictionMax);
		frictionChange = std::max(frictionChange, fabs(bound - law.m_upper));
		strongest = std::max(strongest, bound);
		law.m_upper = bound;
		law.m_lower = -bound;
	}
	return slip > m_contactTolerance * fastest || frictionChange > 0.01 * strongest;
}

bool btElasticPlasticSystem::search()
{
	bool hasContacts = false;
	for (Row& row : m_rows)
		if (row.m_isContact)
		{
			hasContacts = true;
			row.m_target = m_laws[row.m_law].m_target;
		}
	if (hasContacts)
		tightenContacts();
	bool solved = guess() && newton();
	for (int loop = 0; solved && hasContacts && loop < m_maxContactLoops && tightenContacts(); ++loop)
	{
		++m_statistics.m_contactLoops;
		// The right sides have changed: even with the same bounds there is a step to make.
		solved = guess() && newton();
	}
	for (double v : m_velocity)
		solved = solved && fabs(v) < 1e30;
	return solved;
}

bool btElasticPlasticSystem::solve(int& ticket)
{
	++m_statistics.m_islands;
	m_statistics.m_rows += int(m_laws.size());
	findEdges();
	m_linearSolver.begin(getNumBodies(), m_edges, ticket);
	ticket = m_linearSolver.getTicket();
	m_matrixIsCurrent = false;
	m_velocity.assign(6 * size_t(getNumBodies()), 0.);
	m_residual.resize(m_velocity.size());
	return search();
}
