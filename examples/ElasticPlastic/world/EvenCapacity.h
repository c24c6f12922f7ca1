// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_EVEN_CAPACITY_H
#define EP_EVEN_CAPACITY_H

#include "BulletDynamics/ConstraintSolver/btElasticPlasticCapacity.h"

namespace ep
{
/// The same stiffness and yield value in all degrees of freedom.
inline btElasticPlasticCapacity evenCapacity(double stiffness,
											 double yield = double(btElasticPlasticCapacity::unlimited()))
{
	btElasticPlasticCapacity capacity;
	for (int i = 0; i < BT_EP_DOF_COUNT; ++i)
		capacity.set(i, btScalar(stiffness), btScalar(yield));
	return capacity;
}
}  // namespace ep

#endif  // EP_EVEN_CAPACITY_H
