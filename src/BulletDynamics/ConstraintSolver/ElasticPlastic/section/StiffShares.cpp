// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "StiffShares.h"

#include "../../btElasticPlasticSection.h"
#include "LinearMath/btMinMax.h"

#include <math.h>

namespace btElasticPlastic
{
namespace
{
enum
{
	TERMS = 6  ///< 1, y, z, y^2, z^2, y z
};

void termsAt(double y, double z, double terms[TERMS])
{
	const double all[TERMS] = {1, y, z, y * y, z * z, y * z};
	for (int k = 0; k < TERMS; ++k)
		terms[k] = all[k];
}

/// Solves a symmetric, positive semidefinite system; equations that are not independent are left out.
void solve(double matrix[TERMS][TERMS], double right[TERMS])
{
	bool isLeftOut[TERMS] = {};
	for (int k = 0; k < TERMS; ++k)
	{
		isLeftOut[k] = !(matrix[k][k] > 1e-6);
		for (int i = 0; i < TERMS && !isLeftOut[k]; ++i)
		{
			const double factor = i == k ? 0 : matrix[i][k] / matrix[k][k];
			for (int j = 0; j < TERMS; ++j)
				matrix[i][j] -= factor * matrix[k][j];
			right[i] -= factor * right[k];
		}
	}
	for (int k = 0; k < TERMS; ++k)
		right[k] = isLeftOut[k] ? 0 : right[k] / matrix[k][k];
}
}  // namespace

void findShares(const btElasticPlasticSection& section, btAlignedObjectArray<double>& shares)
{
	const int n = section.m_fibres.size();
	const double area = section.m_area, radius[2] = {sqrt(double(section.m_secondMoment[1]) / area),
													 sqrt(double(section.m_secondMoment[0]) / area)};
	double matrix[TERMS][TERMS] = {}, right[TERMS] = {1, 0, 0, 1, 1, 0}, terms[TERMS];
	const auto at = [&](int i)
	{ termsAt(double(section.m_fibres[i].m_y) / radius[0], double(section.m_fibres[i].m_z) / radius[1], terms); };
	shares.resize(n);
	for (int i = 0; i < n; ++i)
	{
		shares[i] = double(section.m_fibres[i].m_area) / area;
		if (section.m_fibres[i].m_material > 0)
			continue;
		at(i);
		for (int k = 0; k < TERMS; ++k)
		{
			right[k] -= shares[i] * terms[k];
			for (int l = 0; l < TERMS; ++l)
				matrix[k][l] += shares[i] * terms[k] * terms[l];
		}
	}
	solve(matrix, right);
	for (int i = 0; i < n; ++i)
	{
		if (section.m_fibres[i].m_material > 0)
			continue;
		at(i);
		double factor = 1;
		for (int k = 0; k < TERMS; ++k)
			factor += right[k] * terms[k];
		// A hundredth at least: a section by hand may ask for more than its fibres can give.
		shares[i] *= btMax(factor, 0.01);
	}
}
}  // namespace btElasticPlastic
