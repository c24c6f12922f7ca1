// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "view/Drawing.h"

namespace ep::charpy
{
namespace
{
const Colour HAMMER = {.16f, .22f, .32f}, ANVIL = {.30f, .30f, .31f},
			 HALF[2] = {{.60f, .20f, .005f}, {.75f, .42f, .01f}};

btTransform drawn(const Settings& s, const btTransform& pose)
{
	const btScalar scale = btScalar(DRAWN_PER_METRE / s.lengthsPerMetre);
	return btTransform(pose.getBasis(), pose.getOrigin() * scale + btVector3(0, btScalar(DRAWN_LEVEL), 0));
}

/// A part's profile lies in its x-y plane and is drawn out along z; ours lies in x-z and is drawn out along y.
/// \param top  above the specimen's axis, to which an upright body is drawn [m]
Part upright(const Settings& s, const Shape& shape, const btTransform& pose, double top, const Colour& colour)
{
	const btScalar scale = btScalar(DRAWN_PER_METRE);
	std::vector<btVector3> profile;
	for (auto corner = shape.plan.rbegin(); corner != shape.plan.rend(); ++corner)
		if (profile.empty() ||
			(btVector3(corner->x(), -corner->z(), 0) * scale - profile.back()).length() > btScalar(1e-6))
			profile.emplace_back(corner->x() * scale, -corner->z() * scale, btScalar(0));
	const double low = -shape.height / 2, high = btMin(shape.height / 2, top);
	const btTransform lie(btQuaternion(btVector3(1, 0, 0), -SIMD_HALF_PI),
						  btVector3(0, btScalar((low + high) / 2) * scale, 0));
	return prismPart(drawn(s, pose) * lie, profile, btScalar(high - low) * scale, colour, .4f);
}
/// Of the hammer; it has no mass and touches nothing.
Part arm(const Settings& s, const btTransform& hammer)
{
	const btScalar scale = btScalar(DRAWN_PER_METRE);
	const btVector3 toAxis = -hammerCentre(s) * scale;
	const btTransform along(btQuaternion(btVector3(0, 0, 1), btAtan2(toAxis.y(), toAxis.x())), toAxis / 2);
	return boxPart(drawn(s, hammer) * along, btVector3(toAxis.length(), 3, btScalar(1.6)), HAMMER, .2f);
}

Camera camera(double ex, double ey, double ez, double tx, double ty, double tz)
{
	Camera c;
	const btVector3 level(0, btScalar(DRAWN_LEVEL), 0);
	c.eye = level + btVector3(btScalar(ex), btScalar(ey), btScalar(ez));
	c.target = level + btVector3(btScalar(tx), btScalar(ty), btScalar(tz));
	return c;
}
}  // namespace

std::vector<Part> partsOf(const ImpactTest& charpy, bool cut)
{
	const Settings& s = charpy.settings();
	const Parts& bodies = charpy.parts();
	const double top = cut ? s.width * 0.7 : 1;
	std::vector<Part> parts;
	for (int i = 0; i < 2; ++i)
		parts.push_back(upright(s, anvilShape(s, i == 0), bodies.anvils[i]->getWorldTransform(), top, ANVIL));
	const int n = int(bodies.pieces.size());
	for (int i = 0; i < n; ++i)
		parts.push_back(
			upright(s, pieceShape(s), bodies.pieces[size_t(i)]->getWorldTransform(), 1, HALF[n > 1 && 2 * i >= n]));
	parts.push_back(upright(s, hammerShape(s), bodies.hammer->getWorldTransform(), top, HAMMER));
	if (!cut)
		parts.push_back(arm(s, bodies.hammer->getWorldTransform()));
	return parts;
}

std::vector<View> viewsOf(const ImpactTest& charpy, bool cut)
{
	const std::vector<Part> detail = partsOf(charpy, cut);
	return {{detail, camera(7, 15, 9, 1, 0, 0)},
			{detail, camera(0.99, 18, 0, 1, 0, 0)},
			{partsOf(charpy, false), camera(46, 20, 30, -10, 2, 0)}};
}
}  // namespace ep::charpy
