// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CAPACITY_H
#define BT_ELASTIC_PLASTIC_CAPACITY_H

#include "LinearMath/btAlignedObjectArray.h"
#include "btElasticPlasticFibre.h"
#include "btElasticPlasticHeat.h"
#include "btElasticPlasticMaterial.h"
#include "btElasticPlasticPrecision.h"
#include "btElasticPlasticSection.h"

/// What a joint can bear in each of its six degrees of freedom (see btElasticPlasticDof): stiffness, yield, ductility.
/// From material and section by fromMember(), or set by hand. SI units, joint frame.
/// A degree of freedom whose yield is 0 is not elastic-plastic: it has no row, and Bullet's class keeps it.
struct btElasticPlasticCapacity
{
	/// Stands for "never": a yield value that leaves a degree of freedom elastic, a ductility that never breaks.
	static btScalar unlimited() { return btScalar(BT_LARGE_FLOAT); }

	/// A spring that is softer has a compliance over a step that is no number any more [N/m], [N m/rad].
	static btScalar leastStiffness() { return btScalar(1e-20); }

	/// A yield value above this could make a plastic energy that is no number any more [N], [N m]: 1e37 in float, 1e250 in double.
	static btScalar greatestYield() { return btScalar(sizeof(btScalar) == sizeof(float) ? 1e37 : 1e250); }

	/// The arms of a section's fibres, and lengths, are shorter: stiffness times their square is a number yet [m].
	static btScalar greatestLength() { return btScalar(1e6); }

	/// [N/m], [N m/rad], finite, >= 0; at most 1e24 where there are fibres, and 1e-18 to 1e18 of two that are coupled. A steel bar of
	/// 1 cm^2 and 1 m has 2e7 N/m. Of a rigid-plastic degree of freedom: not used.
	btScalar m_stiffness[BT_EP_DOF_COUNT];
	btScalar m_yield[BT_EP_DOF_COUNT];      ///< force or moment at which it flows [N], [N m], 0 to greatestYield()
	btScalar m_ductility[BT_EP_DOF_COUNT];  ///< plastic deformation at which the joint breaks [m], [rad], finite, > 0
	/// Of shear y with bending z, and of shear z with bending y: the compliance between the two over the root of the product of
	/// their own, 1/k each; greater than -1 and less than 1. By it the force of one deforms the other, as where the joint is not
	/// in the middle of what is elastic (see fromMember()). 0: each springs by itself. Only between springs, and only in the
	/// direct form of btElasticPlasticConstraintSolver: others leave it out.
	btScalar m_coupling[2];
	/// Length l of the member that bends between the bodies' centres [m], 0 to greatestLength(). It bows: its ends come together by l / 12 times
	/// the square of the elastic turn less than those of two straight parts, which counts where an axial force may buckle it. 0: it
	/// does not.
	btScalar m_length;
	/// Damping ratio of the material: of all modes, see btElasticPlasticMaterial. 0 to 0.1; 0: none.
	btScalar m_damping;
	/// Coefficient of friction, 0 to 2: the yield value of each shear grows by this times the axial pressure with which the step begins. With fibres the
	/// yield value without pressure, the bond, then counts for the share of the section alone that is neither cracked nor torn. 0: neither.
	btScalar m_friction;
	unsigned m_rigidPlastic;  ///< bit i: degree of freedom i does not spring, it only flows
	/// Fibres of the section: axial force and bending moments then yield together, and m_yield in these three is only what each could
	/// be by itself. None: they yield independently. They are for btElasticPlasticConstraintSolver; others take the independent
	/// yield values.
	btAlignedObjectArray<btElasticPlasticFibre> m_fibres;
	btAlignedObjectArray<btElasticPlasticCurvePoint> m_curvePoints;  ///< of fibres whose strength changes as they flow
	btElasticPlasticFault m_fault;  ///< of the material, section or length it was made from

	/// Nothing is elastic-plastic, ductility unlimited.
	btElasticPlasticCapacity(btElasticPlasticOwnPrecision = {});

	/// Elastic-plastic in one degree of freedom, by hand.
	/// stiffness >= leastStiffness(), yield > 0 and at most greatestYield() (or unlimited()), ductility > 0 (or unlimited()). With a degree
	/// of freedom outside of 0 to 5, here and below, the capacity is refused by setCapacity(). It springs by itself: what coupling it had
	/// is gone, and so are the fibres if it is the axial direction or a bending.
	void set(int dof, btScalar stiffness, btScalar yield, btScalar ductility = unlimited());

	/// Rigid-plastic in one degree of freedom: no spring, it holds up to yield and then flows.
	void setRigidPlastic(int dof, btScalar yield, btScalar ductility = unlimited());

	/// Takes a degree of freedom out: no row, no cost.
	void clear(int dof);

	/// Multiplies all yield values, those of fibres too (a weakened joint: factor < 1). Must be finite and not negative. 0 takes all degrees
	/// of freedom out: a joint with this capacity lets go without an event, stays in the world and is not broken; when it gets yield values
	/// again it holds at the pose that its bodies have then. See btElasticPlasticAction::breakJoint to break one.
	void scaleYield(btScalar factor);

	/// The same in heat: yield values and stiffnesses, those of fibres too, times the factors, ductility as it was. Give it to a joint
	/// whenever its temperature has changed: setCapacity() lets the joint sag as its stiffness falls, and what is beyond its strength flows off in the next step.
	/// Make it from the cold capacity each time. Strength or stiffness 0 takes all degrees of freedom out, as scaleYield() says.
	btElasticPlasticCapacity heated(const btElasticPlasticHeat& heat) const;

