// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "FibreBlock.h"

#include <math.h>

#include <algorithm>

namespace btElasticPlastic
{
namespace
{
/// Newton's steps in an iteration. One or two are enough where no fibre begins or ends to flow; what these leave is for the next iteration.
const int MOST_STEPS = 20;
}  // namespace

FibreBlock::Triple FibreBlock::Matrix::operator*(const Triple& v) const
{
	Triple product;
	for (int i = 0; i < 3; ++i)
		product.m_x[i] = m_x[i][0] * v.m_x[0] + m_x[i][1] * v.m_x[1] + m_x[i][2] * v.m_x[2];
	return product;
}

void FibreBlock::begin(const JointRows& rows, int firstRow, const SolverPools& pools)
{
	m_firstRow = firstRow;
	m_fibres.clear();
	m_impulses.assign(size_t(rows.m_numFibres), 0);
	m_bounds.assign(size_t(rows.m_numFibres), 0);
	const double hardest = HARD * double(rows.m_fibreDiagonal);
	for (int i = 0; i < rows.m_numFibres; ++i)
	{
		const JointRows::Fibre& from = rows.m_fibres[i];
		m_fibres.push_back({double(from.m_soft.m_velocity),
							btMax(double(from.m_soft.m_compliance), hardest),
							double(from.m_soft.m_lower),
							double(from.m_soft.m_upper),
							{{1, double(from.m_z), -double(from.m_y)}}});
	}
	for (int i = 0; i < 3; ++i)
		for (int k = 0; k < 3; ++k)
		{
			// What an impulse along one row does to another.
			const btSolverConstraint &row = pools.m_constraints[firstRow + i], &by = pools.m_constraints[firstRow + k];
			const btSolverBody &A = pools.m_bodies[row.m_solverBodyIdA], &B = pools.m_bodies[row.m_solverBodyIdB];
			m_response.m_x[i][k] =
				double(row.m_contactNormal1.dot(by.m_contactNormal1 * A.internalGetInvMass() * A.m_linearFactor) +
					   row.m_relpos1CrossNormal.dot(by.m_angularComponentA * A.m_angularFactor) +
					   row.m_contactNormal2.dot(by.m_contactNormal2 * B.internalGetInvMass() * B.m_linearFactor) +
					   row.m_relpos2CrossNormal.dot(by.m_angularComponentB * B.m_angularFactor));
		}
	set(Triple(), pools);
}

/// Of the three rows, forces from outside included.
FibreBlock::Triple FibreBlock::velocityOf(const SolverPools& pools) const
{
	Triple velocity;
	for (int i = 0; i < 3; ++i)
	{
		const btSolverConstraint& row = pools.m_constraints[m_firstRow + i];
		const btSolverBody &A = pools.m_bodies[row.m_solverBodyIdA], &B = pools.m_bodies[row.m_solverBodyIdB];
		velocity.m_x[i] = double(
			row.m_contactNormal1.dot(A.m_linearVelocity + A.m_externalForceImpulse + A.m_deltaLinearVelocity) +
			row.m_relpos1CrossNormal.dot(A.m_angularVelocity + A.m_externalTorqueImpulse + A.m_deltaAngularVelocity) +
			row.m_contactNormal2.dot(B.m_linearVelocity + B.m_externalForceImpulse + B.m_deltaLinearVelocity) +
			row.m_relpos2CrossNormal.dot(B.m_angularVelocity + B.m_externalTorqueImpulse + B.m_deltaAngularVelocity));
	}
	return velocity;
}

/// The fibres' impulses and bounds at the velocities of the three rows. \return whether one is at another bound than before
bool FibreBlock::sumAt(const Triple& velocity, Triple& sum)
{
	bool hasChanged = false;
	sum = Triple();
	for (size_t i = 0; i < m_fibres.size(); ++i)
	{
		const Fibre& fibre = m_fibres[i];
		const double free = (fibre.m_target - fibre.velocityAt(velocity)) / fibre.m_compliance;
		const signed char bound = free >= fibre.m_upper || fibre.m_lower == fibre.m_upper ? 1
								  : free <= fibre.m_lower                                 ? -1
																						  : 0;
		hasChanged |= bound != m_bounds[i];
		m_bounds[i] = bound;
		m_impulses[i] = bound > 0 ? fibre.m_upper : bound < 0 ? fibre.m_lower : free;
		sum.add(m_impulses[i], fibre.m_place);
	}
	return hasChanged;
}

/// How much less the fibres between their bounds add up to by a velocity.
FibreBlock::Matrix FibreBlock::tangent() const
{
	Matrix tangent = {};
	for (size_t f = 0; f < m_fibres.size(); ++f)
	{
		if (m_bounds[f] != 0)
			continue;
		const Fibre& fibre = m_fibres[f];
		for (int i = 0; i < 3; ++i)
			for (int k = 0; k < 3; ++k)
				tangent.m_x[i][k] += fibre.m_place.m_x[i] * fibre.m_place.m_x[k] / fibre.m_compliance;
	}
	return tangent;
}

/// Newton's step (1 + K A)^-1 e for the error e, sum f - s, with K of the present bounds.
FibreBlock::Triple FibreBlock::findStep(const Triple& error) const
{
	const Matrix slope = tangent();
	double m[3][3];
	for (int i = 0; i < 3; ++i)
		for (int k = 0; k < 3; ++k)
		{
			m[i][k] = i == k ? 1 : 0;
			for (int j = 0; j < 3; ++j)
				m[i][k] += slope.m_x[i][j] * m_response.m_x[j][k];
		}
	// Elimination with the largest pivot of what is left.
	Triple x = error;
	int order[3] = {0, 1, 2};
	for (int p = 0; p < 3; ++p)
	{
		int best = p;
		for (int i = p + 1; i < 3; ++i)
			if (fabs(m[order[i]][p]) > fabs(m[order[best]][p]))
				best = i;
		btSwap(order[p], order[best]);
		const int row = order[p];
		for (int i = p + 1; i < 3; ++i)
		{
			const double factor = m[order[i]][p] / m[row][p];
			for (int k = p; k < 3; ++k)
				m[order[i]][k] -= factor * m[row][k];
			x.m_x[order[i]] -= factor * x.m_x[row];
		}
	}
	Triple step = {};
	for (int p = 2; p >= 0; --p)
	{
		double sum = x.m_x[order[p]];
		for (int k = p + 1; k < 3; ++k)
			sum -= m[order[p]][k] * step.m_x[k];
		step.m_x[p] = sum / m[order[p]][p];
	}
	return step;
}

/// Applies an impulse in place of the one before. Bullet keeps rows whose bounds are what they have.
void FibreBlock::set(const Triple& sum, const SolverPools& pools)
{
	for (int i = 0; i < 3; ++i)
	{
		btSolverConstraint& row = pools.m_constraints[m_firstRow + i];
		btSolverBody &A = pools.m_bodies[row.m_solverBodyIdA], &B = pools.m_bodies[row.m_solverBodyIdB];
		const btScalar before = row.m_appliedImpulse;
		row.m_appliedImpulse = row.m_lowerLimit = row.m_upperLimit = btScalar(sum.m_x[i]);
		const btScalar change = row.m_appliedImpulse - before;
		A.internalApplyImpulse(row.m_contactNormal1 * A.internalGetInvMass(), row.m_angularComponentA, change);
		B.internalApplyImpulse(row.m_contactNormal2 * B.internalGetInvMass(), row.m_angularComponentB, change);
	}
	m_sum = sum;
}

/// The share of a step at which the convex function is at its least along it, at most 1. Its slope rises from kink to kink, where fibres leave
/// a bound or come to one.
/// \param velocity  with which the step begins
/// \param along     by which the step changes it
/// \param slope     at the beginning, negative
/// \param rise      of the slope, of bodies alone
double FibreBlock::findLeast(const Triple& velocity, const Triple& along, double slope, double rise)
{
	m_kinks.clear();
	for (const Fibre& fibre : m_fibres)
	{
		const double rate = fibre.velocityAt(along), left = fibre.m_target - fibre.velocityAt(velocity);
		if (rate == 0)
			continue;
		const double ends[2] = {(left - fibre.m_compliance * fibre.m_upper) / rate,
								(left - fibre.m_compliance * fibre.m_lower) / rate};
		const double first = btMin(ends[0], ends[1]), last = btMax(ends[0], ends[1]),
					 own = rate * rate / fibre.m_compliance;
		if (!(last > 0) || !(first < 1))
			continue;
		if (first <= 0)
			rise += own;
		else
			m_kinks.push_back({first, own});
		m_kinks.push_back({last, -own});
	}
	std::sort(m_kinks.begin(), m_kinks.end(), [](const Kink& a, const Kink& b) { return a.m_share < b.m_share; });
	double share = 0;
	for (const Kink& kink : m_kinks)
	{
		const double there = slope + rise * (kink.m_share - share);
		if (there >= 0)
			break;
		slope = there;
		share = kink.m_share;
		rise += kink.m_change;
	}
	return rise > 0 ? btMin(share - slope / rise, 1.) : 1.;
}

btScalar FibreBlock::solve(const SolverPools& pools)
{
	const Triple before = m_sum;
	Triple s = before, velocity = velocityOf(pools), sum;
	sumAt(velocity, sum);
	for (int k = 0; k < MOST_STEPS; ++k)
	{
		Triple error = sum;
		error.add(-1, s);
		const Triple step = findStep(error), along = m_response * step;
		Triple end = velocity;
		end.add(1, along);
		// If no fibre changes its bound on the way the step ends at the solution.
		const bool isLast = !sumAt(end, sum);
		const double share = isLast ? 1. : findLeast(velocity, along, -error.dot(along), step.dot(along));
		s.add(share, step);
		velocity.add(share, along);
		if (share < 1)
			sumAt(velocity, sum);
		if (isLast)
			break;
	}
	Triple change = s;
	change.add(-1, before);
	if (!(change.dot(change) < double(BT_LARGE_FLOAT)))
		return 0;
	set(s, pools);
	const Triple moved = m_response * change;
	double largest = 0;
	for (const double x : moved.m_x)
		largest = btMax(largest, x * x);
	return btScalar(largest);
}
}  // namespace btElasticPlastic
