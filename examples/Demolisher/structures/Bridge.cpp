// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "structures/Bridge.h"

namespace ep
{
namespace
{
const btScalar FRICTION = btScalar(.8);  // concrete on concrete
}  // namespace

Bridge::Bridge(World& world, const Materials& materials, const BridgeSettings& s, const btVector3& origin)
	: m_settings(s), m_origin(origin)
{
	btRigidBody* const left = addSupport(world, -1);
	addRamp(world, -1);
	btRigidBody* const right = addSupport(world, 1);
	addRamp(world, 1);
	BeamSettings deck;
	deck.blocks = s.blocks;
	deck.length = s.span;
	deck.height = s.thickness;
	deck.width = s.width;
	deck.section = btElasticPlasticSection::rectangle(s.width, s.thickness);
	deck.material = materials.mixed(s.steelShare);
	deck.hingeLength = s.hingeLength;
	// A support does not bend: there it spreads to one side only.
	deck.endHingeLength = s.hingeLength / 2;
	deck.friction = FRICTION;
	m_beams.emplace_back(world, "deck", deck, fromOrigin(-s.span / 2, s.height - s.thickness / 2));
	m_beams.front().joinStart(world, *left);
	btElasticPlasticJoint* const end = m_beams.front().joinEnd(world, *right);
	// As on real bridges one end slides lengthwise. Held at both ends, a deck that has bent would hang like a rope: axial
	// force and bending moment have their yield values each for itself here, and the rope would carry what bending cannot.
	if (s.slidingEnd)
		world.release(*end, BT_EP_AXIAL);
}

btTransform Bridge::fromOrigin(btScalar x, btScalar y) const
{
	return btTransform(btQuaternion(0, 0, 0, 1), m_origin + btVector3(x, y, 0));
}

btRigidBody* Bridge::addSupport(World& world, btScalar side)
{
	const BridgeSettings& s = m_settings;
	auto* const shape = new btCompoundShape;
	world.keep(shape);
	shape->addChildShape(at(0, s.height / 2), world.box(btVector3(s.supportLength, s.height, s.width)));
	const btScalar under = s.height - s.thickness;
	shape->addChildShape(at(-side * (s.supportLength + s.ledge) / 2, under / 2),
						 world.box(btVector3(s.ledge, under, s.width)));
	btRigidBody* const body = world.body(0, shape, fromOrigin(side * (s.span + s.supportLength) / 2, 0));
	body->setFriction(FRICTION);
	m_boxes.push_back(body);
	return body;
}

void Bridge::addRamp(World& world, btScalar side)
{
	const BridgeSettings& s = m_settings;
	auto* const shape = new btConvexHullShape;
	world.keep(shape);
	for (btScalar z : {-s.width / 2, s.width / 2})
	{
		shape->addPoint(btVector3(0, 0, z), false);
		shape->addPoint(btVector3(0, s.height, z), false);
		shape->addPoint(btVector3(side * s.rampLength, 0, z), false);
	}
	// The margin would round the ramp out beyond its support's top.
	shape->setMargin(0);
	shape->recalcLocalAabb();
	world.body(0, shape, fromOrigin(side * (s.span / 2 + s.supportLength), 0))->setFriction(FRICTION);
}

btScalar Bridge::sag() const
{
	const std::vector<btRigidBody*>& blocks = deck().m_parts;
	const btVector3 &a = blocks[(blocks.size() - 1) / 2]->getCenterOfMassPosition(),
					&b = blocks[blocks.size() / 2]->getCenterOfMassPosition();
	return m_origin.y() + m_settings.height - m_settings.thickness / 2 - (a.y() + b.y()) / 2;
}

btScalar Bridge::beamSag(btScalar gravity) const
{
	const btScalar load = deck().blockMass() / deck().m_partLength * gravity, l2 = m_settings.span * m_settings.span;
	return load * l2 * l2 / (384 * deck().bendingStiffness()) + load * l2 / (8 * deck().shearStiffness());
}

double Bridge::exactSag(btScalar gravity) const
{
	// The shear force at a node, w (x - L / 2), and the moment, M0 + w x (L - x) / 2, turn the next block against the one before and
	// shift it; M0 is such that all turns together are none, for both ends are clamped. By symmetry only the left half matters.
	const int n = m_settings.blocks;
	const double length = double(deck().m_partLength), load = double(deck().blockMass() * gravity) / length;
	const auto parabola = [&](int i) { return load * i * length * (n - i) * length / 2; };
	// By the joint at a node, with M0.
	const auto deformation = [&](int i, double moment0, int dof)
	{
		btScalar force[BT_EP_DOF_COUNT] = {};
		force[BT_EP_SHEAR_Y] = btScalar(load * (i - n / 2.) * length);
		force[BT_EP_BENDING_Z] = btScalar(moment0 + parabola(i));
		return double(deck().m_jointAt[i]->getCapacity().elasticDeformation(force, dof));
	};
	double turns = 0, softness = 0;
	for (int i = 0; i <= n; ++i)
	{
		turns += deformation(i, 0, BT_EP_BENDING_Z);
		softness += 1 / double(deck().m_jointAt[i]->getCapacity().m_stiffness[BT_EP_BENDING_Z]);
	}
	const double moment0 = -turns / softness;
	double rise = 0, slope = 0;
	for (int i = 0; i < n / 2; ++i)
	{
		slope += deformation(i, moment0, BT_EP_BENDING_Z);
		rise += deformation(i, moment0, BT_EP_SHEAR_Y) + slope * length * (i + 1 < n / 2 ? 1 : .5);
	}
	return -rise;
}

btScalar Bridge::supportForce() const
{
	btScalar sum = 0;
	for (int end : {0, m_settings.blocks})
	{
		const btElasticPlasticJoint& joint = *deck().m_jointAt[end];
		if (joint.isBroken())
			continue;
		// A joint's force is what it does to its body A, in the frame half way between its bodies'.
		const btQuaternion a = joint.getFrameA().getRotation(), b = joint.getFrameB().getRotation();
		const btVector3 force(joint.getForce(BT_EP_AXIAL), joint.getForce(BT_EP_SHEAR_Y),
							  joint.getForce(BT_EP_SHEAR_Z));
		const btScalar onA = quatRotate(a.slerp(b, btScalar(.5)), force).y();
		sum += end == 0 ? -onA : onA;
	}
	return sum;
}
}  // namespace ep
