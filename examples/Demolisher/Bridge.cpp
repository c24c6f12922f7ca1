#include "Bridge.h"

#include <string>

namespace ep
{
namespace
{
const btScalar FRICTION = btScalar(.8);  // concrete on concrete

btTransform at(btScalar x, btScalar y) { return btTransform(btQuaternion(0, 0, 0, 1), btVector3(x, y, 0)); }
}  // namespace

Bridge::Bridge(World& world, const BridgeSettings& settings) : m_settings(settings)
{
	const BridgeSettings& s = m_settings;
	for (btScalar side : {btScalar(-1), btScalar(1)})
	{
		m_supports.push_back(addSupport(world, side));
		addRamp(world, side);
	}
	btCollisionShape* const shape = world.box(btVector3(blockLength(), s.thickness, s.width));
	for (int i = 0; i < s.blocks; ++i)
	{
		const btScalar x = (i + btScalar(.5)) * blockLength() - s.span / 2;
		btRigidBody* const block = world.body(blockMass(), shape, at(x, s.height - s.thickness / 2));
		block->setFriction(FRICTION);
		block->setDamping(deckDamping(), deckDamping());
		m_deck.push_back(block);
	}
	for (int i = 0; i <= s.blocks; ++i)
		addJoint(world, i == 0 ? *m_supports[0] : *m_deck[i - 1], i == s.blocks ? *m_supports[1] : *m_deck[i], i);
}

btScalar Bridge::blockMass() const
{
	const BridgeSettings& s = m_settings;
	const btScalar density = s.concreteDensity * (1 - s.steelShare) + s.steelDensity * s.steelShare;
	return density * blockLength() * s.thickness * s.width;
}

btElasticPlasticMaterial Bridge::material() const
{
	return btElasticPlasticMaterial::reinforcedConcrete(m_settings.steelShare, m_settings.yieldStress);
}

btElasticPlasticSection Bridge::section() const
{
	return btElasticPlasticSection::rectangle(m_settings.width, m_settings.thickness);
}

/// Bullet's damping takes the share d of the velocity in a second, v' = ln(1 - d) v: 2 zeta omega = -ln(1 - d).
btScalar Bridge::deckDamping() const
{
	const btScalar stiffness = material().m_youngsModulus * m_settings.steelShare * section().m_secondMoment[1];
	const btScalar massPerLength = blockMass() / blockLength(), l2 = m_settings.span * m_settings.span;
	const btScalar omega = btScalar(22.37) / l2 * btSqrt(stiffness / massPerLength);  // clamped at both ends
	return 1 - btExp(-2 * m_settings.dampingRatio * omega);
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
	btRigidBody* const body = world.body(0, shape, at(side * (s.span + s.supportLength) / 2, 0));
	body->setFriction(FRICTION);
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
	world.body(0, shape, at(side * (s.span / 2 + s.supportLength), 0))->setFriction(FRICTION);
}

void Bridge::addJoint(World& world, btRigidBody& left, btRigidBody& right, int index)
{
	const BridgeSettings& s = m_settings;
	const auto length = [&](const btRigidBody& body) { return body.isStaticObject() ? btScalar(0) : blockLength(); };
	btElasticPlasticCapacity capacity =
		btElasticPlasticCapacity::fromMember(material(), section(), length(left), length(right), s.hingeLength);
	// As on real bridges one end slides lengthwise. Held at both ends, a deck that has bent would hang like a rope: axial
	// force and bending moment have their yield values each for itself here, and the rope would carry what bending cannot.
	const bool slides = s.slidingEnd && index == s.blocks;
	if (slides)
		capacity.clear(BT_EP_AXIAL);
	const btTransform frame = at(index * blockLength() - s.span / 2, s.height - s.thickness / 2);
	m_joints.push_back(world.joint(left, right, frame, capacity));
	if (slides)
		static_cast<btElasticPlastic6DofSpring2Constraint&>(m_joints.back()->getConstraint())
			.setLimit(BT_EP_AXIAL, 1, -1);
	m_joints.back()->setName(("deck " + std::to_string(index)).c_str());
}

btScalar Bridge::sag() const
{
	const btVector3 &a = m_deck[(m_settings.blocks - 1) / 2]->getCenterOfMassPosition(),
					&b = m_deck[m_settings.blocks / 2]->getCenterOfMassPosition();
	return m_settings.height - m_settings.thickness / 2 - (a.y() + b.y()) / 2;
}

btScalar Bridge::beamSag(btScalar gravity) const
{
	const btScalar share = m_settings.steelShare, l2 = m_settings.span * m_settings.span;
	const btScalar load = blockMass() / blockLength() * gravity;
	const btScalar bending = material().m_youngsModulus * share * section().m_secondMoment[1];
	const btScalar shear = material().shearModulus() * share * section().m_shearArea[0];
	return load * l2 * l2 / (384 * bending) + load * l2 / (8 * shear);
}

btScalar Bridge::supportForce() const
{
	btScalar sum = 0;
	for (int end : {0, m_settings.blocks})
	{
		const btElasticPlasticJoint& joint = *m_joints[end];
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
