// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_UNIT_TANGENT_H
#define BT_ELASTIC_PLASTIC_UNIT_TANGENT_H

#include "../joint/CoupledBundle.h"
#include "../Cancelled.h"
#include "SystemInput.h"

namespace btElasticPlastic
{
/// to += weight a b^T, 3x3 by columns.
inline void addOuterProduct(double weight, const double a[3], const double b[3], double to[9])
{
	for (int c = 0; c < 3; ++c)
		for (int k = 0; k < 3; ++k)
			to[3 * c + k] += weight * b[c] * a[k];
}

/// to += sum of weight a a^T over three axes, 3x3 by columns.
inline void addOuterProducts(const double weights[3], const double axes[3][3], double to[9])
{
	for (int c = 0; c < 3; ++c)
	{
		const double x = weights[0] * axes[0][c], y = weights[1] * axes[1][c], z = weights[2] * axes[2][c];
		for (int k = 0; k < 3; ++k)
			to[3 * c + k] += x * axes[0][k] + y * axes[1][k] + z * axes[2][k];
	}
}

/// The tangent of a unit's fibres, sum of g g^T t with g = (1, z, -y) along the first axis and about the other two.
struct FibreTangent
{
	double m_axial = 0;
	double m_mixed[2] = {0, 0};     ///< axial with either turn
	double m_turns[3] = {0, 0, 0};  ///< yy, yz, zz

	void add(double t, double y, double z)
	{
		const double byZ = t * z, byY = t * -y;
		m_axial += t;
		m_mixed[0] += byZ;
		m_mixed[1] += byY;
		m_turns[0] += byZ * z;
		m_turns[1] += byZ * -y;
		m_turns[2] += byY * -y;
	}

	/// Takes out what is rounding where fibres are on both sides of an axis.
	void cancel()
	{
		m_mixed[0] = cancelledProduct(m_mixed[0], m_axial, m_turns[0]);
		m_mixed[1] = cancelledProduct(m_mixed[1], m_axial, m_turns[2]);
		m_turns[1] = cancelledProduct(m_turns[1], m_turns[0], m_turns[2]);
	}
};

/// Where fibres are coupled with the shears, with the inverse P that CoupledBundle::Matrix gives, their tangent is Q P Q^T more, with a column
/// of Q by shear: its own direction less sum t b g.
template <class Tangents>
void addBundleTangent(const Tangents& tangents, const SystemInput& input, const SystemInput::Unit& unit,
					  double linear[9], double angular[9], double mixed[9])
{
	// Along the three axes, and about the second and third one.
	double q[2][5] = {};
	const int firstCoupling = input.m_bundles[size_t(unit.m_bundle)].m_firstCoupling;
	for (int i = 0; i < unit.m_numFibres; ++i)
	{
		const SystemInput::Fibre& fibre = input.m_fibres[size_t(unit.m_firstFibre + i)];
		const double* const coupling = input.m_couplings[size_t(firstCoupling + i)].m_shear;
		const double t = tangents.getTangent(input, unit.getFirstFibreRow() + i);
		for (int k = 0; k < 2; ++k)
		{
			const double along = t * coupling[k];
			q[k][0] -= along;
			q[k][3] -= along * fibre.m_z;
			q[k][4] += along * fibre.m_y;
		}
	}
	q[0][1] = q[1][2] = 1;
	const CoupledBundle::Matrix inverse = tangents.getBundleInverse(input, unit.m_bundle);
	for (int k = 0; k < 5; ++k)
		for (int l = k; l < 5; ++l)
		{
			const double column[2] = {q[0][k], q[1][k]},
						 weight = q[0][l] * inverse.multiply(0, column) + q[1][l] * inverse.multiply(1, column);
			if (weight == 0)
				continue;
			const double *const a = unit.m_axis[k < 3 ? k : k - 2], *const b = unit.m_axis[l < 3 ? l : l - 2];
			double* const to = l < 3 ? linear : k < 3 ? mixed : angular;
			addOuterProduct(weight, a, b, to);
			if (k != l && to != mixed)
				addOuterProduct(weight, b, a, to);
		}
}

/// Adds a unit's tangent in world coordinates, sum of a a^T d lambda / du, where rows have tangents of their own and with their partner.
/// \param tangents         with getTangent(), getTangentWithPartner() and getBundleInverse() of AdmissibleBox
/// \param linear, angular  3x3 by columns, of the rows along and about the axes
/// \param mixed            of the rows along the axes, by what is about them
/// \return whether there is anything in mixed
template <class Tangents>
bool addUnitTangent(const Tangents& tangents, const SystemInput& input, const SystemInput::Unit& unit, double linear[9],
					double angular[9], double mixed[9])
{
	bool isMixed = unit.m_bundle >= 0;
	double weights[6] = {};
	for (int r = 0; r < unit.getNumPlainRows(); ++r)
	{
		const int row = unit.m_firstRow + r;
		const double weight = tangents.getTangent(input, row);
		weights[unit.m_dof[r]] = weight;
		const double beside = weight != 0 && unit.m_dof[r] < 3 ? tangents.getTangentWithPartner(input, row) : 0;
		if (beside == 0)
			continue;
		const int partner = input.m_rows[size_t(row)].m_partner - unit.m_firstRow;
		addOuterProduct(beside, unit.m_axis[unit.m_dof[r]], unit.m_axis[unit.m_dof[partner] % 3], mixed);
		isMixed = true;
	}
	FibreTangent fibres;
	fibres.add(weights[0], unit.m_place[0], unit.m_place[1]);
	weights[0] = 0;
	for (int i = 0; i < unit.m_numFibres; ++i)
	{
		const SystemInput::Fibre& fibre = input.m_fibres[size_t(unit.m_firstFibre + i)];
		fibres.add(tangents.getTangent(input, unit.getFirstFibreRow() + i), fibre.m_y, fibre.m_z);
	}
	fibres.cancel();
	weights[0] += fibres.m_axial;
	weights[4] += fibres.m_turns[0];
	weights[5] += fibres.m_turns[2];
	addOuterProducts(weights, unit.m_axis, linear);
	addOuterProducts(weights + 3, unit.m_axis, angular);
	if (fibres.m_turns[1] != 0)
	{
		addOuterProduct(fibres.m_turns[1], unit.m_axis[1], unit.m_axis[2], angular);
		addOuterProduct(fibres.m_turns[1], unit.m_axis[2], unit.m_axis[1], angular);
	}
	for (int k = 0; k < 2; ++k)
		if (fibres.m_mixed[k] != 0)
		{
			addOuterProduct(fibres.m_mixed[k], unit.m_axis[0], unit.m_axis[1 + k], mixed);
			isMixed = true;
		}
	if (unit.m_bundle >= 0)
		addBundleTangent(tangents, input, unit, linear, angular, mixed);
	return isMixed;
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_UNIT_TANGENT_H
