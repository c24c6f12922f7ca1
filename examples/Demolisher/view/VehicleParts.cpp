// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "view/Parts.h"

namespace ep
{
namespace
{
const Colour YELLOW = {.78f, .36f, .02f}, DARK = {.05f, .05f, .055f}, GLASS = {.03f, .05f, .07f},
			 CHASSIS = {.22f, .22f, .23f}, RUBBER = {.028f, .028f, .03f}, LAMP = {.95f, .9f, .7f},
			 RUBBLE = {.27f, .25f, .22f};

/// Profiles and places in the vehicle's frame: x forward, y up, from the box's centre [m].
btVector3 p(double x, double y) { return btVector3(btScalar(x), btScalar(y), 0); }

btTransform placed(double x, double y, double z = 0, double turn = 0)
{
	return btTransform(btQuaternion(btVector3(0, 0, 1), btScalar(turn)),
					   btVector3(btScalar(x), btScalar(y), btScalar(z)));
}

btVector3 size(double x, double y, double z) { return btVector3(btScalar(x), btScalar(y), btScalar(z)); }

void addBody(std::vector<Part>& parts, const btTransform& pose)
{
	const auto prism = [&](const std::vector<btVector3>& profile, double width, const Colour& colour, float gloss)
	{ parts.push_back(prismPart(pose, profile, btScalar(width), colour, gloss)); };
	const auto box = [&](const btTransform& place, const btVector3& extent, const Colour& colour, float gloss)
	{ parts.push_back(boxPart(pose * place, extent, colour, gloss)); };

	// Frame and fenders
	prism({p(-3.4, -.65), p(3.3, -.65), p(3.45, -.3), p(3.45, .2), p(-3.4, .2)}, 1.9, DARK, .2f);
	prism({p(-3.5, .2), p(3.5, .2), p(3.5, .42), p(-3.5, .42)}, 3.2, YELLOW, .35f);
	// Cab
	prism({p(1.25, .42), p(3.5, .42), p(3.5, 1.0), p(2.9, 2.1), p(1.25, 2.1)}, 2.5, YELLOW, .35f);
	prism({p(1.25, 2.1), p(2.95, 2.1), p(2.85, 2.22), p(1.3, 2.22)}, 2.6, DARK, .2f);
	prism({p(1.55, 1.1), p(3.2, 1.1), p(2.75, 1.95), p(1.55, 1.95)}, 2.54, GLASS, .9f);
	box(placed(3.21, 1.55, 0, 2.07), size(1.0, .06, 2.2), GLASS, .9f);
	parts.push_back(cylinderPart(pose * placed(1.7, 2.3) * btTransform(btQuaternion(btVector3(1, 0, 0), SIMD_HALF_PI)),
								 btScalar(.13), btScalar(.22), {.95f, .3f, .02f}, .8f));
	// Bed with its load
	prism({p(-3.1, .42), p(1.0, .42), p(1.0, 1.75), p(-3.6, 1.45)}, 2.9, YELLOW, .35f);
	prism({p(-3.35, 1.4), p(.9, 1.7), p(-.1, 2.1), p(-2.0, 2.0)}, 2.5, RUBBLE, 0);
	for (double x : {-2.6, -1.6, -.6, .4})
		box(placed(x, 1.0), size(.14, 1.0, 3.06), {.55f, .25f, .015f}, .3f);
	prism({p(1.0, .42), p(1.12, .42), p(1.12, 2.35), p(1.0, 2.35)}, 2.9, YELLOW, .35f);
	// Blade
	prism({p(3.5, -.95), p(3.85, -1.05), p(3.72, -.4), p(3.85, .3), p(3.5, .2)}, 3.3, CHASSIS, .6f);
	for (double z : {-1.05, 1.05})
	{
		box(placed(3.52, .7, z), size(.06, .22, .34), LAMP, .8f);
		box(placed(-3.5, .3, z * 1.3), size(.06, .14, .3), {.6f, .02f, .01f}, .6f);
	}
}

void addWheel(std::vector<Part>& parts, const btWheelInfo& wheel)
{
	// The axle is the wheel's x axis, a cylinder's its z.
	const btTransform turn(btQuaternion(btVector3(0, 1, 0), SIMD_HALF_PI));
	const btTransform pose = wheel.m_worldTransform * turn;
	const btScalar radius = wheel.m_wheelsRadius, width = btScalar(.62);
	parts.push_back(cylinderPart(pose, radius, width, RUBBER, .1f));
	parts.push_back(cylinderPart(pose, radius * btScalar(.58), width + btScalar(.04), YELLOW, .35f));
	parts.push_back(cylinderPart(pose, radius * btScalar(.2), width + btScalar(.12), DARK, .4f));
	for (int i = 0; i < 6; ++i)
	{
		const btTransform bolt(btQuaternion(btVector3(0, 0, 1), SIMD_2_PI * i / 6));
		parts.push_back(
			boxPart(pose * bolt * placed(double(radius) * .4, 0), size(.12, .12, double(width) + .08), DARK, .3f));
	}
}
}  // namespace

void addParts(std::vector<Part>& parts, const Vehicle& vehicle)
{
	addBody(parts, vehicle.pose());
	for (int i = 0; i < vehicle.getNumWheels(); ++i)
		addWheel(parts, vehicle.getWheelInfo(i));
}
}  // namespace ep
