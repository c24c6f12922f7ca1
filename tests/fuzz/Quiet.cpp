// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "fuzz/Quiet.h"

#include "world/EvenCapacity.h"
#include "world/Place.h"

namespace
{
const int BLOCKS = 4;
const int GROUP = 1 << 10;  ///< of collisions: their own
const btScalar FAR = 1000;  ///< from everybody else [m]

void add(uint64_t& hash, btScalar value)
{
	unsigned char bytes[sizeof value];
	memcpy(bytes, &value, sizeof value);
	// FNV-1a
	for (const unsigned char byte : bytes)
		hash = (hash ^ byte) * 1099511628211ull;
}

void add(uint64_t& hash, const btVector3& v)
{
	for (int i = 0; i < 3; ++i)
		add(hash, v[i]);
}
}  // namespace

Quiet::Quiet(btDiscreteDynamicsWorld& world) : m_world(world)
{
	world.addAction(&m_action);
	for (int i = 0; i <= BLOCKS; ++i)
	{
		const btScalar mass = i == 0 ? 0 : 1000;
		btVector3 inertia(0, 0, 0);
		if (mass > 0)
			m_shape.calculateLocalInertia(mass, inertia);
		m_bodies.emplace_back(new btRigidBody(mass, nullptr, &m_shape, inertia));
		m_bodies.back()->setWorldTransform(ep::at(FAR + btScalar(i), FAR, FAR));
		m_bodies.back()->setActivationState(DISABLE_DEACTIVATION);
		world.addRigidBody(m_bodies.back().get(), GROUP, GROUP);
		if (i == 0)
			continue;
		const btScalar half = btScalar(0.5);
		m_joints.emplace_back(new btElasticPlastic6DofSpring2Constraint(*m_bodies[size_t(i) - 1], *m_bodies[size_t(i)],
																		ep::at(half), ep::at(-half)));
		// The moment of the weight at the wall is 80 kN m.
		m_joints.back()->setCapacity(ep::evenCapacity(1e7, 5e4));
		world.addConstraint(m_joints.back().get(), true);
		m_action.addJoint(m_joints.back().get());
	}
}

Quiet::~Quiet()
{
	for (const auto& joint : m_joints)
		m_world.removeConstraint(joint.get());
	for (const auto& body : m_bodies)
		m_world.removeRigidBody(body.get());
	m_world.removeAction(&m_action);
}

uint64_t Quiet::hash() const
{
	uint64_t hash = 14695981039346656037ull;
	for (const auto& body : m_bodies)
	{
		add(hash, body->getCenterOfMassPosition());
		for (int row = 0; row < 3; ++row)
			add(hash, body->getCenterOfMassTransform().getBasis()[row]);
		add(hash, body->getLinearVelocity());
		add(hash, body->getAngularVelocity());
	}
	for (const auto& joint : m_joints)
		for (int dof = 0; dof < BT_EP_DOF_COUNT; ++dof)
		{
			add(hash, joint->getForce(dof));
			add(hash, joint->getPlasticDeformation(dof));
		}
	return hash;
}

bool Quiet::isFinite() const
{
	btScalar sum = 0;
	for (const auto& body : m_bodies)
		for (int i = 0; i < 3; ++i)
			sum += body->getCenterOfMassPosition()[i] + body->getLinearVelocity()[i] + body->getAngularVelocity()[i];
	return btElasticPlasticIsFinite(sum);
}
