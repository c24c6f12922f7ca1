// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SECTION_H
#define BT_ELASTIC_PLASTIC_SECTION_H

#include "LinearMath/btAlignedObjectArray.h"
#include "LinearMath/btTransform.h"
#include "btElasticPlasticMaterial.h"

/// How the plastic torsion modulus of a rectangle is found.
enum btElasticPlasticTorsion : int  // of a fixed type: a value that is none can be passed, and is refused
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
	btScalar m_turn = 0;                       ///< about x, of a rectangle's height against y [rad]
};

/// A corner of an outline.
struct btElasticPlasticSectionPoint
{
	btScalar m_y, m_z;  ///< [m]
};

/// A weld.
struct btElasticPlasticSectionLine
{
	btElasticPlasticSectionPoint m_from, m_to;
};

/// A piece of a section that is small enough to have one stress.
struct btElasticPlasticSectionFibre
{
	btScalar m_y, m_z;  ///< [m]
	btScalar m_area;    ///< [m^2]
	int m_material;     ///< 0: the member's, i: m_materials[i - 1] of the section
	/// Of a material other than the member's: by what share of its area it is stiffer than that, so that a part that was added has its own
	/// second moments. The member's own fibres get theirs from the section's.
	btScalar m_excess = 0;
	/// Whether shear and torsion of the section take of its strength, and how: see btElasticPlasticFibre.
	bool m_bearsShear = false;
	btScalar m_wall[2] = {0, 0}, m_twist[2] = {0, 0};

	btElasticPlasticSectionFibre(btScalar y = 0, btScalar z = 0, btScalar area = 0, int material = 0)
		: m_y(y), m_z(z), m_area(area), m_material(material)
	{
	}
};

/// Geometry of a member's cross section: all that capacities need, in SI units.
/// The frame: x along the member through the centroid, y along the height h, z along the width b. A joint has stiffnesses about two
/// axes and none between them, so y and z are principal axes. A shape whose own axes are not, such as an angle or a
/// polygon, is moved and turned into them, and m_centroid and m_turn tell how: with the frame F of the axes in which it was given, make
/// the joint's frame F * principalFrame(). Bars and parts of other materials need no such care: fibres know where each is.
/// A force across the member is taken to go through the shear centre: where that is not the centroid, as of channels and angles, what it turns
/// the member about its own axis is left out.
/// A dimension that is not finite or not positive leaves its fault in m_fault and zeros elsewhere.
struct btElasticPlasticSection
{
	btScalar m_area = 0;                      ///< A [m^2]
	btScalar m_shearArea[2] = {0, 0};         ///< A_s for stiffness, forces along y and z [m^2]
	btScalar m_plasticShearArea[2] = {0, 0};  ///< what yields under shear along y and z [m^2]
	btScalar m_secondMoment[2] = {0, 0};      ///< I for bending about y and about z [m^4]
	btScalar m_torsionConstant = 0;           ///< J [m^4]
	btScalar m_plasticModulus[2] = {0, 0};    ///< W_pl for bending about y and about z, no other force acting [m^3]
	btScalar m_plasticTorsionModulus = 0;     ///< moment of torsion over shear yield stress [m^3]
	btScalar m_outerFibre[2] = {0, 0};        ///< distance of the outer fibre from the axis, along y and along z [m]
	btScalar m_centroid[2] = {0, 0};          ///< y and z of the origin, in the axes in which the shape was given [m]
	btScalar m_turn = 0;                      ///< about x, of y and z against those axes [rad]
	/// What the section consists of, for withFibres(); none of a section that was filled by hand.
	btAlignedObjectArray<btElasticPlasticSectionPart> m_parts;
	btAlignedObjectArray<btElasticPlasticSectionPoint> m_corners;  ///< of all outlines of polygon(), one after another
	btAlignedObjectArray<int> m_numCorners;                        ///< of each outline
	/// None: axial force and bending moments of a joint yield independently. See withFibres().
	btAlignedObjectArray<btElasticPlasticSectionFibre> m_fibres;
	btAlignedObjectArray<btElasticPlasticMaterial> m_materials;  ///< of bars and of parts that were added
	btElasticPlasticFault m_fault;