	/// The same of a section whose parts have temperatures or materials of their own, as concrete and its bars: heat i is for fibres of part i
	/// (btElasticPlasticFibre::m_part), the last one for all others, and the first one for shear and torsion. A part of which nothing is left
	/// keeps a millionth while another one bears.
	/// \param count  of heats, >= 1
	btElasticPlasticCapacity heated(const btElasticPlasticHeat* ofParts, int count) const;

	/// False for what is no degree of freedom.
	bool isElasticPlastic(int dof) const { return btElasticPlasticIsDof(dof) && m_yield[dof] > 0; }
	/// Whether a degree of freedom is one of those that fibres make up: axial force and the two bendings.
	static bool isOfFibres(int dof) { return dof == BT_EP_AXIAL || dof == BT_EP_BENDING_Y || dof == BT_EP_BENDING_Z; }
	bool hasFibres() const { return m_fibres.size() > 0; }
	/// A fibre's strength over that of one that has not flowed, after a plastic path [m].
	btScalar strengthFactor(const btElasticPlasticFibre& fibre, btScalar path) const;
	bool isRigidPlastic(int dof) const { return isElasticPlastic(dof) && (m_rigidPlastic >> dof & 1u); }

	/// The degree of freedom that one may be coupled with, -1: none.
	static int coupledWith(int dof)
	{
		return btElasticPlasticIsDof(dof) && dof % 3 != 0 ? BT_EP_SHEAR_Y + BT_EP_BENDING_Z - dof : -1;
	}

	/// How much a degree of freedom is coupled with its other one: the coupling compliance over the root of both compliances, from -1 to 1, 0: none.
	btScalar relativeCoupling(int dof) const;

	/// Deformation of a degree of freedom by the force of the one that it is coupled with [1/N], [rad/(N m)]; 0: none.
	btScalar couplingCompliance(int dof) const;

	/// Where along x from the joint a force along y or z (BT_EP_SHEAR_Y, BT_EP_SHEAR_Z) makes no turn, and a moment no shift [m]; 0
	/// without coupling, as where the joint stands there itself.
	btScalar elasticMiddle(int shear) const;

	/// Elastic deformation under the given forces [m], [rad]; 0 where there is no spring.
	btScalar elasticDeformation(const btScalar force[BT_EP_DOF_COUNT], int dof) const;

	/// Whether all values are the same; those of degrees of freedom that are not elastic-plastic, too.
	bool isSameAs(const btElasticPlasticCapacity& other) const;

	/// First value that is out of its range; yield without stiffness is one, unless rigid-plastic.
	btElasticPlasticFault fault() const;

	/// Takes a section's fibres, over a length l [m], with a gauge length [m], both > 0. Their stiffness is such that E A and E I of
	/// the section come out; m_stiffness follows it to the last digit. Does nothing if the section has none.
	void addFibres(const btElasticPlasticMaterial& material, const btElasticPlasticSection& section, btScalar length,
				   btScalar gaugeLength);

	/// Capacity of a rod of the given length [m], > 0, between two bodies, with the joint in its middle; all else as fromMember.
	static btElasticPlasticCapacity fromRod(const btElasticPlasticMaterial& material,
											const btElasticPlasticSection& section, btScalar length,
											btScalar gaugeLength = 0)
	{
		return fromMember(material, section, length, length, gaugeLength);
	}

	/// Capacity of the joint between two rigid parts of one member, which stands for the member between the parts' centres.
	///
	/// \param lengthA, lengthB  lengths of the two parts along the member [m], >= 0 and not both 0; a support that does not deform has
	///                          0. A is the part on the side to which the joint's x axis points away: the joint's body A if the
	///                          axis points from A to B, as it does where positive axial force is to be tension.
	/// \param gaugeLength       length over which plastic strain spreads when it tears [m], > 0; 0: the length l below.
	///
	/// With a = lengthA/2, b = lengthB/2, l = a + b, and A etc. times the material's load-bearing share:
	///  - axial E A / l, torsion G J / l, bending E I / l;
	///  - shear 1 / (l/(G A_s) + (a^3 + b^3)/(3 E I)): the second part is the bending of the two halves as cantilevers under
	///    the joint's shear force, which a joint at one point does not see otherwise; it matters where parts are longer than high;
	///  - coupling of shear and bending: what is elastic has its middle at s = (b - a)/2 along x from the joint, where a shear force
	///    makes no turn and a moment no shift. At the joint the turn is (M - s V_y) l/(E I), and so for the other plane with -s: with
	///    this a frame of members is as stiff as by matrix analysis, with one part a member. Yield is asked of the section's forces
	///    at the joint;
	///  - length of the bow, l; friction of the material;
	///  - yields N = A f_y, Q = A_v tau_y, T = W_T tau_y, M = W_pl f_y (paper, equations 10 to 14 and Table IV);
	///  - ductility: elongation e_u g, slip (f_y/tau_y) e_u g, rotation e_u g / c, twist (f_y/tau_y) e_u g / c, with sqrt(3) for f_y/tau_y of a material with m_shearStrength,
	///    with the ultimate plastic strain e_u, gauge length g and distance c of the outer fibre;
	///  - of a section with fibres (btElasticPlasticSection::withFibres): these, with A f_y and e_u g of their own, bars of their own
	///    material.
	static btElasticPlasticCapacity fromMember(const btElasticPlasticMaterial& material,
											   const btElasticPlasticSection& section, btScalar lengthA,
											   btScalar lengthB, btScalar gaugeLength = 0);

private:
	btElasticPlasticFault faultOfFibres() const;
	void takeFibres(const btElasticPlasticCapacity& before);
	btElasticPlasticFault faultOfCurve(const btElasticPlasticFibre& fibre) const;
};

#endif  // BT_ELASTIC_PLASTIC_CAPACITY_H
