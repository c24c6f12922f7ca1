// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "WorldToken.h"

#include "BulletCollision/CollisionShapes/btEmptyShape.h"
#include "BulletDynamics/Dynamics/btDynamicsWorld.h"

namespace btElasticPlastic
{
class WorldToken::Object : public btCollisionObject
{
public:
	BT_DECLARE_ALIGNED_ALLOCATOR();

	explicit Object(WorldToken& token) : m_token(&token)
	{
		// Bullet does not write objects of a user's type to files.
		m_internalType = CO_USER_TYPE;
		setCollisionFlags(CF_STATIC_OBJECT | CF_NO_CONTACT_RESPONSE | CF_DISABLE_VISUALIZE_OBJECT);
		setCollisionShape(&m_shape);
	}
	~Object() override
	{
		if (m_token)
			m_token->m_object = nullptr;
	}

	WorldToken* m_token;  ///< null: nobody has to know of its deletion

private:
	btEmptyShape m_shape;
};

void WorldToken::enter(btDynamicsWorld& world)
{
	if (getWorld() == &world)
		return;
	leave();
	m_object = new Object(*this);
	m_world = &world;
	world.addCollisionObject(m_object, 0, 0);
}

void WorldToken::leave()
{
	if (btDynamicsWorld* const world = getWorld())
		world->removeCollisionObject(m_object);
	if (m_object)
		m_object->m_token = nullptr;
	delete m_object;
	m_object = nullptr;
	m_world = nullptr;
}

btCollisionObject* WorldToken::getObject() const { return getWorld() ? m_object : nullptr; }

btDynamicsWorld* WorldToken::getWorld() const
{
	return m_object && m_object->getBroadphaseHandle() ? m_world : nullptr;
}
}  // namespace btElasticPlastic
