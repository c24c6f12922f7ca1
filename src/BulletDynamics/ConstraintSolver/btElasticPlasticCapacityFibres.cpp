// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Capacities of sections with fibres.

#include "btElasticPlasticCapacity.h"

#include "ElasticPlastic/section/CellStrength.h"
#include "ElasticPlastic/section/StiffShares.h"
#include "LinearMath/btMinMax.h"

using namespace btElasticPlastic;

namespace
{
/// A piece of a section: what it is made of, and its stiffness over the length.
struct SectionPiece
{
	const btElasticPlasticSectionFibre& m_from;
	const btElasticPlasticMaterial& m_material;
	double m_stiffness;  ///< [N/m]
	double m_gauge;      ///< [m]

	double getYield() const
	{
		return double(m_from.m_area) * double(m_material.m_yieldStress) * double(m_material.m_loadBearingShare);
	}
	void shear(btElasticPlasticFibre& fibre) const
	{
		fibre.m_bearsShear = m_from.m_bearsShear;
		for (int k = 0; k < 2; ++k)
		{
			fibre.m_wall[k] = m_from.m_wall[k];
			fibre.m_twist[k] = m_from.m_twist[k];
		}
	}
	btElasticPlasticFibre fibre(double stiffness, double strength) const
	{
		btElasticPlasticFibre fibre;
		fibre.m_y = m_from.m_y;
		fibre.m_z = m_from.m_z;
		fibre.m_stiffness = btScalar(stiffness);
		fibre.m_compression = btScalar(strength);
		fibre.m_tension = fibre.m_compression * m_material.m_tensileShare;
		fibre.m_rateReference = m_material.m_rate.m_reference * btScalar(m_gauge);
		fibre.m_rateExponent = m_material.m_rate.m_exponent;
		fibre.m_part = m_from.m_material;
		shear(fibre);
		return fibre;
	}
};

/// Stress above f_y at a plastic strain [Pa].
double hardeningAt(const btElasticPlasticMaterial& material, double strain)
{
	double before = 0, stress = material.m_yieldStress;
	for (int i = 0; i < material.m_hardening.size(); ++i)
	{
		const double next = material.m_hardening[i].m_strain, rise = double(material.m_hardening[i].m_stress) - stress;
		if (strain < next)
			return stress + rise * (strain - before) / (next - before) - double(material.m_yieldStress);
		before = next;
		stress += rise;
	}
	return stress - double(material.m_yieldStress);
}

// Hardening. A fibre of a material that hardens is a bundle of fibres at one place (Besseling's overlay). With its stiffness k, its
// yield force F_y, hardening forces H_j = A h_j of which beta is kinematic, and plastic elongations p_j, it reaches at point j
//
//     F_j = F_y + H_j,   u_j = F_j / k + p_j.
//
// The first of the bundle yields first, at u_0 = F_y / k. Its stiffness is k_0 = k - T_1, and its strength grows with its own plastic path,
// which is p_j + beta H_j / k at point j, as (k_0 / k) (F_y + (1 - beta) H_j). What it leaves of F_j the others bear. They spring
// together with the slopes T_j from u_(j-1) to u_j, T_1 = beta H_1 / (p_1 + beta H_1 / k), so that one with T_j - T_(j+1) yields at
// each u_j. All this is exact in one direction, and in cycles where hardening is linear or all of one kind.

void addHardening(btElasticPlasticCapacity& capacity, const SectionPiece& piece)
{
	const btElasticPlasticMaterial& material = piece.m_material;
	const double strains[2] = {material.m_ultimatePlasticStrain, material.m_crushingStrain > 0
																	 ? material.m_crushingStrain
																	 : material.m_ultimatePlasticStrain};
	// Up to where the material is torn.
	btAlignedObjectArray<double> points;
	for (int j = 0; j < material.m_hardening.size() && (j == 0 || points[j - 1] < strains[0]); ++j)
		points.push_back(btMin(double(material.m_hardening[j].m_strain), strains[0]));
	const int n = points.size();
	const double k = piece.m_stiffness, yield = piece.getYield(), beta = material.m_kinematicShare,
				 area = yield / double(material.m_yieldStress);
	const auto hardening = [&](double strain) { return area * hardeningAt(material, strain); };
	const auto plastic = [&](int j) { return points[j] * piece.m_gauge; };
	const auto force = [&](int j) { return hardening(points[j]); };
	const double first = beta * force(0) / (plastic(0) + beta * force(0) / k), share = 1 - first / k;
	const auto elongation = [&](int j) { return (yield + force(j)) / k + plastic(j); };
	const auto rest = [&](int j) { return yield + force(j) - share * (yield + (1 - beta) * force(j)); };
	btElasticPlasticFibre fibre = piece.fibre(k - first, share * yield);
	fibre.m_stretchLimit = btScalar(strains[0] * piece.m_gauge + beta * hardening(strains[0]) / k);
	fibre.m_crushLimit = btScalar(strains[1] * piece.m_gauge + beta * hardening(strains[1]) / k);
	if (beta < 1)
	{
		fibre.m_firstPoint = capacity.m_curvePoints.size();
		fibre.m_numPoints = n;
		for (int j = 0; j < n; ++j)
			capacity.m_curvePoints.push_back(
				{btScalar(plastic(j) + beta * force(j) / k), btScalar(1 + (1 - beta) * force(j) / yield)});
	}
	capacity.m_fibres.push_back(fibre);

	double slope = first;
	for (int j = 0; j < n && beta > 0; ++j)
	{
		const double next = j + 1 < n ? (rest(j + 1) - rest(j)) / (elongation(j + 1) - elongation(j)) : 0,
					 stiffness = slope - next;
		slope = next;
		// A straight line's points.
		if (!(stiffness > 1e-6 * k))
			continue;
		btElasticPlasticFibre layer = piece.fibre(stiffness, stiffness * elongation(j));
		// All of the bundle are torn together when they are pulled in one direction.
		const auto limit = [&](double strain)
		{
			return btScalar(btMax((yield + hardening(strain)) / k + strain * piece.m_gauge - elongation(j),
								  1e-3 * strain * piece.m_gauge));
		};
		layer.m_stretchLimit = limit(strains[0]);
		layer.m_crushLimit = limit(strains[1]);
		capacity.m_fibres.push_back(layer);
	}
}
/// What the section bears of one force while there is no other. A section without any strength in tension bears no moment by itself: it is given
/// what it bears beside the axial force that is best for it.
/// \param most  beside any other forces
btScalar aloneOf(const std::vector<Cell>& cells, SectionForce force, btScalar most)
{
	const double alone = strengthAlone(cells, force);
	const bool isLess = alone > 1e-3 * double(most) && alone < (1 - 1e-4) * double(most);
	return isLess ? btScalar(alone) : most;
}
}  // namespace

