// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticMaterial.h"

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
	if (!(btElasticPlasticIsFinite(m_poissonsRatio) && m_poissonsRatio > -1 && m_poissonsRatio <= btScalar(0.5)))
		return btElasticPlasticFault("Poisson's ratio", m_poissonsRatio, "greater than -1 and at most 0.5");
	if (!(btElasticPlasticIsFinite(m_loadBearingShare) && m_loadBearingShare > 0 && m_loadBearingShare <= 1))
		return btElasticPlasticFault("load-bearing share of the section", m_loadBearingShare,
									 "greater than 0 and at most 1");
	return btElasticPlasticFault();
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
	return m;
}
