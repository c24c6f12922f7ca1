#include "CharpyDrawing.h"

#include <cstdio>

namespace ep
{
namespace
{
const Colour HAMMER = {.16f, .22f, .32f}, ANVIL = {.30f, .30f, .31f},
			 HALF[2] = {{.60f, .20f, .005f}, {.75f, .42f, .01f}};

template <class... Values>
std::string format(const char* pattern, Values... values)
{
	char text[128];
	std::snprintf(text, sizeof text, pattern, values...);
	return text;
}

btTransform drawn(const CharpySettings& s, const btTransform& pose)
{
	const btScalar scale = btScalar(CHARPY_DRAWN_PER_METRE / s.lengthsPerMetre);
	return btTransform(pose.getBasis(), pose.getOrigin() * scale + btVector3(0, btScalar(CHARPY_DRAWN_LEVEL), 0));
}

/// A part's profile lies in its x-y plane and is drawn out along z; ours lies in x-z and is drawn out along y.
/// \param top  above the specimen's axis, to which an upright body is drawn [m]
Part upright(const CharpySettings& s, const CharpyShape& shape, const btTransform& pose, double top,
			 const Colour& colour)
{
	const btScalar scale = btScalar(CHARPY_DRAWN_PER_METRE);
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
Part arm(const CharpySettings& s, const btTransform& hammer)
{
	const btScalar scale = btScalar(CHARPY_DRAWN_PER_METRE);
	const btVector3 toAxis = -hammerCentre(s) * scale;
	const btTransform along(btQuaternion(btVector3(0, 0, 1), btAtan2(toAxis.y(), toAxis.x())), toAxis / 2);
	return boxPart(drawn(s, hammer) * along, btVector3(toAxis.length(), 3, btScalar(1.6)), HAMMER, .2f);
}
}  // namespace

Drawing drawCharpy(const Charpy& charpy, bool cut)
{
	const CharpySettings& s = charpy.settings();
	const CharpyParts& parts = charpy.parts();
	const double top = cut ? s.width * 0.7 : 1;
	Drawing drawing;
	for (int i = 0; i < 2; ++i)
		drawing.parts.push_back(upright(s, anvilShape(s, i == 0), parts.anvils[i]->getWorldTransform(), top, ANVIL));
	const int n = int(parts.pieces.size());
	for (int i = 0; i < n; ++i)
		drawing.parts.push_back(
			upright(s, pieceShape(s, i), parts.pieces[size_t(i)]->getWorldTransform(), 1, HALF[n > 1 && 2 * i >= n]));
	drawing.parts.push_back(upright(s, hammerShape(s), parts.hammer->getWorldTransform(), top, HAMMER));

	if (!cut)
		drawing.parts.push_back(arm(s, parts.hammer->getWorldTransform()));

	// Looking against the blow.
	drawing.subject =
		btTransform(btQuaternion(btVector3(0, 1, 0), SIMD_PI), btVector3(-5, btScalar(CHARPY_DRAWN_LEVEL), 0));
	const CharpyResult r = charpy.result();
	drawing.text = {
		format("%s, %s", charpyNameOf(charpyWays(), s.way).c_str(),
			   charpyNameOf(charpyGeometries(), s.geometry).c_str()),
		format("Step in the impact  %g ms", s.step * 1e3),
		format("Hammer  %.1f J at %.3f rad, lost %.1f J", r.hammerAfter, charpy.angle(),
			   charpy.hasStruck() ? r.loss() : 0.),
		format("Hinge  %.2f rad%s", r.hingeAngle, r.broken ? ", broken" : ""),
		format("Plastic work  %.1f J of %.1f J to pass", r.plasticWork, s.passingEnergy()),
		format("Friction  %.1f J, pieces %.1f J, contacts %.1f J", r.frictionWork, r.specimenEnergy, r.contactWork),
		format("Time  %.2f ms, %s", charpy.time() * 1e3, nameOf(r.outcome)),
	};
	return drawing;
}
}  // namespace ep