btScalar btElasticPlasticCapacity::strengthFactor(const btElasticPlasticFibre& fibre, btScalar path) const
{
	btElasticPlasticCurvePoint before = {0, 1};
	for (int i = fibre.m_firstPoint; i < fibre.m_firstPoint + fibre.m_numPoints; ++i)
	{
		const btElasticPlasticCurvePoint& next = m_curvePoints[i];
		if (path < next.m_path)
			return before.m_factor +
				   (next.m_factor - before.m_factor) * ((path - before.m_path) / (next.m_path - before.m_path));
		before = next;
	}
	return before.m_factor;
}

void btElasticPlasticCapacity::addFibres(const btElasticPlasticMaterial& material,
										 const btElasticPlasticSection& section, btScalar length, btScalar gaugeLength)
{
	m_fibres.clear();
	m_curvePoints.clear();
	if (section.m_fibres.size() == 0)
		return;
	btAlignedObjectArray<double> shares;
	findShares(section, shares);
	btScalar stiffness[3] = {}, tension = 0, compression = 0, moment[2] = {};
	std::vector<Cell> cells;
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
							(isBar ? from.m_area * (1 + from.m_excess) : btScalar(shares[i]) * section.m_area);
		fibre.m_tension = strength * own.m_tensileShare;
		fibre.m_compression = strength;
		fibre.m_stretchLimit = own.m_ultimatePlasticStrain * gaugeLength;
		fibre.m_crushLimit =
			(own.m_crushingStrain > 0 ? own.m_crushingStrain : own.m_ultimatePlasticStrain) * gaugeLength;
		fibre.m_rateReference = own.m_rate.m_reference * gaugeLength;
		fibre.m_rateExponent = own.m_rate.m_exponent;
		fibre.m_part = from.m_material;
		fibre.m_softens = own.m_fractureEnergy > 0;
		if (fibre.m_softens)
			fibre.m_stretchLimit = 2 * own.m_fractureEnergy / (own.m_yieldStress * own.m_tensileShare);
		const SectionPiece piece = {from, own, double(fibre.m_stiffness), double(gaugeLength)};
		piece.shear(fibre);
		if (own.m_hardening.size() > 0)
			addHardening(*this, piece);
		else
			m_fibres.push_back(fibre);
		stiffness[0] += fibre.m_stiffness;
		stiffness[1] += fibre.m_stiffness * from.m_z * from.m_z;
		stiffness[2] += fibre.m_stiffness * from.m_y * from.m_y;
		cells.push_back({double(fibre.m_y), double(fibre.m_z), double(fibre.m_tension), double(fibre.m_compression)});
		tension += fibre.m_tension;
		compression += fibre.m_compression;
		moment[0] += (fibre.m_tension + fibre.m_compression) / 2 * btFabs(from.m_z);
		moment[1] += (fibre.m_tension + fibre.m_compression) / 2 * btFabs(from.m_y);
	}
	m_stiffness[BT_EP_AXIAL] = stiffness[0];
	m_yield[BT_EP_AXIAL] = aloneOf(cells, AXIAL_FORCE, btMax(tension, compression));
	for (int i = 0; i < 2; ++i)
	{
		m_stiffness[BT_EP_BENDING_Y + i] = stiffness[1 + i];
		m_yield[BT_EP_BENDING_Y + i] = aloneOf(cells, i == 0 ? MOMENT_Y : MOMENT_Z, moment[i]);
	}
}

