// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_WORLD_TOKEN_H
#define BT_ELASTIC_PLASTIC_WORLD_TOKEN_H

#include "BulletCollision/CollisionDispatch/btCollisionObject.h"

class btDynamicsWorld;

namespace btElasticPlastic
{
/// Tells whether a world still exists, which Bullet does not: it puts an object into the world that collides with nothing and
/// is not drawn. A world that is deleted takes its objects out of the broadphase. The token owns the object, but some users
/// clear a world by deleting all objects in it: then the world counts as gone, too.
class WorldToken
{
public:
	~WorldToken() { leave(); }

	/// Marks a world as the one that is asked about.
	void enter(btDynamicsWorld& world);

	/// Takes the mark out of it again, if there is one.
	void leave();

	/// The marked world; null if it is gone, or none is marked.
	btDynamicsWorld* getWorld() const;

	/// The object in the marked world; null if there is none.
	btCollisionObject* getObject() const;

private:
	class Object;

	Object* m_object = nullptr;
	btDynamicsWorld* m_world = nullptr;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_WORLD_TOKEN_H
