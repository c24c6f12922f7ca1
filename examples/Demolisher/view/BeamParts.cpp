// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "view/BeamSkin.h"
#include "view/Parts.h"
#include "world/JointReading.h"

namespace ep
{
const Colour TORN = {.55f, .01f, .30f};

namespace
{
const Colour CONCRETE = {.50f, .48f, .44f}, STEEL = {.42f, .43f, .46f}, BOX = {.40f, .38f, .34f};

void addJoint(Drawing& drawing, const World& world, const btElasticPlasticJoint& joint, const btVector3& size)
{
	const JointReading r = readJoint(world, joint);
	if (!r.isThere)
		return;
	const btTransform a = joint.getFrameA(), b = joint.getFrameB();
	if (!r.isBroken)
	{
		const btTransform middle(a.getRotation().slerp(b.getRotation(), btScalar(.5)),
								 (a.getOrigin() + b.getOrigin()) / 2);
		drawing.parts.push_back(boxPart(middle, size, jointColour(r.utilisation, r.damage), .6f));
		return;
	}
	// On what moves: where a support held it, nothing is left to see.
	const btVector3 half(size.x() / 2, size.y(), size.z());
	if (!joint.getConstraint().getRigidBodyA().isStaticObject())
		drawing.parts.push_back(boxPart(a * at(-half.x() / 2), half, TORN, .4f));
	if (!joint.getConstraint().getRigidBodyB().isStaticObject())
		drawing.parts.push_back(boxPart(b * at(half.x() / 2), half, TORN, .4f));
}
}  // namespace

void addBeam(Drawing& drawing, const World& world, const Beam& beam, const Colour& colour, float gloss, bool skin)
{
	const BeamSettings& s = beam.settings();
	if (!skin)
	{
		// A little short, so that the joints show.
		const btVector3 size(beam.m_partLength * btScalar(.96), s.height, s.width);
		for (const btRigidBody* block : beam.m_parts)
			drawing.parts.push_back(boxPart(block->getCenterOfMassTransform(), size, colour, gloss));
		return;
	}
	Skin length;
	length.outline = s.isRound ? circleOutline(s.height / 2) : boxOutline(s.height, s.width);
	length.colour = colour;
	length.gloss = gloss;
	length.round = s.isRound;
	for (const auto& stations : skinStations(world, beam))
	{
		length.stations = stations;
		drawing.skins.push_back(length);
	}
}

void addJoints(Drawing& drawing, const World& world, const Beam& beam, const btVector3& size)
{
	for (const btElasticPlasticJoint* joint : beam.joints())
		addJoint(drawing, world, *joint, size);
}

void addParts(Drawing& drawing, const World& world, const Structure& structure, const PartStyle& style)
{
	for (const btRigidBody* box : structure.boxes())
	{
		btVector3 low, high;
		box->getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
		drawing.parts.push_back(boxPart(box->getCenterOfMassTransform(), high - low, BOX));
	}
	for (const Beam& beam : structure.beams())
	{
		const BeamSettings& s = beam.settings();
		const bool isSteel = s.material.m_loadBearingShare >= 1;
		addBeam(drawing, world, beam, isSteel ? STEEL : CONCRETE, isSteel ? .6f : 0.f, style.skin);
		// Enough to be seen on a thin bar.
		const btScalar thicker = btMax(btScalar(.04), s.height * btScalar(.15));
		const btVector3 mark(btMin(btScalar(.16), beam.m_partLength / 3), s.height + thicker, s.width + thicker);
		if (style.joints)
			addJoints(drawing, world, beam, mark);
	}
}
}  // namespace ep
