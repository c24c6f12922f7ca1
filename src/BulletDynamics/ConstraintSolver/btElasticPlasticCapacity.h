// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_CAPACITY_H
#define BT_ELASTIC_PLASTIC_CAPACITY_H

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

	btScalar m_stiffness
		[BT_EP_DOF_COUNT];  ///< [N/m], [N m/rad], finite, >= 0; a steel bar of 1 cm^2 and 1 m has 2e7 N/m. Of a rigid-plastic degree of freedom: not used
	btScalar m_yield[BT_EP_DOF_COUNT];      ///< force or moment at which it flows [N], [N m], finite, >= 0
	btScalar m_ductility[BT_EP_DOF_COUNT];  ///< plastic deformation at which the joint breaks [m], [rad], finite, > 0
	unsigned m_rigidPlastic;                ///< bit i: degree of freedom i does not spring, it only flows
	btElasticPlasticFault m_fault;          ///< of the material, section or length it was made from

	/// Nothing is elastic-plastic, ductility unlimited.
	btElasticPlasticCapacity(btElasticPlasticOwnPrecision = {});

	/// Elastic-plastic in one degree of freedom, by hand.
	/// stiffness >= leastStiffness(), yield > 0 (or unlimited()), ductility > 0 (or unlimited()). With a degree of freedom outside
	/// of 0 to 5, here and below, the capacity is refused by setCapacity().
	void set(int dof, btScalar stiffness, btScalar yield, btScalar ductility = unlimited());

	/// Rigid-plastic in one degree of freedom: no spring, it holds up to yield and then flows.
	void setRigidPlastic(int dof, btScalar yield, btScalar ductility = unlimited());

	/// Takes a degree of freedom out: no row, no cost.
	void clear(int dof);

	/// Multiplies all yield values (a weakened joint: factor < 1). Must be finite and not negative; 0 takes all degrees of
	/// freedom out, the joint no longer holds anything.
	void scaleYield(btScalar factor);

	/// False for what is no degree of freedom.
	bool isElasticPlastic(int dof) const { return btElasticPlasticIsDof(dof) && m_yield[dof] > 0; }
	bool isRigidPlastic(int dof) const { return isElasticPlastic(dof) && (m_rigidPlastic >> dof & 1u); }

	/// First value that is out of its range; yield without stiffness is one, unless rigid-plastic.
	btElasticPlasticFault fault() const;

	/// Capacity of a rod of the given length [m], > 0, between two bodies, with the joint in its middle; all else as fromMember.
	static btElasticPlasticCapacity fromRod(const btElasticPlasticMaterial& material,
											const btElasticPlasticSection& section, btScalar length,
											btScalar gaugeLength = 0)
	{
		return fromMember(material, section, length, length, gaugeLength);
	}

	/// Capacity of the joint between two rigid parts of one member, which stands for the member between the parts' centres.
	///
	/// \param lengthA, lengthB  lengths of the two parts along the member [m], >= 0 and not both 0; a support that does not deform has 0.
	/// \param gaugeLength       length over which plastic strain spreads when it tears [m], > 0; 0: the length l below.
	///
	/// With a = lengthA/2, b = lengthB/2, l = a + b, and A etc. times the material's load-bearing share:
	///  - axial E A / l, torsion G J / l, bending E I / l;
	///  - shear 1 / (l/(G A_s) + (a^3 + b^3)/(3 E I)): the second part is the bending of the two halves as cantilevers under
	///    the joint's shear force, which a joint at one point does not see otherwise; it matters where parts are longer than high;
	///  - yields N = A f_y, Q = A_v tau_y, T = W_T tau_y, M = W_pl f_y (paper, equations 10 to 14 and Table IV);
	///  - ductility: elongation e_u g, slip (f_y/tau_y) e_u g, rotation e_u g / c, twist (f_y/tau_y) e_u g / c,
	///    with the ultimate plastic strain e_u, gauge length g and distance c of the outer fibre.
	static btElasticPlasticCapacity fromMember(const btElasticPlasticMaterial& material,
											   const btElasticPlasticSection& section, btScalar lengthA,
											   btScalar lengthB, btScalar gaugeLength = 0);
};

#endif  // BT_ELASTIC_PLASTIC_CAPACITY_H
