// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Capacities of sections with fibres.

#include "btElasticPlasticCapacity.h"

#include "LinearMath/btMinMax.h"

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

/// Shares of stiffness with which the member's own fibres have the area and the second moments of the section, and no first moments:
/// area times a polynomial of their place, the one that is nearest to 1.
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
}  // namespace

void btElasticPlasticCapacity::addFibres(const btElasticPlasticMaterial& material,
										 const btElasticPlasticSection& section, btScalar length, btScalar gaugeLength)
{
	m_fibres.clear();
	if (section.m_fibres.size() == 0)
		return;
	btAlignedObjectArray<double> shares;
	findShares(section, shares);
	btScalar stiffness[3] = {}, tension = 0, compression = 0, moment[2] = {};
	for (int i = 0; i < section.m_fibres.size(); ++i)
	{
		const btElasticPlasticSectionFibre& from = section.m_fibres[i];
		const bool isBar = from.m_material > 0;
		const btElasticPlasticMaterial& own = isBar ? section.m_materials[from.m_material - 1] : material;
		const btScalar strength = from.m_area * own.m_yieldStress * own.m_loadBearingShare;
		btElasticPlasticFibre fibre;
		fibre.m_y = from.m_y;
		fibre.m_z = from.m_z;
		fibre.m_stiffness = own.m_youngsModulus * own.m_loadBearingShare / length *
							(isBar ? from.m_area : btScalar(shares[i]) * section.m_area);
		fibre.m_tension = strength * own.m_tensileShare;
		fibre.m_compression = strength;
		fibre.m_stretchLimit = own.m_ultimatePlasticStrain * gaugeLength;
		fibre.m_crushLimit =
			(own.m_crushingStrain > 0 ? own.m_crushingStrain : own.m_ultimatePlasticStrain) * gaugeLength;
		m_fibres.push_back(fibre);
		stiffness[0] += fibre.m_stiffness;
		stiffness[1] += fibre.m_stiffness * from.m_z * from.m_z;
		stiffness[2] += fibre.m_stiffness * from.m_y * from.m_y;
		tension += fibre.m_tension;
		compression += fibre.m_compression;
		moment[0] += (fibre.m_tension + fibre.m_compression) / 2 * btFabs(from.m_z);
		moment[1] += (fibre.m_tension + fibre.m_compression) / 2 * btFabs(from.m_y);
	}
	m_stiffness[BT_EP_AXIAL] = stiffness[0];
	m_yield[BT_EP_AXIAL] = btMax(tension, compression);
	for (int i = 0; i < 2; ++i)
	{
		m_stiffness[BT_EP_BENDING_Y + i] = stiffness[1 + i];
		m_yield[BT_EP_BENDING_Y + i] = moment[i];
	}
}
