/*
Bullet Elastic-Plastic: joints for Bullet Physics that bend before they break
Copyright (c) 2026 Bullet Elastic-Plastic contributors

This software is provided 'as-is', without any express or implied warranty.
In no event will the authors be held liable for any damages arising from the use of this software.
Permission is granted to anyone to use this software for any purpose,
including commercial applications, and to alter it and redistribute it freely,
subject to the following restrictions:

1. The origin of this software must not be misrepresented; you must not claim that you wrote the original software. If you use this software in a product, an acknowledgment in the product documentation would be appreciated but is not required.
2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the original software.
3. This notice may not be removed or altered from any source distribution.
*/

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
