#include "BulletDynamics/ConstraintSolver/btElasticPlasticDebugDraw.h"
#include "Parts.h"

namespace ep
{
namespace
{
const Colour CONCRETE = {.50f, .48f, .44f}, OLD_CONCRETE = {.36f, .345f, .32f}, ASPHALT = {.075f, .075f, .08f},
			 PAINT = {.62f, .60f, .54f}, TORN = {.045f, .03f, .028f};

btTransform at(btScalar x, btScalar y, btScalar z = 0)
{
	return btTransform(btQuaternion(0, 0, 0, 1), btVector3(x, y, z));
}

void addRoads(std::vector<Part>& parts, const BridgeSettings& s)
{
	const btScalar foot = s.span / 2 + s.supportLength + s.rampLength, length = 900;
	for (btScalar side : {btScalar(-1), btScalar(1)})
		parts.push_back(
			boxPart(at(side * (foot + length / 2), 0), btVector3(length, btScalar(.02), s.width + 1), ASPHALT));
	// The road that the bridge is for.
	parts.push_back(boxPart(at(0, 0), btVector3(8, btScalar(.02), 1800), ASPHALT));
	for (int i = -40; i <= 40; ++i)
		parts.push_back(boxPart(at(0, 0, btScalar(7) * i), btVector3(btScalar(.18), btScalar(.03), 3), PAINT));
}

void addSupport(std::vector<Part>& parts, const BridgeSettings& s, btScalar side)
{
	const btScalar face = s.span / 2, back = face + s.supportLength, foot = back + s.rampLength;
	const btScalar under = s.height - s.thickness, lane = s.width - btScalar(.7);
	parts.push_back(boxPart(at(side * (face + back) / 2, s.height / 2), btVector3(s.supportLength, s.height, s.width),
							OLD_CONCRETE));
	parts.push_back(
		boxPart(at(side * (face - s.ledge / 2), under / 2), btVector3(s.ledge, under, s.width), OLD_CONCRETE));
	std::vector<btVector3> slope = {btVector3(back, 0, 0), btVector3(foot, 0, 0), btVector3(back, s.height, 0)};
	const btScalar thin = btScalar(.02), top = s.height + thin;
	std::vector<btVector3> road = {btVector3(back, s.height, 0), btVector3(foot, 0, 0), btVector3(foot, thin, 0),
								   btVector3(back, top, 0)};
	const btTransform turn(btQuaternion(btVector3(0, 1, 0), side > 0 ? btScalar(0) : SIMD_PI));
	parts.push_back(prismPart(turn, slope, s.width, OLD_CONCRETE));
	parts.push_back(prismPart(turn, road, lane, ASPHALT));
	parts.push_back(
		boxPart(turn * at((face + back) / 2, s.height), btVector3(s.supportLength, 2 * thin, lane), ASPHALT));
}

void addBlock(std::vector<Part>& parts, const Bridge& bridge, const btTransform& pose)
{
	const BridgeSettings& s = bridge.settings();
	// A little short, so that the joints show.
	const btScalar length = bridge.blockLength() - btScalar(.06), top = s.thickness / 2;
	parts.push_back(boxPart(pose, btVector3(length, s.thickness, s.width), CONCRETE));
	parts.push_back(boxPart(pose * at(0, top), btVector3(length, btScalar(.04), s.width - btScalar(.7)), ASPHALT));
	parts.push_back(boxPart(pose * at(0, top), btVector3(length / 2, btScalar(.05), btScalar(.14)), PAINT));
}

/// The steel, as plates on the deck's sides and a strip across the roadway.
void addSteel(std::vector<Part>& parts, const BridgeSettings& s, const btTransform& pose, btScalar length,
			  const Colour& colour)
{
	parts.push_back(boxPart(pose, btVector3(length, s.thickness * btScalar(.5), s.width + btScalar(.14)), colour, .7f));
	parts.push_back(
		boxPart(pose, btVector3(length / 3, s.thickness + btScalar(.07), s.width - btScalar(.7)), colour, .4f));
	for (btScalar x : {btScalar(-.3), btScalar(.3)})
		for (btScalar y : {btScalar(-.13), btScalar(.13)})
			parts.push_back(cylinderPart(pose * at(x * length, y * s.thickness), btScalar(.045), s.width + btScalar(.2),
										 {.12f, .12f, .13f}, .6f));
}

void addJoint(std::vector<Part>& parts, const BridgeSettings& s, const btElasticPlasticJoint& joint)
{
	const btTransform a = joint.getFrameA(), b = joint.getFrameB();
	const btScalar length = btScalar(.64);
	if (!joint.isBroken())
	{
		const btTransform middle(a.getRotation().slerp(b.getRotation(), btScalar(.5)), joint.getPosition());
		addSteel(parts, s, middle, length, jointColour(joint.getUtilisation(), joint.getDamage()));
		return;
	}
	// Torn: a dark stump on either side, where a part of the length still holds.
	const btScalar half = length / 2 - btScalar(.03);
	addSteel(parts, s, a * at(-length / 4, 0), half, TORN);
	addSteel(parts, s, b * at(length / 4, 0), half, TORN);
}
}  // namespace

Colour jointColour(btScalar utilisation, btScalar damage)
{
	// Painted steel rather than pure lamps.
	const btVector3 c = btElasticPlasticColour(utilisation, damage);
	return {float(c.x()) * .74f + .02f, float(c.y()) * .50f + .02f, .03f};
}

void addParts(std::vector<Part>& parts, const Bridge& bridge)
{
	addRoads(parts, bridge.settings());
	for (btScalar side : {btScalar(-1), btScalar(1)})
		addSupport(parts, bridge.settings(), side);
	for (const btRigidBody* block : bridge.deck())
		addBlock(parts, bridge, block->getCenterOfMassTransform());
	for (const btElasticPlasticJoint* joint : bridge.joints())
		addJoint(parts, bridge.settings(), *joint);
}
}  // namespace ep
