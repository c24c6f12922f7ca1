// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Jacobian.h"

#include <algorithm>

#include "../joint/SectionStiffness.h"
#include "../linear/Vector3.h"

namespace btElasticPlastic
{
namespace
{
const double AT_REST[6] = {};

inline void addScaled(double factor, const double* a, double* to)
{
	for (int i = 0; i < 3; ++i)
		to[i] += factor * a[i];
}

/// Adds the force and the moments of a unit's fibres.
void addFibres(const SystemInput& input, const SystemInput::Unit& unit, const double* impulses, double sum[2][3])
{
	if (unit.m_numFibres == 0)
		return;
	SectionSum fibres;
	for (int i = 0; i < unit.m_numFibres; ++i)
		fibres.add(input.m_fibres[size_t(unit.m_firstFibre + i)], impulses[i]);
	const SectionForces forces = fibres.get();
	addScaled(forces.m_axial, unit.m_axis[0], sum[0]);
	addScaled(forces.m_momentY, unit.m_axis[1], sum[1]);
	addScaled(forces.m_momentZ, unit.m_axis[2], sum[1]);
}

const double* velocityOf(const std::vector<double>& velocity, int body)
{
	return body >= 0 ? &velocity[6 * size_t(body)] : AT_REST;
}

void projectUnit(const SystemInput& input, const SystemInput::Unit& unit, const std::vector<double>& velocity,
				 double* along)
{
	const double *const a = velocityOf(velocity, unit.m_body[0]), *const b = velocityOf(velocity, unit.m_body[1]);
	double turnA[3], turnB[3], relative[2][3];
	cross(a + 3, unit.m_arm[0], turnA);
	cross(b + 3, unit.m_arm[1], turnB);
	for (int i = 0; i < 3; ++i)
	{
		relative[0][i] = a[i] + turnA[i] - b[i] - turnB[i];
		relative[1][i] = a[3 + i] - b[3 + i];
	}
	double onAxis[6];
	for (int axis = 0; axis < 3; ++axis)
	{
		onAxis[axis] = dot(unit.m_axis[axis], relative[0]);
		onAxis[3 + axis] = dot(unit.m_axis[axis], relative[1]);
	}
	const int numPlain = unit.getNumPlainRows();
	const double first = onAxis[0] + unit.m_place[1] * onAxis[4] - unit.m_place[0] * onAxis[5];
	for (int r = 0; r < numPlain; ++r)
		along[r] = unit.m_dof[r] == 0 ? first : onAxis[unit.m_dof[r]];
	for (int i = 0; i < unit.m_numFibres; ++i)
	{
		const SystemInput::Fibre& fibre = input.m_fibres[size_t(unit.m_firstFibre + i)];
		along[numPlain + i] = onAxis[0] + fibre.m_z * onAxis[4] - fibre.m_y * onAxis[5];
	}
}

double projectRow(const SystemInput::SingleRow& row, const std::vector<double>& velocity)
{
	const double *const a = velocityOf(velocity, row.m_body[0]), *const b = velocityOf(velocity, row.m_body[1]);
	return dot(row.m_J, a) + dot(row.m_J + 3, a + 3) + dot(row.m_J + 6, b) + dot(row.m_J + 9, b + 3);
}
}  // namespace

void project(const SystemInput& input, const std::vector<double>& velocity, std::vector<double>& along)
{
	along.resize(input.m_rows.size());
	for (const SystemInput::Unit& unit : input.m_units)
		projectUnit(input, unit, velocity, &along[unit.m_firstRow]);
	for (const SystemInput::SingleRow& row : input.m_singleRows)
		along[row.m_row] = projectRow(row, velocity);
}

void takeFromTargets(SystemInput& input, const std::vector<double>& velocity, const std::vector<char>& isChanged,
					 const AskedRows& asked)
{
	const auto hasChanged = [&](int body) { return body >= 0 && isChanged[size_t(body)] != 0; };
	std::vector<double> along;
	for (const SystemInput::Unit& unit : input.m_units)
	{
		if (!hasChanged(unit.m_body[0]) && !hasChanged(unit.m_body[1]))
			continue;
		along.resize(size_t(unit.m_numRows));
		projectUnit(input, unit, velocity, along.data());
		for (int r = 0; r < unit.m_numRows; ++r)
		{
			const size_t i = size_t(unit.m_firstRow + r);
			input.m_rows[i].m_target = asked.m_targets[i] - along[size_t(r)];
		}
	}
	for (size_t i = 0; i < input.m_singleRows.size(); ++i)
	{
		const SystemInput::SingleRow& row = input.m_singleRows[i];
		SystemInput::Bounded& bounded = input.m_rows[size_t(row.m_row)];
		bounded = asked.m_singleRows[i];
		bounded.m_target -= projectRow(row, velocity);
	}
}

void AskedRows::read(const SystemInput& input)
{
	m_targets.reserve(input.m_rows.capacity());
	m_targets.resize(input.m_rows.size());
	for (size_t i = 0; i < m_targets.size(); ++i)
		m_targets[i] = input.m_rows[i].m_target;
	m_singleRows.resize(input.m_singleRows.size());
	for (size_t i = 0; i < m_singleRows.size(); ++i)
		m_singleRows[i] = input.m_rows[size_t(input.m_singleRows[i].m_row)];
}

void addImpulses(const SystemInput& input, const double* impulses, std::vector<double>& momentum)
{
	double onGround[6] = {};
	const auto of = [&](int body) { return body >= 0 ? &momentum[6 * size_t(body)] : onGround; };
	for (const SystemInput::Unit& unit : input.m_units)
	{
		double onAxis[6] = {}, sum[2][3] = {}, moment[3];
		for (int r = 0; r < unit.getNumPlainRows(); ++r)
			onAxis[unit.m_dof[r]] = impulses[unit.m_firstRow + r];
		onAxis[4] += unit.m_place[1] * onAxis[0];
		onAxis[5] -= unit.m_place[0] * onAxis[0];
		for (int axis = 0; axis < 3; ++axis)
		{
			addScaled(onAxis[axis], unit.m_axis[axis], sum[0]);
			addScaled(onAxis[3 + axis], unit.m_axis[axis], sum[1]);
		}
		addFibres(input, unit, impulses + unit.getFirstFibreRow(), sum);
		for (int side = 0; side < 2; ++side)
		{
			double* to = of(unit.m_body[side]);
			const double sign = side == 0 ? 1 : -1;
			cross(unit.m_arm[side], sum[0], moment);
			addScaled(sign, sum[0], to);
			addScaled(sign, moment, to + 3);
			addScaled(sign, sum[1], to + 3);
		}
	}
	for (const SystemInput::SingleRow& row : input.m_singleRows)
		addImpulse(row.m_body, row.m_J, impulses[row.m_row], momentum);
}

void addImpulse(const int body[2], const double J[12], double impulse, std::vector<double>& momentum)
{
	for (int side = 0; side < 2; ++side)
	{
		if (body[side] < 0)
			continue;
		double* const to = &momentum[6 * size_t(body[side])];
		addScaled(impulse, J + 6 * side, to);
		addScaled(impulse, J + 6 * side + 3, to + 3);
	}
}

void getJacobian(const SystemInput& input, int row, int body[2], double J[12])
{
	const auto single = std::lower_bound(input.m_singleRows.begin(), input.m_singleRows.end(), row,
										 [](const SystemInput::SingleRow& a, int r) { return a.m_row < r; });
	if (single != input.m_singleRows.end() && single->m_row == row)
	{
		std::copy(single->m_body, single->m_body + 2, body);
		std::copy(single->m_J, single->m_J + 12, J);
		return;
	}
	const SystemInput::Unit& unit =
		*(std::upper_bound(input.m_units.begin(), input.m_units.end(), row,
						   [](int r, const SystemInput::Unit& a) { return r < a.m_firstRow; }) -
		  1);
	// Along the unit's three axes, and about them.
	double onAxis[6] = {};
	const int r = row - unit.m_firstRow, fibre = r - unit.getNumPlainRows();
	const int dof = fibre < 0 ? unit.m_dof[r] : 0;
	onAxis[dof] = 1;
	if (dof == 0)
	{
		const SystemInput::Fibre* const own = fibre < 0 ? nullptr : &input.m_fibres[size_t(unit.m_firstFibre + fibre)];
		onAxis[4] = own ? own->m_z : unit.m_place[1];
		onAxis[5] = -(own ? own->m_y : unit.m_place[0]);
	}
	double along[3] = {}, about[3] = {}, moment[3];
	for (int axis = 0; axis < 3; ++axis)
	{
		addScaled(onAxis[axis], unit.m_axis[axis], along);
		addScaled(onAxis[3 + axis], unit.m_axis[axis], about);
	}
	for (int side = 0; side < 2; ++side)
	{
		const double sign = side == 0 ? 1 : -1;
		body[side] = unit.m_body[side];
		cross(unit.m_arm[side], along, moment);
		for (int i = 0; i < 3; ++i)
		{
			J[6 * side + i] = sign * along[i];
			J[6 * side + 3 + i] = sign * (moment[i] + about[i]);
		}
	}
}

void multiplyMass(const SystemInput& input, const std::vector<double>& x, std::vector<double>& y)
{
	for (size_t b = 0; b < input.m_bodies.size(); ++b)
		for (int i = 0; i < 3; ++i)
		{
			y[6 * b + i] = input.m_bodies[b].m_mass[i] * x[6 * b + i];
			y[6 * b + 3 + i] = dot(&input.m_bodies[b].m_inertia[3 * i], &x[6 * b + 3]);
		}
	const SystemInput::Condensed& condensed = input.m_condensed;
	const size_t n = condensed.m_bodies.size();
	for (size_t j = 0; j < 6 * n; ++j)
	{
		const double factor = x[6 * size_t(condensed.m_bodies[j / 6]) + j % 6];
		const double* const column = &condensed.m_matrix[6 * n * j];
		for (size_t b = 0; b < n; ++b)
			for (size_t k = 0; k < 6; ++k)
				y[6 * size_t(condensed.m_bodies[b]) + k] += factor * column[6 * b + k];
	}
}

void addCondensedMomentum(const SystemInput& input, std::vector<double>& momentum)
{
	const SystemInput::Condensed& condensed = input.m_condensed;
	for (size_t b = 0; b < condensed.m_bodies.size(); ++b)
		for (size_t i = 0; i < 6; ++i)
			momentum[6 * size_t(condensed.m_bodies[b]) + i] += condensed.m_momentum[6 * b + i];
}

void divideByMass(const SystemInput& input, std::vector<double>& x)
{
	for (size_t b = 0; b < input.m_bodies.size(); ++b)
	{
		const SystemInput::Body& body = input.m_bodies[b];
		double* const v = &x[6 * b];
		for (int i = 0; i < 3; ++i)
			v[i] /= body.m_mass[i];
		// The columns of the symmetric inertia, and the inverse by their cross products.
		const double *const c0 = body.m_inertia, *const c1 = c0 + 3, *const c2 = c0 + 6;
		double across[3][3], turned[3] = {};
		cross(c1, c2, across[0]);
		cross(c2, c0, across[1]);
		cross(c0, c1, across[2]);
		const double determinant = dot(c0, across[0]);
		for (int i = 0; i < 3; ++i)
			turned[i] = dot(across[i], v + 3) / determinant;
		for (int i = 0; i < 3; ++i)
			v[3 + i] = turned[i];
	}
}
}  // namespace btElasticPlastic