	/// The same section cut into fibres: in joints with it axial force, bending moments, shears and torsion yield together, as in the section itself,
	/// instead of each by itself. What it can bear is then right within a few per cent in every direction, and exact
	/// where only one of them acts; independent yield values allow up to twice that where all act. \see docs/theory.md
	/// A section to which bars or parts have been added is refused: they would be lost.
	/// \param count  about how many, 4 to 400; 0: as many as are right within 3 %. A rectangle takes 4 (25 %), 8 (5.5 %), 12 (2.9 %), 16 (2.4 %), 36 (1 %) or 112 (0.9 %), a
	///               circle 14 (3.2 %), 20 (1.8 %), 33 (1.1 %) or 101 (0.4 %), a tube as many as are asked for (20: 0.9 %; thick walls 2.8 %), another section multiples
	///               of 4 for each of its parts (an I-section 12: 5.3 %, 24: 1.7 %, 60: 0.7 %; a box 16: 2.8 %, 24: 1.2 %). A polygon takes as many as are
	///               asked for, 36 by default, and one more at each corner of thin walls, and some 100 for 1 %, which take it 0.1 s, and 400 0.8 s. Each bolt is one.
	/// \param withShear  whether shears and torsion yield together with them: all six forces are then right within 8 % of von Mises' theory
	///               of a section that slips as a whole (a box bears less shear and torsion together, docs/limits.md), and shear takes of the fibres' strength, by the walls that bear it. Of materials that are weaker in
	///               tension pressure adds to it; those with less than a tenth, or with a friction, are left out. false: shears and torsion each by itself, up to 1.8 times what the section bears where
	///               they act together with the rest; a joint's step is an eighth to a quarter shorter where it is loaded beyond half of its strength
	btElasticPlasticSection withFibres(int count = 0, bool withShear = true) const;

	/// The same with as few fibres as are right within an error, so that a scene does not pay for what it does not need.
	/// \param error  largest deviation of what the section bears of axial force and bending together, in any direction, over that, > 0; below 0.01
	///               the finest that a rectangle or a circle has. Where one of them rules it counts by its square: an axial
	///               force of a fifth of what the section bears takes 4 % of a rectangle's moment, so that 0.1 is enough for most frames
	btElasticPlasticSection withFibresFor(btScalar error, bool withShear = true) const;

	/// Adds a bar, an anchor or a bolt: one more fibre, of a material of its own. Cut the section into fibres first.
	/// \param y, z  its place [m]; \param area [m^2] > 0
	void addBar(btScalar y, btScalar z, btScalar area, const btElasticPlasticMaterial& material);

	/// Adds another section, of a material of its own, that is held to this one all along: a slab on a girder, concrete in a tube, a plate that
	/// is welded on. Both have to be cut into fibres first. Axial force and bending are those of both; shear and torsion stay this one's.
	/// \param y, z  place of the part's centroid [m]
	void addPart(const btElasticPlasticSection& part, btScalar y, btScalar z, const btElasticPlasticMaterial& material);

	/// Frame of the section's axes in those in which the shape was given.
	btTransform principalFrame() const;

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

	/// Any shape with straight sides, with holes or without, its corners in axes y and z of your own. Area, second moments, principal axes and plastic
	/// moduli are exact (Green's theorem). Shear areas are those of Jourawski's stress, A_s = I^2 / integral of S^2/b; 6/5 of them yield, but no more
	/// than A. Torsion is plastic by the sand heap with holes, and elastic within 1 % of compact shapes, circles, even tubes and thin walls. It takes some
	/// 20 ms: make one for many joints.
	/// \param corners      of the outer outline, then those of each hole, in either direction of turn. Outlines must not meet themselves or each
	///                     other, and have more area than 1e-6 of the square of their distance from the origin
	/// \param numCorners   of each outline, 3 or more; 1000 in all at most
	/// \param numOutlines  1 and the number of holes
	static btElasticPlasticSection polygon(const btElasticPlasticSectionPoint* corners, const int* numCorners,
										   int numOutlines = 1);

	/// T-section: flange along z, its outer face at y = 0, web in its middle, down to y = -h. t_w < b, t_f < h [m]. As polygon(), but J = sum of
	/// s t^3 / 3 over the walls and torsion by the sand heap over the walls, as of the other sections of thin walls.
	static btElasticPlasticSection tSection(btScalar width, btScalar height, btScalar web, btScalar flange);

	/// Channel: web along y with its outer face at z = 0 and its middle at y = 0, flanges from there to z = b. t_w < b, 2 t_f < h [m].
	static btElasticPlasticSection channel(btScalar width, btScalar height, btScalar web, btScalar flange);

	/// Angle: legs from the corner at y = z = 0 along y to h and along z to b, both t thick, t < h, b [m]. Its principal axes are turned. A force in shear
	/// is shared by the legs, each along itself.
	static btElasticPlasticSection angle(btScalar width, btScalar height, btScalar thickness);

	/// What bolts of one size bear between two plates: each its tension, and its shear in any direction. In bending and under pressure plates
	/// press on each other: add the area where they touch by addPart(), of a material with m_tensileShare 0; else the bolts are pressed.
	/// withFibres() makes one fibre of each.
	/// \param places  in axes y and z of your own, 1 to 400
	/// \param area    of one in its thread, A_s [m^2] > 0; M20 has 245 mm^2
	static btElasticPlasticSection bolts(const btElasticPlasticSectionPoint* places, int count, btScalar area);

	/// What welds with one throat bear, by the throats' areas turned into the plane: each its force across and along, and its shear in any direction.
	/// The material is the weld's. Torsion by shears about the place where they bear least, as bolts'.
	/// \param lines   in axes y and z of your own, 1 to 400, each longer than the throat
	/// \param throat  [m] > 0
	static btElasticPlasticSection welds(const btElasticPlasticSectionLine* lines, int count, btScalar throat);
};

#endif  // BT_ELASTIC_PLASTIC_SECTION_H
