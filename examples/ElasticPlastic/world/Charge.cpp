// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "world/Charge.h"

#include <algorithm>
#include <cmath>

#include "world/ShownArea.h"

namespace ep
{
void blowCharge(World& world, const btVector3& place, double mass)
{
	const double impulse = 2 * 200 * std::pow(mass, 2. / 3), nearest = .5, furthest = 50;  // [Pa s m], [m]
	for (const auto& body : world.bodies())
	{
		const btVector3 way = body->getCenterOfMassPosition() - place;
		const double distance = double(way.length());
		if (!body->isInWorld() || body->getInvMass() == 0 || distance > furthest || distance < SIMD_EPSILON)
			continue;
		const btVector3 direction = way.normalized();
		const double area =
			shownArea(*body->getCollisionShape(), body->getWorldTransform().getBasis().transpose() * direction);
		body->activate(true);
		body->applyCentralImpulse(direction * btScalar(impulse * area / std::max(nearest, distance)));
	}
}
}  // namespace ep
