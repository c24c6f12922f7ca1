// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_MATERIALS_H
#define BT_ELASTIC_PLASTIC_MATERIALS_H

#include "btElasticPlasticMaterial.h"

/// A material that is ready to use, and where its numbers come from.
///
/// Strengths are characteristic values without safety factors, of parts at most 16 mm thick where that matters; the ultimate strain is
/// what the standard asks for at least. Of materials that bear less in tension than in compression m_yieldStress is the strength in
/// compression, and m_tensileShare the rest: use them in sections with fibres (btElasticPlasticSection::withFibres), since independent
/// degrees of freedom know one strength only. Ductile metals yield in shear by von Mises; concrete (without stirrups), timber, cast iron
/// and masonry have strengths of their own, and in masonry friction adds to it.
///
/// Compared with printed tables of these standards: all strengths and moduli but those below; the strains of concrete, bars and A992.
/// Named after their standard, but not compared: strengths in shear; the elongations of steels S235 to S460, of bolts and of aluminium; of cast iron all but the tensile
/// strength and the density; masonry. Of no standard: the plastic strains of timber, brick and glass, which break where they yield.
struct btElasticPlasticReadyMaterial
{
	const char* m_name;    ///< "S355"
	const char* m_source;  ///< standard and table
	btElasticPlasticMaterial m_material;
	/// How much stronger it is when it flows fast, for m_material.m_rate where blows count; none is known here of cast iron, timber, brick and glass. It is not in
	/// m_material, since by Cowper and Symonds a slow load finds it stronger, too: mild steel by 8 % at 1e-4 1/s.
	btElasticPlasticRate m_rate;

	/// Structural steel S235, S275, S355, S420, S460, A992; bolts "bolt 4.6", "bolt 8.8", "bolt 10.9"; reinforcement B500A, B500B, B500C; concrete C20/25, C25/30, C30/37, C35/45,
	/// C40/50, C45/55, C50/60; aluminium 6061-T6, 6082-T6; cast iron GJL-250; timber "C24 along", "C24 across"; masonry "clay brick";
	/// "float glass", "toughened glass".
	static int count();
	/// \param index  0 to count() - 1; others give the first one
	static btElasticPlasticReadyMaterial at(int index);

	/// By name. \return a material whose fault() names the density, 0, if there is none of this name
	static btElasticPlasticMaterial find(const char* name);
};

#endif  // BT_ELASTIC_PLASTIC_MATERIALS_H