namespace
{
std::vector<Cell> cellsOf(const btElasticPlasticCapacity& capacity)
{
	std::vector<Cell> cells;
	for (int i = 0; i < capacity.m_fibres.size(); ++i)
	{
		const btElasticPlasticFibre& f = capacity.m_fibres[i];
		cells.push_back({double(f.m_y), double(f.m_z), double(f.m_tension), double(f.m_compression)});
	}
	return cells;
}
}  // namespace

/// After a change of the fibres: stiffness follows them, and what one force can be by itself changes as theirs does.
/// \param before  with the fibres as they were
void btElasticPlasticCapacity::takeFibres(const btElasticPlasticCapacity& before)
{
	btScalar stiffness[3] = {};
	for (int i = 0; i < m_fibres.size(); ++i)
	{
		const btElasticPlasticFibre& f = m_fibres[i];
		stiffness[0] += f.m_stiffness;
		stiffness[1] += f.m_stiffness * f.m_z * f.m_z;
		stiffness[2] += f.m_stiffness * f.m_y * f.m_y;
	}
	const int dofs[3] = {BT_EP_AXIAL, BT_EP_BENDING_Y, BT_EP_BENDING_Z};
	const SectionForce forces[3] = {AXIAL_FORCE, MOMENT_Y, MOMENT_Z};
	const std::vector<Cell> former = cellsOf(before), cells = cellsOf(*this);
	for (int k = 0; k < 3; ++k)
	{
		const double was = strengthAlone(former, forces[k]), is = strengthAlone(cells, forces[k]);
		m_stiffness[dofs[k]] = stiffness[k];
		if (was > 0 && is > 0)
			m_yield[dofs[k]] *= btScalar(is / was);
	}
}
