// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "view/BeamSkin.h"
#include "view/Parts.h"

namespace ep
{
namespace
{
const Colour NEW_CONCRETE = {.50f, .48f, .44f}, OLD_CONCRETE = {.36f, .345f, .32f}, ASPHALT = {.075f, .075f, .08f},
			 PAINT = {.62f, .60f, .54f};

void addRoads(std::vector<Part>& parts, const Bridge& bridge)
{
	const BridgeSettings& s = bridge.settings();
	const btTransform place(btQuaternion(0, 0, 0, 1), bridge.origin());
	const btScalar foot = s.span / 2 + s.supportLength + s.rampLength;
	// In pieces: shadows are not computed exactly enough for long ones.
	const btScalar piece = 30;
	for (btScalar side : {btScalar(-1), btScalar(1)})
		for (int i = 0; i < 30; ++i)
			parts.push_back(boxPart(place * at(side * (foot + (i + btScalar(.5)) * piece), 0),
									btVector3(piece, btScalar(.02), s.width + 1), ASPHALT));
	// The road that the bridge is for.
	parts.push_back(boxPart(place * at(0, 0), btVector3(8, btScalar(.02), 1800), ASPHALT));
	for (int i = -40; i <= 40; ++i)
		parts.push_back(boxPart(place * at(0, 0, btScalar(7) * i), btVector3(btScalar(.18), btScalar(.03), 3), PAINT));
}

void addSupport(std::vector<Part>& parts, const Bridge& bridge, btScalar side)
{
	const BridgeSettings& s = bridge.settings();
	const btTransform place(btQuaternion(0, 0, 0, 1), bridge.origin());
	const btScalar face = s.span / 2, back = face + s.supportLength, foot = back + s.rampLength;
	const btScalar under = s.height - s.thickness, lane = s.width - btScalar(.7);
	parts.push_back(boxPart(place * at(side * (face + back) / 2, s.height / 2),
							btVector3(s.supportLength, s.height, s.width), OLD_CONCRETE));
	parts.push_back(
		boxPart(place * at(side * (face - s.ledge / 2), under / 2), btVector3(s.ledge, under, s.width), OLD_CONCRETE));
	std::vector<btVector3> slope = {btVector3(back, 0, 0), btVector3(foot, 0, 0), btVector3(back, s.height, 0)};
	const btScalar thin = btScalar(.02), top = s.height + thin;
	std::vector<btVector3> road = {btVector3(back, s.height, 0), btVector3(foot, 0, 0), btVector3(foot, thin, 0),
								   btVector3(back, top, 0)};
	const btTransform turn = place * btTransform(btQuaternion(btVector3(0, 1, 0), side > 0 ? btScalar(0) : SIMD_PI));
	parts.push_back(prismPart(turn, slope, s.width, OLD_CONCRETE));
	parts.push_back(prismPart(turn, road, lane, ASPHALT));
	parts.push_back(
		boxPart(turn * at((face + back) / 2, s.height), btVector3(s.supportLength, 2 * thin, lane), ASPHALT));
}

const btScalar ROADWAY = btScalar(.04);  // thickness [m]

/// Roadway and its middle line, which lie on the deck.
void addRoadway(Drawing& drawing, const World& world, const Bridge& bridge, bool skin)
{
	const BridgeSettings& s = bridge.settings();
	const btScalar top = s.thickness / 2, lane = s.width - btScalar(.7);
	Skin asphalt;
	asphalt.outline = boxOutline(ROADWAY, lane, top);
	asphalt.colour = ASPHALT;
	for (const auto& stations : skinStations(world, bridge.deck()))
	{
		asphalt.stations = stations;
		if (skin)
			drawing.skins.push_back(asphalt);
	}
	const btScalar length = bridge.deck().m_partLength;
	for (const btRigidBody* block : bridge.deck().m_parts)
	{
		const btTransform pose = block->getCenterOfMassTransform() * at(0, top);
		if (!skin)
			drawing.parts.push_back(boxPart(pose, btVector3(length * btScalar(.96), ROADWAY, lane), ASPHALT));
		drawing.parts.push_back(boxPart(pose, btVector3(length / 2, ROADWAY + btScalar(.02), btScalar(.14)), PAINT));
	}
}
}  // namespace

void addParts(Drawing& drawing, const World& world, const Bridge& bridge, const PartStyle& style)
{
	const BridgeSettings& s = bridge.settings();
	addRoads(drawing.parts, bridge);
	for (btScalar side : {btScalar(-1), btScalar(1)})
		addSupport(drawing.parts, bridge, side);
	addBeam(drawing, world, bridge.deck(), NEW_CONCRETE, 0, style.skin);
	addRoadway(drawing, world, bridge, style.skin);
	if (!style.joints)
		return;
	// The steel, as plates on the deck's sides and a strip across the roadway.
	const btScalar length = btScalar(.64);
	addJoints(drawing, world, bridge.deck(), btVector3(length, s.thickness / 2, s.width + btScalar(.14)));
	addJoints(drawing, world, bridge.deck(),
			  btVector3(length / 3, s.thickness + btScalar(.09), s.width - btScalar(.7)));
}
}  // namespace ep
