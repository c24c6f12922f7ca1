// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "effects/Blows.h"

namespace ep
{
namespace
{
const btScalar LEAST_SPEED = 1;  // [m/s]

/// The point that is pressed hardest. \return null: none is pressed
const btManifoldPoint* pressed(const btPersistentManifold& manifold)
{
	const btManifoldPoint* hardest = nullptr;
	for (int i = 0; i < manifold.getNumContacts(); ++i)
	{
		const btManifoldPoint& point = manifold.getContactPoint(i);
		if (point.m_appliedImpulse > (hardest ? hardest->m_appliedImpulse : 0))
			hardest = &point;
	}
	return hardest;
}
}  // namespace

void Blows::before(const World& world)
{
	const auto& bodies = world.bodies();
	m_motions.clear();
	m_motions.resize(bodies.size(), {btVector3(0, 0, 0), btVector3(0, 0, 0), btVector3(0, 0, 0)});
	for (const auto& body : bodies)
		if (body->isInWorld() && size_t(body->getWorldArrayIndex()) < m_motions.size())
			m_motions[size_t(body->getWorldArrayIndex())] = {body->getCenterOfMassPosition(), body->getLinearVelocity(),
															 body->getAngularVelocity()};
}

/// What has come since stood still.
btVector3 Blows::velocity(const btCollisionObject& object, const btVector3& at) const
{
	const size_t index = size_t(object.getWorldArrayIndex());
	if (index >= m_motions.size())
		return btVector3(0, 0, 0);
	const Motion& motion = m_motions[index];
	return motion.velocity + motion.spin.cross(at - motion.place);
}

std::vector<Blow> Blows::after(World& world)
{
	std::vector<Blow> blows;
	std::set<Pair> touching;
	btDispatcher& dispatcher = *world.bullet().getDispatcher();
	for (int m = 0; m < dispatcher.getNumManifolds(); ++m)
	{
		const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
		const btRigidBody *const a = btRigidBody::upcast(manifold.getBody0()), *const b = btRigidBody::upcast(
																				   manifold.getBody1());
		const btManifoldPoint* const point = pressed(manifold);
		const Pair pair(a, b);
		if (!a || !b || !point || !touching.insert(pair).second || m_touching.count(pair) > 0)
			continue;
		const btVector3 place = point->getPositionWorldOnB();
		const btScalar closing = point->m_normalWorldOnB.dot(velocity(*b, place) - velocity(*a, place)),
					   inverseMass = a->getInvMass() + b->getInvMass();
		if (closing > LEAST_SPEED && inverseMass > 0)
			blows.push_back({place, double(closing * closing / (2 * inverseMass))});
	}
	m_touching.swap(touching);
	return blows;
}
}  // namespace ep
