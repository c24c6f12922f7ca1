// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_LANES_H
#define BT_ELASTIC_PLASTIC_LANES_H

#include <string.h>

#include "../../btElasticPlasticDof.h"
#include "LinearMath/btScalar.h"

namespace btElasticPlastic
{
/// A number for each degree of freedom. Compilers make vector instructions of loops over all of them.
struct Lanes
{
	enum
	{
		COUNT = BT_EP_DOF_COUNT
	};

	btScalar m_at[COUNT];

	btScalar& operator[](int i) { return m_at[i]; }
	const btScalar& operator[](int i) const { return m_at[i]; }

	// Whole, not number by number: what has been written in parts is slow to be read as a vector.
	void load(const btScalar from[COUNT]) { memcpy(m_at, from, sizeof m_at); }
	void store(btScalar to[COUNT]) const { memcpy(to, m_at, sizeof m_at); }

	void fill(btScalar value)
	{
		for (btScalar& lane : m_at)
			lane = value;
	}
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_LANES_H
