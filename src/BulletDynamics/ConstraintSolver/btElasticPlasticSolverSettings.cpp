// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "btElasticPlasticSolverSettings.h"

btElasticPlasticFault btElasticPlasticSolverSettings::fault() const
{
	if (m_form != BT_EP_DIRECT && m_form != BT_EP_ITERATIVE)
		return btElasticPlasticFault("form", btScalar(m_form), "BT_EP_DIRECT or BT_EP_ITERATIVE");
	if (m_contacts < BT_EP_CONTACTS_BY_ISLAND || m_contacts > BT_EP_SWEPT_CONTACTS)
		return btElasticPlasticFault("way of contacts", btScalar(m_contacts), "one of btElasticPlasticContacts");
	if (m_numThreads < 1 || m_numThreads > MAX_THREADS)
		return btElasticPlasticFault("number of threads", btScalar(m_numThreads), "1 to 64");
	if (m_maxNewtonSteps < 0)
		return btElasticPlasticFault("number of Newton steps", btScalar(m_maxNewtonSteps), "at least 0");
	if (m_maxInteriorIterations < 0)
		return btElasticPlasticFault("number of interior iterations", btScalar(m_maxInteriorIterations), "at least 0");
	if (m_maxExactContacts < 0)
		return btElasticPlasticFault("number of exact contacts", btScalar(m_maxExactContacts), "at least 0");
	if (m_maxWork < 0)
		return btElasticPlasticFault("work", btScalar(m_maxWork), "at least 0");
	if (!btElasticPlasticIsNumber(m_innerError) || m_innerError < 0 || m_innerError > 1)
		return btElasticPlasticFault("error of inner steps", btScalar(m_innerError), "0 to 1");
	if (m_maxInnerSteps < 1 || m_maxInnerSteps > MAX_INNER_STEPS)
		return btElasticPlasticFault("number of inner steps", btScalar(m_maxInnerSteps), "1 to 4096");
	if (m_maxInnerWork <= 0)
		return btElasticPlasticFault("work of inner steps", btScalar(m_maxInnerWork), "greater than 0");
	if (m_maxContactLoops < 0)
		return btElasticPlasticFault("number of rounds of contacts", btScalar(m_maxContactLoops), "at least 0");
	if (m_maxIterations < 0)
		return btElasticPlasticFault("number of iterations", btScalar(m_maxIterations), "at least 0");
	if (m_maxVectorWidth != 1 && m_maxVectorWidth != 2 && m_maxVectorWidth != 4 && m_maxVectorWidth != 8)
		return btElasticPlasticFault("width of vectors", btScalar(m_maxVectorWidth), "1, 2, 4 or 8");
	if (const btElasticPlasticFault f =
			btElasticPlasticCheckPositive("tolerance of contacts", btScalar(m_contactTolerance)))
		return f;
	return btElasticPlasticCheckPositive("tolerance of iterations", btScalar(m_iterationTolerance));
}
