// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_DRAWING_H
#define EP_DRAWING_H

#include <string>
#include <vector>

#include "LinearMath/btTransform.h"

namespace ep
{
/// Linear light, 0 to 1.
struct Colour
{
	float r, g, b;
};

/// Of a joint: green over yellow to red with utilisation, darker with damage.
Colour jointColour(double utilisation, double damage);

/// A thing to draw: a convex profile in the x-y plane of its pose, drawn out along z. SI units.
struct Part
{
	btTransform pose;
	std::vector<btVector3> profile;  ///< corners, counter-clockwise seen from +z; their z is not used
	btScalar width;                  ///< along z, half of it to each side
	Colour colour;
	float gloss = 0;     ///< 0 is dull, 1 is polished
	bool round = false;  ///< the profile stands for a curve: its sides are shaded as one
};

Part boxPart(const btTransform& pose, const btVector3& size, const Colour& colour, float gloss = 0);

/// The cylinder's axis is z.
Part cylinderPart(const btTransform& pose, btScalar radius, btScalar width, const Colour& colour, float gloss = 0);
Part prismPart(const btTransform& pose, const std::vector<btVector3>& profile, btScalar width, const Colour& colour,
			   float gloss = 0);

/// In slices.
void addSphere(std::vector<Part>& parts, const btTransform& pose, btScalar radius, const Colour& colour);

/// A bent thing to draw: an outline in the y-z planes of stations along it, drawn through all of them.
struct Skin
{
	std::vector<btTransform> stations;  ///< x along the thing
	std::vector<btVector3>
		outline;  ///< corners of a convex shape, counter-clockwise seen against x; their x is not used
	Colour colour;
	float gloss = 0;
	bool round = false;
};

/// y along the height; the middle may be off the stations' origin.
std::vector<btVector3> boxOutline(btScalar height, btScalar width, btScalar middle = 0);
std::vector<btVector3> circleOutline(btScalar radius);

/// A little cloud that hides nothing wholly, or the trace of a spark. It throws no shadow.
struct Puff
{
	btVector3 place;
	btVector3 trace;  ///< it is drawn out by that to both sides [m]
	float radius;
	Colour colour;  ///< above 1 it glows
	float opacity;  ///< in its middle, 0 to 1
};

/// From a point to a point, upright.
struct Camera
{
	btVector3 eye = btVector3(0, 10, 40), target = btVector3(0, 0, 0);
	float fieldOfView = 0.75f;  ///< vertical [rad]
};

struct View
{
	std::vector<Part> parts;
	Camera camera;
	std::vector<Skin> skins = {};
	std::vector<Puff> puffs = {};
};

/// Quantities over another one, which grows. Axes reach from 0 to it, or beyond it.
struct Chart
{
	struct Series
	{
		Colour colour;
		std::vector<float> values;  ///< one for each x, left out where it is not finite
	};

	std::string title, xUnit;
	std::vector<float> x;
	std::vector<Series> bands;  ///< stacked from below
	std::vector<Series> lines;
	float limit = 0;  ///< a line of its own on both sides of 0, once half of it is reached; 0: none
};

/// All there is to see at a moment. The ground is the plane y = 0.
struct Drawing
{
	struct Key
	{
		Colour colour;
		std::string text;
	};

	std::vector<Part> parts;
	std::vector<Skin> skins;
	std::vector<Puff> puffs;
	btTransform subject = btTransform::getIdentity();  ///< what a camera follows, x forward
	std::vector<View> views;        ///< with cameras of their own: the first one large, others beside it
	std::vector<std::string> text;  ///< lines for the reader
	std::vector<Key> legend;        ///< what colours mean
	Chart chart;
};
}  // namespace ep

#endif  // EP_DRAWING_H
