// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SECTION_H
#define BT_ELASTIC_PLASTIC_SECTION_H

#include "LinearMath/btAlignedObjectArray.h"
#include "btElasticPlasticMaterial.h"

/// How the plastic torsion modulus of a rectangle is found.
enum btElasticPlasticTorsion
{
	BT_EP_TORSION_EXACT,  ///< sand-heap analogy (Nadai): b^2 (3h - b) / 6 with b <= h
	BT_EP_TORSION_PAPER,  ///< the paper's Table IV, 0.38 b h (b + h) / 2 (there 0.19 f_y, that is 0.38 tau_y by Tresca): 14 % high for a square, 4.3 times at h/b = 10
	BT_EP_TORSION_POLAR  ///< the paper's Figure 5, the integral of the distance from the centre: 15 % high for a square, 5.2 times at h/b = 10
};

/// A part of a section: a rectangle, or a ring.
struct btElasticPlasticSectionPart
{
	btScalar m_y = 0, m_z = 0;                 ///< its centre [m]
	btScalar m_height = 0, m_width = 0;        ///< of a rectangle, along y and z [m]; 0 of a ring
	btScalar m_radius = 0, m_innerRadius = 0;  ///< of a ring [m]; 0 of a rectangle
};

/// A piece of a section that is small enough to have one stress.
struct btElasticPlasticSectionFibre
{
	btScalar m_y, m_z;  ///< [m]
	btScalar m_area;    ///< [m^2]
	int m_material;     ///< 0: the member's, i: m_materials[i - 1] of the section
};

/// Geometry of a member's cross section: all that capacities need, in SI units.
/// The frame: x along the member, y along the height h, z along the width b.
/// A dimension that is not finite or not positive leaves its fault in m_fault and zeros elsewhere.
struct btElasticPlasticSection
{
	btScalar m_area = 0;                      ///< A [m^2]
	btScalar m_shearArea[2] = {0, 0};         ///< A_s for stiffness, forces along y and z [m^2]
	btScalar m_plasticShearArea[2] = {0, 0};  ///< what yields under shear along y and z [m^2]
	btScalar m_secondMoment[2] = {0, 0};      ///< I for bending about y and about z [m^4]
	btScalar m_torsionConstant = 0;           ///< J [m^4]
	btScalar m_plasticModulus[2] = {0, 0};    ///< W_pl for bending about y and about z [m^3]
	btScalar m_plasticTorsionModulus = 0;     ///< moment of torsion over shear yield stress [m^3]
	btScalar m_outerFibre[2] = {0, 0};        ///< distance of the outer fibre from the axis, along y and along z [m]
	/// What the section consists of, for withFibres(); none of a section that was filled by hand.
	btAlignedObjectArray<btElasticPlasticSectionPart> m_parts;
	/// None: axial force and bending moments of a joint yield independently. See withFibres().
	btAlignedObjectArray<btElasticPlasticSectionFibre> m_fibres;
	btAlignedObjectArray<btElasticPlasticMaterial> m_materials;  ///< of bars
	btElasticPlasticFault m_fault;

	/// The same section cut into fibres: in joints with it axial force and bending moments yield together, as in the section itself,
	/// instead of each by itself. What it can bear is then right within a few per cent in every direction of N, M_y and M_z, and exact
	/// where only one of them acts; independent yield values allow up to twice that where all act. \see docs/theory.md
	/// \param count  about how many, 4 to 400; 0: as many as are right within 3 %. A rectangle takes 12 (4 %), 16 (2.5 %) or 36 (1 %), a
	///               circle 14 (3.2 %), 20 (1.8 %) or 33 (1.1 %), a tube as many as are asked for (20: 0.9 %), another section multiples
	///               of 4 for each of its parts (an I-section 12: 5.3 %, 24: 1.7 %, 60: 0.7 %; a box 16: 2.8 %, 24: 1.2 %).
	btElasticPlasticSection withFibres(int count = 0) const;

	/// Adds a bar, an anchor or a bolt: one more fibre, of a material of its own. Cut the section into fibres first.
	/// \param y, z  its place [m]; \param area [m^2] > 0
	void addBar(btScalar y, btScalar z, btScalar area, const btElasticPlasticMaterial& material);

	/// Rectangle, width b along z, height h along y [m].
	/// W_pl = b h^2 / 4 about z and b^2 h / 4 about y (paper, equations 12 and 13); A_s = 5/6 A (Timoshenko), all of A yields (equation 11);
	/// J by Saint-Venant's series.
	static btElasticPlasticSection rectangle(btScalar width, btScalar height,
											 btElasticPlasticTorsion torsion = BT_EP_TORSION_EXACT);

	/// Solid circle of radius r [m]: W_pl = 4 r^3 / 3, torsion 2 pi r^3 / 3, J = pi r^4 / 2; A_s = 6/7 A (Cowper, nu = 0).
	static btElasticPlasticSection circle(btScalar radius);

	/// Tube, outer radius r and wall t [m], 0 < t <= r / 2: a thicker one is refused, since it may be an inner radius that was meant;
	/// there is tube() for that. A_s by Cowper (nu = 0), 2 A / pi yields in shear (Eurocode 3, 6.2.6).
	static btElasticPlasticSection hollowCircle(btScalar radius, btScalar wall);

	/// The same by outer and inner radius [m], 0 < inner < outer.
	static btElasticPlasticSection tube(btScalar outerRadius, btScalar innerRadius);

	/// Box of even wall t [m], 0 < 2 t < min(b, h); J by Bredt, torsion by the sand heap with a hole,
	/// A h / (b + h) resists shear along y (Eurocode 3, 6.2.6).
	static btElasticPlasticSection hollowRectangle(btScalar width, btScalar height, btScalar wall);

	/// I-section (flanges along z), web t_w < b, flanges 2 t_f < h [m]: the web takes shear along y, the flanges along z;
	/// J = sum of s t^3 / 3 over the walls, torsion by the sand heap over the walls.
	static btElasticPlasticSection iSection(btScalar width, btScalar height, btScalar web, btScalar flange);
};

#endif  // BT_ELASTIC_PLASTIC_SECTION_H
