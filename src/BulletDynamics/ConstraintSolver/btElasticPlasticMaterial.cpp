// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticMaterial.h"

namespace
{
btElasticPlasticFault faultOfHardening(const btElasticPlasticMaterial& material)
{
	const btScalar share = material.m_kinematicShare;
	if (!btElasticPlasticIsFinite(share) || share < 0 || share > 1)
		return btElasticPlasticFault("kinematic share of hardening", share, "0 to 1");
	double strain = 0, stress = material.m_yieldStress, slope = 0;
	for (int i = 0; i < material.m_hardening.size(); ++i)
	{
		const btElasticPlasticHardeningPoint& point = material.m_hardening[i];
		if (btElasticPlasticFault f = btElasticPlasticCheckPositive("stress of hardening [Pa]", point.m_stress))
			return f;
		if (!btElasticPlasticIsFinite(double(point.m_strain)) || !(point.m_strain > strain))
			return btElasticPlasticFault("plastic strain of hardening", point.m_strain,
										 "finite and more than at the point before");
		const double own = (double(point.m_stress) - stress) / (double(point.m_strain) - strain);
		// Of a straight line given in float.
		const double rounding = 1e-4 * slope;
		if (share > 0 && (!(own >= 0) || (i > 0 && own > slope + rounding)))
			return btElasticPlasticFault("slope of kinematic hardening [Pa]", btScalar(own),
										 "not negative, and not more than before (or m_kinematicShare 0)");
		strain = point.m_strain;
		stress = point.m_stress;
		slope = own;
	}
	return btElasticPlasticFault();
}
}  // namespace

btElasticPlasticFault btElasticPlasticMaterial::fault() const
{
	if (btElasticPlasticFault f = btElasticPlasticCheckPositive("Young's modulus [Pa]", m_youngsModulus))
		return f;
	if (btElasticPlasticFault f = btElasticPlasticCheckPositive("density [kg/m^3]", m_density))
		return f;
	if (btElasticPlasticFault f = btElasticPlasticCheckPositive("yield stress [Pa]", m_yieldStress))
		return f;
	if (btElasticPlasticFault f = btElasticPlasticCheckPositive("ultimate plastic strain", m_ultimatePlasticStrain))
		return f;
	if (btElasticPlasticFault f =
			btElasticPlasticCheckNotNegative("strength in tension over yield stress", m_tensileShare))
		return f;
	if (btElasticPlasticFault f = btElasticPlasticCheckNotNegative("crushing strain", m_crushingStrain))
		return f;
	if (m_shearYield != BT_EP_TRESCA && m_shearYield != BT_EP_VON_MISES)
		return btElasticPlasticFault("yield in shear", btScalar(m_shearYield), "BT_EP_TRESCA or BT_EP_VON_MISES");
	if (!(btElasticPlasticIsFinite(m_poissonsRatio) && m_poissonsRatio > -1 && m_poissonsRatio <= btScalar(0.5)))
		return btElasticPlasticFault("Poisson's ratio", m_poissonsRatio, "greater than -1 and at most 0.5");
	if (!(btElasticPlasticIsFinite(m_loadBearingShare) && m_loadBearingShare > 0 && m_loadBearingShare <= 1))
		return btElasticPlasticFault("load-bearing share of the section", m_loadBearingShare,
									 "greater than 0 and at most 1");
	if (btElasticPlasticFault f = btElasticPlasticCheckNotNegative("fracture energy [J/m^2]", m_fractureEnergy))
		return f;
	if (m_fractureEnergy > 0 && (m_tensileShare == 0 || m_hardening.size() > 0))
		return btElasticPlasticFault("fracture energy [J/m^2]", m_fractureEnergy,
									 "0 of a material without strength in tension or with hardening");
	if (btElasticPlasticFault f =
			btElasticPlasticCheckNotNegative("rate at which strength doubles [1/s]", m_rate.m_reference))
		return f;
	if (!btElasticPlasticIsFinite(double(m_rate.m_exponent)) || !(m_rate.m_exponent >= 1))
		return btElasticPlasticFault("exponent of the rate of strain", m_rate.m_exponent, "finite, at least 1");
	if (btElasticPlasticFault f = btElasticPlasticCheckDampingRatio(m_dampingRatio))
		return f;
	if (btElasticPlasticFault f = btElasticPlasticCheckNotNegative("shear modulus [Pa]", m_shearModulus))
		return f;
	if (btElasticPlasticFault f = btElasticPlasticCheckNotNegative("strength in shear [Pa]", m_shearStrength))
		return f;
	if (btElasticPlasticFault f = btElasticPlasticCheckFriction(m_friction))
		return f;
	return faultOfHardening(*this);
}

btElasticPlasticMaterial btElasticPlasticMaterial::steel(btScalar yieldStress)
{
	btElasticPlasticMaterial m;
	m.m_yieldStress = yieldStress;
	return m;
}

btElasticPlasticMaterial btElasticPlasticMaterial::reinforcedConcrete(btScalar steelShare, btScalar yieldStress)
{
	btElasticPlasticMaterial m = steel(yieldStress);
	m.m_density = 2000;
	m.m_loadBearingShare = steelShare;
	m.m_dampingRatio = btScalar(0.03);
	return m;
}
