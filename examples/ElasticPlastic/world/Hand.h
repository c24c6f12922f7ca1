// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_HAND_H
#define EP_HAND_H

#include <memory>

#include "world/World.h"

namespace ep
{
/// What a ray meets first.
struct RayHit
{
	bool hasHit = false;
	btVector3 place = btVector3(0, 0, 0);
	btRigidBody* body = nullptr;  ///< null: nothing, or nothing that is free to move
};
RayHit castRay(World& world, const btVector3& from, const btVector3& direction);

/// A person's hand in a world: takes hold of a body where a ray meets it, and pulls that point along. Ends before its world does.
class Hand
{
public:
	explicit Hand(World& world) : m_world(world) {}
	~Hand() { release(); }
	Hand(const Hand&) = delete;
	Hand& operator=(const Hand&) = delete;

	/// What a ray meets first. \return null if that does not move
	btRigidBody* grab(const btVector3& from, const btVector3& direction);
	/// To where the ray is as far from its beginning as it was.
	void drag(const btVector3& from, const btVector3& direction);
	void release();

	bool holds() const { return m_pull != nullptr; }
	/// Where it has taken hold [m].
	const btVector3& place() const { return m_place; }

private:
	World& m_world;
	std::unique_ptr<btPoint2PointConstraint> m_pull;
	btScalar m_distance = 0;
	btVector3 m_place = btVector3(0, 0, 0);
};
}  // namespace ep

#endif  // EP_HAND_H
