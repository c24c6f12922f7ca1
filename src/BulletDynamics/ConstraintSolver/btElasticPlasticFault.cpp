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

#include "btElasticPlasticFault.h"

#include <stdio.h>

const char* btElasticPlasticDofName(int dof)
{
	static const char* const names[BT_EP_DOF_COUNT] = {"axial",   "shear y",   "shear z",
													   "torsion", "bending y", "bending z"};
	return dof >= 0 && dof < BT_EP_DOF_COUNT ? names[dof] : "?";
}

void btElasticPlasticFault::print(char* text, int capacity) const
{
	if (capacity <= 0)
		return;
	if (!*this)
		snprintf(text, capacity, "no fault");
	else if (m_dof >= 0)
		snprintf(text, capacity, "%s of degree of freedom %d (%s) is %g; it must be %s", m_quantity, m_dof,
				 btElasticPlasticDofName(m_dof), double(m_value), m_range);
	else
		snprintf(text, capacity, "%s is %g; it must be %s", m_quantity, double(m_value), m_range);
}

static btElasticPlasticFault fault(const char* quantity, btScalar value, const char* range, int dof)
{
	btElasticPlasticFault f;
	f.m_quantity = quantity;
	f.m_value = value;
	f.m_range = range;
	f.m_dof = dof;
	return f;
}

btElasticPlasticFault btElasticPlasticCheckPositive(const char* quantity, btScalar value, int dof)
{
	if (btElasticPlasticIsFinite(value) && value > 0)
		return btElasticPlasticFault();
	return fault(quantity, value, "finite and greater than 0", dof);
}

btElasticPlasticFault btElasticPlasticCheckNotNegative(const char* quantity, btScalar value, int dof)
{
	if (btElasticPlasticIsFinite(value) && value >= 0)
		return btElasticPlasticFault();
	return fault(quantity, value, "finite and not negative", dof);
}
