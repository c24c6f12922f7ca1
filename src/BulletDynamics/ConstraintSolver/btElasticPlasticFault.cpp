// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

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

btElasticPlasticFault btElasticPlasticCheckPositive(const char* quantity, btScalar value, int dof)
{
	if (btElasticPlasticIsFinite(value) && value > 0)
		return btElasticPlasticFault();
	return btElasticPlasticFault(quantity, value, "finite and greater than 0", dof);
}

btElasticPlasticFault btElasticPlasticCheckNotNegative(const char* quantity, btScalar value, int dof)
{
	if (btElasticPlasticIsFinite(value) && value >= 0)
		return btElasticPlasticFault();
	return btElasticPlasticFault(quantity, value, "finite and not negative", dof);
}

btElasticPlasticFault btElasticPlasticCheckDampingRatio(btScalar value)
{
	if (btElasticPlasticIsFinite(value) && value >= 0 && value <= btScalar(0.1))
		return btElasticPlasticFault();
	return btElasticPlasticFault("damping ratio", value, "from 0 to 0.1");
}

btElasticPlasticFault btElasticPlasticCheckFriction(btScalar value)
{
	if (btElasticPlasticIsFinite(value) && value >= 0 && value <= 2)
		return btElasticPlasticFault();
	return btElasticPlasticFault("friction of shear forces under pressure", value, "from 0 to 2");
}
