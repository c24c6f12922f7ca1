// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "CoupledBundle.h"

namespace btElasticPlastic
{
namespace
{
/// Sets of bounds that are tried, each with its own linear problem. Two or three are enough but for rare cases, which are bisected.
const int MOST_TRIALS = 12;
/// Halvings of an interval, down to the last digits of a double.
const int HALVINGS = 100;
}  // namespace

CoupledBundle::Matrix CoupledBundle::Matrix::inverse(bool isFirstFree, bool isSecondFree) const
{
	const double* const m = m_elements;
	if (!isFirstFree || !isSecondFree)
		return {{isFirstFree ? 1 / m[0] : 0., 0., isSecondFree ? 1 / m[2] : 0.}};
	const double determinant = m[0] * m[2] - m[1] * m[1];
	return {{m[2] / determinant, -m[1] / determinant, m[0] / determinant}};
}

void CoupledBundle::hold()
{
	Matrix matrix = {{m_shear[0].m_compliance, 0, m_shear[1].m_compliance}};
	double right[2] = {m_shear[0].m_target, m_shear[1].m_target};
	for (Fibre& fibre : m_fibres)
	{
		const double tangent = fibre.m_bound == 0 ? 1 / fibre.m_compliance : 0;
		fibre.m_force = fibre.m_bound == 0 ? fibre.m_target * tangent : atBound(fibre);
		matrix.subtract(tangent, fibre.m_coupling);
		for (int s = 0; s < 2; ++s)
			right[s] -= fibre.m_coupling[s] * fibre.m_force;
	}
	const bool isFree[2] = {m_shear[0].m_bound == 0, m_shear[1].m_bound == 0};
	for (int s = 0; s < 2; ++s)
		if (!isFree[s])
		{
			m_shear[s].m_force = atBound(m_shear[s]);
			right[1 - s] -= matrix.m_elements[1] * m_shear[s].m_force;
		}
	const Matrix inverse = matrix.inverse(isFree[0], isFree[1]);
	for (int s = 0; s < 2; ++s)
		if (isFree[s])
			m_shear[s].m_force = inverse.multiply(s, right);
	for (Fibre& fibre : m_fibres)
		if (fibre.m_bound == 0)
			fibre.m_force -= (fibre.m_coupling[0] * m_shear[0].m_force + fibre.m_coupling[1] * m_shear[1].m_force) /
							 fibre.m_compliance;
}

/// The fibre's force and bound for the present shears.
void CoupledBundle::follow(Fibre& fibre) const
{
	const double force =
		(fibre.m_target - fibre.m_coupling[0] * m_shear[0].m_force - fibre.m_coupling[1] * m_shear[1].m_force) /
		fibre.m_compliance;
	fibre.m_bound = side(fibre, force);
	fibre.m_force = fibre.m_bound == 0 ? force : atBound(fibre);
}

/// What a shear has more than its deformation, with fibres that follow: it grows with the shear's force.
double CoupledBundle::rest(int s)
{
	double sum = m_shear[s].m_compliance * m_shear[s].m_force - m_shear[s].m_target;
	for (Fibre& fibre : m_fibres)
	{
		follow(fibre);
		sum += fibre.m_coupling[s] * fibre.m_force;
	}
	return sum;
}

/// Takes the bounds that follow from the forces of hold(). \return whether they are the same
bool CoupledBundle::takeBounds()
{
	bool isSame = true;
	const signed char before[2] = {m_shear[0].m_bound, m_shear[1].m_bound};
	for (int s = 0; s < 2; ++s)
		if (before[s] == 0)
		{
			Spring& shear = m_shear[s];
			shear.m_bound = side(shear, shear.m_force);
			shear.m_force = shear.m_bound == 0 ? shear.m_force : atBound(shear);
			isSame &= shear.m_bound == 0;
		}
	double pressing[2] = {m_shear[0].m_compliance * m_shear[0].m_force - m_shear[0].m_target,
						  m_shear[1].m_compliance * m_shear[1].m_force - m_shear[1].m_target};
	for (Fibre& fibre : m_fibres)
	{
		const signed char bound = fibre.m_bound;
		follow(fibre);
		isSame &= bound == fibre.m_bound;
		for (int s = 0; s < 2; ++s)
			pressing[s] += fibre.m_coupling[s] * fibre.m_force;
	}
	for (int s = 0; s < 2; ++s)
		if (before[s] != 0 && m_shear[s].m_lower != m_shear[s].m_upper && pressing[s] * before[s] > 0)
		{
			m_shear[s].m_bound = 0;
			isSame = false;
		}
	return isSame;
}

void CoupledBundle::project()
{
	for (int i = 0; i < MOST_TRIALS; ++i)
	{
		hold();
		if (takeBounds())
			return;
	}
	findShear(0, true);
}

/// Bisects one shear's force, with the other one's where it belongs.
void CoupledBundle::findShear(int s, bool withOther)
{
	Spring& shear = m_shear[s];
	const auto restAt = [&](double force)
	{
		shear.m_force = force;
		if (withOther)
			findShear(1 - s, false);
		return rest(s);
	};
	double low = shear.m_lower, high = shear.m_upper;
	shear.m_bound = 1;
	if (restAt(high) <= 0)
		return;
	shear.m_bound = -1;
	if (restAt(low) >= 0)
		return;
	shear.m_bound = 0;
	for (int i = 0; i < HALVINGS; ++i)
	{
		const double middle = low + (high - low) / 2;
		(restAt(middle) > 0 ? high : low) = middle;
	}
	restAt(low + (high - low) / 2);
}
}  // namespace btElasticPlastic
