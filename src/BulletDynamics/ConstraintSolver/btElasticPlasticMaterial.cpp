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
	btElasticPlasticFault f;
	if (!(m_poissonsRatio > -1 && m_poissonsRatio <= btScalar(0.5)))
	{
		f.m_quantity = "Poisson's ratio";
		f.m_value = m_poissonsRatio;
		f.m_range = "greater than -1 and at most 0.5";
	}
	else if (!(m_loadBearingShare > 0 && m_loadBearingShare <= 1))
	{
		f.m_quantity = "load-bearing share of the section";
		f.m_value = m_loadBearingShare;
		f.m_range = "greater than 0 and at most 1";
	}
	return f;
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
