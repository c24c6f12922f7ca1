// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_MATERIAL_H
#define BT_ELASTIC_PLASTIC_MATERIAL_H

#include "LinearMath/btAlignedObjectArray.h"
#include "btElasticPlasticFault.h"

/// How the yield stress in shear follows from the one in tension.
enum btElasticPlasticShearYield : int  // of a fixed type: a value that is none can be passed, and is refused
{
	BT_EP_TRESCA,    ///< f_y / 2, as in the paper (Table IV)
	BT_EP_VON_MISES  ///< f_y / sqrt(3)
};

/// A point of a material's curve of hardening.
struct btElasticPlasticHardeningPoint
{
	btScalar m_strain;  ///< plastic, > 0, more than at the point before
	btScalar m_stress;  ///< [Pa], > 0
};

/// Strength over the rate of strain by Cowper and Symonds: f_y (1 + (rate / D)^(1/q)).
struct btElasticPlasticRate
{
	btScalar m_reference =
		0;  ///< D, the rate at which strength is twice that at rest [1/s], > 0; 0: strength knows no rate
	btScalar m_exponent = 5;  ///< q, >= 1

	/// Mild steel: 40.4 1/s, 5 (Cowper and Symonds 1957, after tests by Manjoine).
	static btElasticPlasticRate mildSteel() { return of(btScalar(40.4), 5); }
	/// High-tensile steel: 3200 1/s, 5 (Paik and Chung 1999; Jones, Structural Impact).
	static btElasticPlasticRate highTensileSteel() { return of(3200, 5); }
	/// Aluminium alloys: 6500 1/s, 4 (Bodner and Symonds 1962).
	static btElasticPlasticRate aluminium() { return of(6500, 4); }
	/// Concrete under pressure: 3.3e8 1/s, 10.6, within 3.1 % of fib Model Code 2010, 5.1.11.2.1 ((rate / 30e-6 1/s)^0.014) from 1e-3 to 30 1/s.
	static btElasticPlasticRate concrete() { return of(btScalar(3.3e8), btScalar(10.6)); }
	/// Stainless steel 304: 100 1/s, 10 (Forrestal and Sagartz 1978).
	static btElasticPlasticRate stainlessSteel() { return of(100, 10); }

	static btElasticPlasticRate of(btScalar reference, btScalar exponent)
	{
		btElasticPlasticRate rate;
		rate.m_reference = reference;
		rate.m_exponent = exponent;
		return rate;
	}
};

/// An elastic-plastic material, isotropic unless it has a shear modulus or strength of its own, perfectly plastic unless it has a curve of hardening. SI units.
struct btElasticPlasticMaterial
{
	btScalar m_youngsModulus = btScalar(200e9);  ///< E [Pa], > 0
	btScalar m_poissonsRatio = btScalar(0.3);    ///< nu, > -1 and <= 0.5
	btScalar m_density =
		btScalar(7800);  ///< of the body [kg/m^3], > 0; the library does not set masses, this is for the scene
	btScalar m_yieldStress = btScalar(200e6);          ///< f_y [Pa], > 0
	btScalar m_ultimatePlasticStrain = btScalar(0.2);  ///< plastic strain at which the material tears, > 0
	/// Strength in tension over f_y, >= 0: 0 of concrete, which cracks without a force and bears again when the crack has closed. Only
	/// fibres know it (btElasticPlasticSection::withFibres): independent degrees of freedom have f_y in both directions.
	btScalar m_tensileShare = btScalar(1);
	btScalar m_crushingStrain = 0;  ///< plastic strain at which fibres are crushed, > 0; 0: as when they tear
	/// Stress over plastic strain in a test in one direction, linear between points, from f_y at 0 on; beyond the last point it stays. None:
	/// f_y. If it is isotropic it may fall, and takes up the less the finer a member is cut. Only fibres know it.
	btAlignedObjectArray<btElasticPlasticHardeningPoint> m_hardening;
	/// How much of the hardening is kinematic, 0 to 1: that part moves the range between yield in tension and in compression, so that what
	/// was stretched yields the earlier when it is pressed (Bauschinger); the rest widens the range. Above 0 the curve must rise
	/// from point to point, and less steeply from each to the next.
	btScalar m_kinematicShare = 1;
	/// G_f, work that a crack takes up per area until it is open [J/m^2]: the strength in tension falls linearly with the crack's width, to 0
	/// at 2 G_f over that strength, which takes the place of m_ultimatePlasticStrain, so that the work does not depend on how finely a member
	/// is cut. 0: the strength stays until then. Only fibres know it, of materials with a strength in tension that do not harden. Concrete by
	/// fib Model Code 2010: 73 f_cm^0.18 N/m with the mean strength in MPa, 138 J/m^2 of C30/37.
	btScalar m_fractureEnergy = 0;
	/// How much stronger it is when it flows fast. Only fibres know it.
	btElasticPlasticRate m_rate;
	btScalar m_loadBearingShare = btScalar(1);  ///< part of the section that carries load, > 0 and <= 1
	/// Ratio of critical damping of a structure's modes, 0 (none) to 0.1. EN 1998-6, Annex B has 1 to 4 % for steel, 2 to 7 % for concrete.
	btScalar m_dampingRatio = btScalar(0.01);
	btElasticPlasticShearYield m_shearYield = BT_EP_TRESCA;
	/// G [Pa], >= 0, of a material that is not isotropic, such as timber; 0: E / (2 (1 + nu)).
	btScalar m_shearModulus = 0;
	/// tau_y [Pa], >= 0, of a material whose strength in shear does not follow from a yield criterion, such as concrete, timber and masonry; 0: by
	/// m_shearYield.
	btScalar m_shearStrength = 0;
	/// How much pressure adds to the strength in shear: tau_y + m_friction p (Mohr and Coulomb), 0 to 2. Torsion is not affected. See
	/// btElasticPlasticCapacity::m_friction.
	btScalar m_friction = 0;

	/// G
	btScalar shearModulus() const
	{
		return m_shearModulus > 0 ? m_shearModulus : m_youngsModulus / (2 * (1 + m_poissonsRatio));
	}

	/// tau_y without pressure
	btScalar shearYieldStress() const
	{
		if (m_shearStrength > 0)
			return m_shearStrength;
		return m_shearYield == BT_EP_TRESCA ? m_yieldStress / 2 : m_yieldStress / btSqrt(btScalar(3));
	}

	/// First field that is out of its range.
	btElasticPlasticFault fault() const;

	/// Structural steel: E = 200 GPa, 7800 kg/m^3. The paper uses 200 MPa (demolisher, block) and 400 MPa (Charpy).
	static btElasticPlasticMaterial steel(btScalar yieldStress = btScalar(200e6));

	/// Reinforced concrete as the paper means it: the steel, a share of the section spread over it evenly, carries all load;
	/// the concrete gives the mass (2000 kg/m^3). The paper's block has steelShare = 0.0004.
	static btElasticPlasticMaterial reinforcedConcrete(btScalar steelShare, btScalar yieldStress = btScalar(200e6));
};

#endif  // BT_ELASTIC_PLASTIC_MATERIAL_H
