// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "scenes/destruction/Stage.h"

#include <algorithm>

#include "world/Place.h"

namespace ep
{
namespace
{
const btVector3 GROUND_SIZE(400, 2, 400);

Method methodOf(const Stage::Settings& settings)
{
	Method method(settings.isBulletsWay ? Solver::Stock : Solver::Direct);
	method.iterations = settings.iterations;
	if (!settings.takesInnerSteps)
		method.without |= parts::InnerSteps;
	return method;
}

/// With x along the member.
btQuaternion turnOf(Stage::Along along)
{
	switch (along)
	{
		case Stage::Along::X:
			break;
		case Stage::Along::Y:
			return btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI);
		case Stage::Along::Z:
			return btQuaternion(btVector3(0, 1, 0), -SIMD_HALF_PI);
	}
	return btQuaternion(0, 0, 0, 1);
}
}  // namespace

Stage::Stage(const Settings& settings)
	: m_settings(settings), m_world(methodOf(settings), btVector3(0, btScalar(-GRAVITY), 0))
{
	m_ground = &body(0, m_world.box(GROUND_SIZE), btVector3(0, -GROUND_SIZE.y() / 2, 0));
}

btElasticPlasticConstraintSolver* Stage::solver()
{
	return m_settings.isBulletsWay
			   ? nullptr
			   : static_cast<btElasticPlasticConstraintSolver*>(m_world.bullet().getConstraintSolver());
}

btElasticPlasticMaterial Stage::concrete(double yieldStress, double ultimateStrain) const
{
	btElasticPlasticMaterial material = btElasticPlasticMaterial::steel(btScalar(yieldStress) * m_settings.strength);
	material.m_youngsModulus = btScalar(30e9);
	material.m_density = 2400;
	material.m_ultimatePlasticStrain = btScalar(ultimateStrain);
	return material;
}

btElasticPlasticCapacity Stage::rectangularMember(const btElasticPlasticMaterial& material, double width, double height,
												  double lengthA, double lengthB) const
{
	const btElasticPlasticSection section = btElasticPlasticSection::rectangle(btScalar(width), btScalar(height));
	return btElasticPlasticCapacity::fromMember(material,
												m_settings.fibres > 0 ? section.withFibres(m_settings.fibres) : section,
												btScalar(lengthA), btScalar(lengthB));
}

btRigidBody& Stage::body(double mass, btCollisionShape* shape, const btVector3& place, const btQuaternion& turn,
						 double friction)
{
	btRigidBody& body = *m_world.body(btScalar(mass), shape, btTransform(turn, place));
	body.setFriction(btScalar(friction));
	if (m_settings.sleeps)
		body.forceActivationState(ACTIVE_TAG);
	return body;
}

void Stage::join(btRigidBody& a, btRigidBody& b, const btVector3& place, Along along,
				 const btElasticPlasticCapacity& capacity)
{
	const btTransform frame(turnOf(along), place);
	++m_numJoints;
	for (btRigidBody* body : {&a, &b})
		if (body != m_ground && body->getNumConstraintRefs() == 0)
			m_joined.push_back(body);
	if (!m_settings.isBulletsWay)
	{
		m_world.joint(a, b, frame, capacity);
		return;
	}
	// Not by the world's method, which keeps a joint of ours beside each of Bullet's: memory counts where times are compared.
	btTypedConstraint* const fixed = makeBulletsOwn(kinds::Rigid, a, b, frame, capacity);
	fixed->setBreakingImpulseThreshold(std::min({capacity.m_yield[0], capacity.m_yield[1], capacity.m_yield[2]}) *
									   btScalar(FRAME));
	m_world.add(fixed);
	m_held.push_back(fixed);
}

void Stage::drive(btRigidBody& chassis, btRigidBody& wheel, double speed, double impulse)
{
	const btVector3 axis(0, 0, 1), none(0, 0, 0);
	auto* const hinge = new btHingeConstraint(
		chassis, wheel, wheel.getCenterOfMassPosition() - chassis.getCenterOfMassPosition(), none, axis, axis);
	hinge->enableAngularMotor(true, btScalar(speed), btScalar(impulse));
	m_feedbacks.emplace_back();
	hinge->setJointFeedback(&m_feedbacks.back());
	m_world.add(hinge);
}

void Stage::at(int frame, std::function<void(Stage&)> act) { m_script.push_back({frame, std::move(act)}); }

void Stage::throwBall(int frame, const Ball& ball)
{
	btCollisionShape* const shape = m_world.keep(new btSphereShape(ball.radius));
	at(frame, [shape, ball](Stage& stage)
	   { stage.body(double(ball.mass), shape, ball.place).setLinearVelocity(ball.velocity); });
}

void Stage::remove(btRigidBody& body)
{
	for (int i = body.getNumConstraintRefs() - 1; i >= 0; --i)
	{
		btTypedConstraint* const constraint = body.getConstraintRef(i);
		constraint->getRigidBodyA().activate();
		constraint->getRigidBodyB().activate();
		if (btElasticPlasticJoint* const joint = btElasticPlasticJoint::from(constraint))
			m_world.action().removeJoint(joint);
		m_held.erase(std::remove(m_held.begin(), m_held.end(), constraint), m_held.end());
		m_world.bullet().removeConstraint(constraint);
	}
	body.setLinearVelocity(btVector3(0, 0, 0));
	body.setAngularVelocity(btVector3(0, 0, 0));
	m_world.bullet().removeRigidBody(&body);
}

void Stage::playScript()
{
	btElasticPlasticEvent event;
	while (m_world.action().popEvent(event))
		;
	for (const Event& scripted : m_script)
		if (scripted.frame == m_frame)
			scripted.act(*this);
}

void Stage::step()
{
	m_world.bullet().stepSimulation(btScalar(FRAME), 0);
	if (m_settings.isBulletsWay)
		removeBroken();
	++m_frame;
}

void Stage::removeBroken()
{
	for (size_t i = 0; i < m_held.size();)
	{
		btTypedConstraint* const joint = m_held[i];
		if (joint->isEnabled())
		{
			++i;
			continue;
		}
		joint->getRigidBodyA().activate();
		joint->getRigidBodyB().activate();
		m_world.bullet().removeConstraint(joint);
		m_held[i] = m_held.back();
		m_held.pop_back();
		++m_numBroken;
	}
}

int Stage::numBroken() { return m_settings.isBulletsWay ? m_numBroken : m_world.action().getNumBroken(); }
}  // namespace ep
