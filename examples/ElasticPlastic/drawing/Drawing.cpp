// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "drawing/Drawing.h"

#include "BulletDynamics/ConstraintSolver/btElasticPlasticDebugDraw.h"

namespace ep
{
Colour jointColour(double utilisation, double damage)
{
	// Painted steel rather than pure lamps.
	const btVector3 c = btElasticPlasticColour(btScalar(utilisation), btScalar(damage));
	return {float(c.x()) * .74f + .02f, float(c.y()) * .50f + .02f, .03f};
}

Part prismPart(const btTransform& pose, const std::vector<btVector3>& profile, btScalar width, const Colour& colour,
			   float gloss)
{
	Part part;
	part.pose = pose;
	part.profile = profile;
	part.width = width;
	part.colour = colour;
	part.gloss = gloss;
	return part;
}

Part boxPart(const btTransform& pose, const btVector3& size, const Colour& colour, float gloss)
{
	const btScalar x = size.x() / 2, y = size.y() / 2;
	return prismPart(pose, {btVector3(-x, -y, 0), btVector3(x, -y, 0), btVector3(x, y, 0), btVector3(-x, y, 0)},
					 size.z(), colour, gloss);
}

std::vector<btVector3> boxOutline(btScalar height, btScalar width, btScalar middle)
{
	const btScalar y = height / 2, z = width / 2;
	return {btVector3(0, middle - y, -z), btVector3(0, middle + y, -z), btVector3(0, middle + y, z),
			btVector3(0, middle - y, z)};
}

std::vector<btVector3> circleOutline(btScalar radius)
{
	const int corners = 16;
	std::vector<btVector3> outline;
	for (int i = 0; i < corners; ++i)
	{
		const btScalar angle = SIMD_2_PI * i / corners;
		outline.emplace_back(btScalar(0), radius * btSin(angle), -radius * btCos(angle));
	}
	return outline;
}

void addSphere(std::vector<Part>& parts, const btTransform& pose, btScalar radius, const Colour& colour)
{
	const int slices = 10;
	for (int i = 0; i < slices; ++i)
	{
		// Of which the mean radius is the sphere's.
		const btScalar width = 2 * radius / slices, z = -radius + width * (btScalar(i) + btScalar(.5));
		parts.push_back(cylinderPart(pose * btTransform(btQuaternion(0, 0, 0, 1), btVector3(0, 0, z)),
									 btSqrt(radius * radius - z * z), width, colour, .3f));
	}
}

Part cylinderPart(const btTransform& pose, btScalar radius, btScalar width, const Colour& colour, float gloss)
{
	const int corners = 32;
	std::vector<btVector3> profile;
	for (int i = 0; i < corners; ++i)
	{
		const btScalar angle = SIMD_2_PI * i / corners;
		profile.emplace_back(radius * btCos(angle), radius * btSin(angle), btScalar(0));
	}
	Part part = prismPart(pose, profile, width, colour, gloss);
	part.round = true;
	return part;
}
}  // namespace ep
