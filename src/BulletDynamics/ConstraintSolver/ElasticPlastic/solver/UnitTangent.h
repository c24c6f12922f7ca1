// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_UNIT_TANGENT_H
#define BT_ELASTIC_PLASTIC_UNIT_TANGENT_H

#include "SystemInput.h"

namespace btElasticPlastic
{
/// Adds a unit's tangent in world coordinates, sum of a a^T d lambda / du, where rows have tangents of their own and with their partner.
/// \param tangents         with getTangent() and getTangentWithPartner() of AdmissibleBox
/// \param linear, angular  3x3 by columns, of the rows along and about the axes
/// \param mixed            of the rows along the axes, by what is about them
/// \return whether there is anything in mixed
template <class Tangents>
bool addUnitTangent(const Tangents& tangents, const SystemInput& input, const SystemInput::Unit& unit, double linear[9],
					double angular[9], double mixed[9])
{
	const auto add = [](double weight, const double a[3], const double b[3], double to[9])
	{
		for (int c = 0; c < 3; ++c)
			for (int k = 0; k < 3; ++k)
				to[3 * c + k] += weight * b[c] * a[k];
	};
	bool isMixed = false;
	for (int r = 0; r < unit.m_numRows; ++r)
	{
		const int row = unit.m_firstRow + r;
		const double weight = tangents.getTangent(input, row);
		if (weight == 0)
			continue;
		const double* const axis = unit.m_axis[unit.m_dof[r] % 3];
		add(weight, axis, axis, unit.m_dof[r] < 3 ? linear : angular);
		const double beside = unit.m_dof[r] < 3 ? tangents.getTangentWithPartner(input, row) : 0;
		if (beside == 0)
			continue;
		const int partner = input.m_rows[size_t(row)].m_partner - unit.m_firstRow;
		add(beside, axis, unit.m_axis[unit.m_dof[partner] % 3], mixed);
		isMixed = true;
	}
	return isMixed;
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_UNIT_TANGENT_H
